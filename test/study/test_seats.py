"""Which start each environment has."""

import numpy as np
import pytest

from pool_sim_ros.physics import report_table
from pool_sim_ros.study.seats import Seats
from pool_sim_ros.study.tasks import Place

TASK = Place(report_table(), 4.0, 100, 1, '9', None, 0.1)
ALL = np.arange(8)


def begun(count, seeds, episodes=1):
    seats = Seats(TASK, count)
    seats.seed(np.arange(count), seeds)
    for _ in range(episodes):
        seats.begin(np.arange(count))
    return seats


def test_a_start_depends_on_seed_and_episode_alone():
    together = begun(8, range(8), 3).observations()
    for k in range(8):
        assert (begun(1, [k], 3).observations()[0] == together[k]).all()
    assert len(np.unique(together, axis=0)) > 4
    assert (begun(8, range(8), 4).observations() != together).any()


def test_the_observation_is_positions_and_goal():
    seats = begun(8, range(8))
    positions, goals, scores = seats.state
    assert (seats.observations() == np.hstack([positions.reshape(8, 22), goals])).all()
    assert scores == pytest.approx(-np.hypot(*(positions[:, 9] - goals).T), abs=1e-15)


def test_an_observation_stays_as_it_was():
    seats = begun(8, range(8))
    before = seats.observations()
    copy = before.copy()
    seats.play(np.full((8, 2), 0.7), None)
    seats.begin(ALL)
    assert (before == copy).all()


def test_a_huge_seed_is_a_seed():
    assert (begun(1, [2**70 + 5]).observations() == begun(1, [5]).observations()).all()
