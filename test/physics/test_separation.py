"""Balls that overlap are moved apart as little as that needs."""

import dataclasses

import numpy as np
import pytest
from crowds import crowded_table
from tables import table_of

from pool_sim_ros.physics import check_layout, separated, simulate


def test_a_layout_that_can_be_is_left_alone():
    table = table_of([(0.5, 0.5), (0.6, 0.5), (1.5, 0.5)])
    assert separated(table, table.positions) is table.positions


def test_two_balls_go_half_the_way_each():
    table = table_of([(0.5, 0.5), (0.8, 0.5)])
    found = separated(table, np.array([(0.5, 0.5), (0.56, 0.58)]))
    middle, apart = found.mean(axis=0), found[1] - found[0]
    assert middle == pytest.approx((0.53, 0.54), abs=1e-9)
    assert np.hypot(*apart) == pytest.approx(0.1, abs=2e-9)
    assert apart[0] * 0.08 == pytest.approx(apart[1] * 0.06, abs=1e-12)


def test_two_balls_in_one_place_and_one_outside():
    table = table_of([(0.5, 0.5), (0.8, 0.5), (1.2, 0.5)])
    found = separated(table, np.array([(0.5, 0.5), (0.5, 0.5), (1.99, 1.2)]))
    check_layout(table, found)
    assert found[2] == pytest.approx((1.95, 0.95))


def test_the_order_of_the_balls_does_not_matter():
    rng = np.random.default_rng(1)
    for _ in range(20):
        table = crowded_table(rng, 1.0, most=12)
        places = table.positions + rng.normal(0.0, 0.01, table.positions.shape)
        order = rng.permutation(len(places))
        shuffled = dataclasses.replace(table, balls=[table.balls[k] for k in order])
        found, again = separated(table, places), separated(shuffled, places[order])
        check_layout(table, found)
        assert np.abs(again - found[order]).max() < 1e-9
        assert np.abs(found - places).max() < 0.2


def test_what_has_no_room_is_given_up():
    full = [(0.05 + 0.1 * i, 0.05 + 0.1 * j) for i in range(20) for j in range(10)]
    table = table_of(full)
    crammed = np.array(full)
    crammed[:10] += 0.04
    assert separated(table, crammed) is None
    small = dataclasses.replace(table, balls=table.balls[:1], length=0.1, width=0.1)
    assert separated(small, np.array([(0.2, 0.0)])) == pytest.approx(np.array([(0.05, 0.05)]))


def test_what_slices_let_into_each_other():
    """Balls that touch go through one another; what comes of it can be played on."""
    rows = (
        (0.6 - 0.05 * np.sqrt(3) * i, 0.5 + 0.1 * (j - i / 2))
        for i in range(4)
        for j in range(i + 1)
    )
    spots = [(1.5, 0.5), *rows]
    table = table_of(spots, e_ball_ball=0.3)
    shot = simulate(table, (-3.0, 0.01), integrator='time_slice', time_slice=1e-4)
    with pytest.raises(ValueError, match='overlap'):
        check_layout(table, shot.final_positions)
    simulate(table, (-1.0, 0.1), positions=separated(table, shot.final_positions))
