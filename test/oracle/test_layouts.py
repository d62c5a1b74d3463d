"""Layouts round one that was seen: what they may be, and the rule for what they may not."""

import numpy as np
import pytest
from tables import table_of

from pool_sim_ros.oracle.layouts import Layouts
from pool_sim_ros.physics import check_layout, pool_table, report_table

POOL = pool_table('7ft')


def drawn(table, camera, count=300, seen=None, seed=1):
    places = np.array(table.positions if seen is None else seen)
    return places, Layouts(table, places, camera).draw(count, np.random.default_rng(seed))


def test_no_noise_is_no_layout():
    assert drawn(report_table(), 0.0)[1] is None


def test_balls_far_from_everything_get_the_noise_as_it_is():
    table = table_of([(0.5, 0.5), (1.5, 0.5)])
    seen, places = drawn(table, 1e-3)
    noise = 1e-3 * np.random.default_rng(1).standard_normal((300, 2, 2))
    np.testing.assert_array_equal(places, seen + noise)


@pytest.mark.parametrize('table', [report_table(), POOL], ids=['report', '7ft'])
@pytest.mark.parametrize('camera', [1e-4, 1e-3, 1e-2])
def test_every_layout_can_be_played(table, camera):
    seen, places = drawn(table, camera, 100)
    for layout in places:
        check_layout(table, layout)
    assert 0.3 * camera < (places - seen).std() < 1.5 * camera


def test_two_balls_that_would_overlap_move_apart_along_the_line_of_their_centres():
    table = table_of([(0.5, 0.5), (0.601, 0.5), (1.5, 0.5)])
    camera = 2e-3
    seen, places = drawn(table, camera)
    noisy = seen + camera * np.random.default_rng(1).standard_normal(places.shape)
    apart = np.hypot(*(noisy[:, 1] - noisy[:, 0]).T)
    overlap = apart < 0.1
    assert 50 < overlap.sum() < 250
    np.testing.assert_array_equal(places[~overlap], noisy[~overlap])
    moved = places[overlap, 1] - places[overlap, 0]
    line = noisy[overlap, 1] - noisy[overlap, 0]
    # They touch but for the little that they are moved farther; the middle between them stays.
    np.testing.assert_allclose(np.hypot(*moved.T), 0.1 + 0.2 * camera, rtol=1e-12)
    np.testing.assert_allclose(moved[:, 0] * line[:, 1] - moved[:, 1] * line[:, 0], 0, atol=1e-15)
    np.testing.assert_allclose(
        places[overlap, :2].mean(axis=1), noisy[overlap, :2].mean(axis=1), rtol=1e-12
    )
    np.testing.assert_array_equal(places[:, 2], noisy[:, 2])


def test_a_ball_at_a_rail_stays_between_the_rails():
    table = table_of([(0.05, 0.5), (1.5, 0.5)])
    seen, places = drawn(table, 1e-3)
    noisy = seen + 1e-3 * np.random.default_rng(1).standard_normal(places.shape)
    assert (noisy[:, 0, 0] < 0.05).any()
    np.testing.assert_array_equal(places, np.maximum(noisy, 0.05))


def test_balls_in_a_pocket_stay_there_and_no_other_gets_in():
    seen = np.array(POOL.positions)
    x, y, radius = POOL.pockets[0]
    seen[1] = x, y
    toward = np.array([POOL.length / 2, POOL.width / 2]) - (x, y)
    seen[2] = (x, y) + toward / np.hypot(*toward) * (radius + 1e-3)
    check_layout(POOL, seen)
    seen, places = drawn(POOL, 2e-3, 400, seen)
    np.testing.assert_array_equal(places[:, 1], np.tile(seen[1], (400, 1)))
    away = np.hypot(*(places[:, 2] - (x, y)).T)
    assert (away >= radius).all() and away.std() > 5e-4


def test_what_cannot_be_drawn_is_what_was_seen():
    """Three balls fill this table: there is one layout and no other."""
    table = table_of([(0.05, 0.05), (0.15, 0.05), (0.25, 0.05)], length=0.3, width=0.1)
    seen, places = drawn(table, 0.02, 30)
    for layout in places:
        check_layout(table, layout)
    assert (places == seen).all(axis=(1, 2)).any()
    np.testing.assert_allclose(places, np.tile(seen, (30, 1, 1)), atol=1e-8)
