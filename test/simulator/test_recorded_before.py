"""A session that an earlier version recorded, commit 97539c6, plays as it did then.

`data/session_97539c6.npz` has what that version replayed from the same log: every seventh frame,
and all collisions. A shot is looked up from velocity and acceleration since, not from direction
and speed, which moves last bits.
"""

from pathlib import Path

import numpy as np
import pytest

from pool_sim_ros.simulator.frame import COLLISION_COLUMNS
from pool_sim_ros.simulator.log_reader import read_log
from pool_sim_ros.simulator.replay import replay_frames

DATA = Path(__file__).with_name('data')
ROUNDING = 1e-12  # m and m/s


@pytest.fixture(scope='module')
def frames():
    return list(replay_frames(*read_log(DATA / 'session_97539c6.log')))


@pytest.fixture(scope='module')
def before():
    with np.load(DATA / 'session_97539c6.npz') as arrays:
        return dict(arrays)


def test_each_frame_shows_the_balls_where_they_were(frames, before):
    assert len(frames) == before['frames']
    for tick, positions, velocities in zip(
        before['ticks'], before['positions'], before['velocities'], strict=True
    ):
        assert frames[tick].tick == tick
        np.testing.assert_allclose(frames[tick].positions, positions, rtol=0, atol=ROUNDING)
        np.testing.assert_allclose(frames[tick].velocities, velocities, rtol=0, atol=ROUNDING)
    assert frames[-1].positions.tobytes() == before['final'].tobytes()


def test_the_same_collisions_come_in_the_same_frames(frames, before):
    rows = np.concatenate([frame.collisions for frame in frames])
    ticks = np.concatenate([np.full(len(frame.collisions), frame.tick) for frame in frames])
    assert np.array_equal(ticks, before['collision_ticks'])
    assert rows.shape == before['collisions'].shape == (len(rows), len(COLLISION_COLUMNS))
    assert rows.tobytes() == before['collisions'].tobytes()
