"""What a session sends, as one number for each topic."""

from hashlib import sha256

import numpy as np
import pytest
from shot_frames import shot_frames

from pool_sim_ros.ros import cdr, digests
from pool_sim_ros.simulator import (
    COLLISION_COLUMNS,
    VELOCITY_COLUMNS,
    build_settings,
    default_values,
)

SETTINGS = build_settings(default_values())
TABLE = SETTINGS.table


@pytest.fixture(scope='module')
def frames():
    return shot_frames(TABLE, (-4.0, 0.3))


def test_it_is_the_hash_of_the_messages_in_their_order(frames):
    poses = cdr.PosesWriter(SETTINGS.frame_id, TABLE.radii.tolist())
    velocities = cdr.RowsWriter('ball', VELOCITY_COLUMNS)
    collisions = cdr.RowsWriter('collision', COLLISION_COLUMNS)
    sent = {'ball_poses': b'', 'ball_velocities': b'', 'collisions': b''}
    for frame in frames:
        # As the node does it: whole blocks at once.
        block, index = frame.block, frame.index
        sent['ball_poses'] += poses.write(block.stamps, block.positions)[index]
        sent['ball_velocities'] += velocities.write(block.velocities)[index]
        if len(block.collisions[index]):
            sent['collisions'] += collisions.write(block.collisions[index][np.newaxis])[0]
    expected = {topic: sha256(data).hexdigest() for topic, data in sent.items()}
    assert digests(SETTINGS, iter(frames)) == expected


def test_another_shot_has_others(frames):
    one = digests(SETTINGS, iter(frames))
    other = digests(SETTINGS, iter(shot_frames(TABLE, (-4.0, np.nextafter(0.3, 1.0)))))
    assert all(one[topic] != other[topic] for topic in one)


def test_no_frames_are_no_bytes():
    empty = sha256(b'').hexdigest()
    assert set(digests(SETTINGS, iter([])).values()) == {empty}
