"""How fast two sides part, where contacts come ever faster; against the rule in words."""

import math

import numpy as np
import pytest
from numba import njit
from tables import table_of

from pool_sim_ros.physics.event_driven.inelastic_collapse import (
    count_round,
    is_pressed,
    keep_counts,
    rounds_at,
    separation_speed,
)
from pool_sim_ros.physics.tolerances import (
    COLLAPSE_GROWTH,
    LAST_ROUND,
    MAX_PRESSES,
    MAX_REPEATS,
    MAX_ROUNDS,
    PRESS_GROWTH,
    PRESS_WINDOW,
    REPEAT_WINDOW,
    ROUND,
    SETTLE_EVERY,
    STEADY_PRESSES,
    V_MIN,
    V_ROUNDING,
)


@njit
def part(balls, table, a, b, closing, now, slower=1.0):
    speed, _, repeats, presses = separation_speed(table, balls, a, b, (closing, slower), now)
    keep_counts(balls, a, b, repeats, presses)
    return speed


@njit
def pressed(balls, a, b, now):
    return is_pressed(balls, a, b, now)


@njit
def count(balls, i, now):
    count_round(balls[i], now)


@njit
def rounds(balls, a, b, now):
    return rounds_at(balls, a, b, now)


@pytest.fixture
def table():
    spots = [(0.3, 0.5), (0.6, 0.5), (0.9, 0.5)]
    return table_of(spots, e_cue_ball=0.7, e_ball_ball=0.9, e_ball_cushion=0.8)


@pytest.fixture
def balls(table):
    return table.balls_at_rest.copy()


@pytest.mark.parametrize('closing', [2 * V_MIN, 1e-3, 1.0, 100.0])
def test_strong_contacts_part_by_their_restitution(closing, table, balls):
    balls['last_contact_time'] = 0.99
    for a, b, e in ((0, 1, 0.7), (1, 2, 0.9), (1, -2, 0.8), (0, -5, 0.8)):
        assert part(balls, table.for_kernels, a, b, closing, 0.99) == e * closing
    assert not balls['repeats'].any()


@pytest.mark.parametrize('closing', [-1.0, 0.0, 1e-12, 0.5 * V_MIN])
def test_a_weak_contact_parts_so_that_rounding_cannot_close_it(closing, table, balls):
    found = part(balls, table.for_kernels, 1, 2, closing, 5.0)
    assert found == max(0.9 * max(closing, 0.0), V_ROUNDING)


def test_repeats_part_faster_each_time_up_to_the_bound(table, balls):
    now, speeds = 1.0, []
    for _ in range(MAX_REPEATS + 10):
        speeds.append(part(balls, table.for_kernels, 1, 2, 0.0, now))
        balls['last_contact_time'][[1, 2]] = now
        now += 0.5 * REPEAT_WINDOW
    expected = [min(V_MIN, V_ROUNDING * COLLAPSE_GROWTH**k) for k in range(len(speeds))]
    expected[MAX_REPEATS:] = [expected[MAX_REPEATS]] * 10
    assert speeds == pytest.approx(expected, rel=1e-15)
    assert speeds[-1] == V_MIN
    assert balls['repeats'].tolist() == [0, MAX_REPEATS, MAX_REPEATS]


def test_a_pause_ends_the_repeats(table, balls):
    balls['repeats'], balls['last_contact_time'] = 7, 1.0
    late = 1.0 + 1.01 * REPEAT_WINDOW
    assert part(balls, table.for_kernels, 1, 2, 0.0, late) == V_ROUNDING
    assert balls['repeats'][1:].tolist() == [0, 0]


def test_a_ball_stays_at_a_cushion_that_it_meets_weakly_again(table, balls):
    weak = 0.5 * V_MIN
    assert part(balls, table.for_kernels, 1, -3, weak, 1.0) == 0.8 * weak
    balls['last_contact_time'][1] = 1.0
    again = 1.0 + 0.5 * REPEAT_WINDOW
    assert part(balls, table.for_kernels, 1, -3, weak, again) == 0.0
    assert part(balls, table.for_kernels, 1, -3, 2 * V_MIN, again) == 0.8 * 2 * V_MIN


def test_rounds_of_a_rattle_are_counted_until_the_bound(balls):
    now = 1.0
    for k in range(1, LAST_ROUND + 20):
        count(balls, 0, now)
        assert balls['rounds'][0] == min(k, LAST_ROUND + 1)
        assert balls['last_contact_time'][0] == now
        now += 0.5 * ROUND
    count(balls, 0, now + 2 * ROUND)
    assert balls['rounds'][0] == MAX_ROUNDS + 1, 'it may be pressed'
    count(balls, 0, now + 2 * PRESS_WINDOW)
    assert balls['rounds'][0] == 1
    count(balls, 0, now + 2 * PRESS_WINDOW + 2 * ROUND)
    assert balls['rounds'][0] == 1


def test_the_more_stricken_of_two_counts(balls):
    rng = np.random.default_rng(1)
    for _ in range(200):
        balls['rounds'] = rng.integers(0, 300, 3)
        balls['last_contact_time'] = 1.0 - rng.choice([0.1, 0.9, 1.5, 1e6], 3) * ROUND
        balls['last_contact_time'][rng.integers(3)] = -math.inf
        since = 1.0 - balls['last_contact_time']
        kept = np.where((since < PRESS_WINDOW) & (balls['rounds'] > MAX_ROUNDS), MAX_ROUNDS + 1, 0)
        fresh = np.where(since < ROUND, balls['rounds'], kept)
        for a, b in ((0, 1), (2, 1), (0, -1), (1, -4)):
            expected = max(fresh[a], fresh[b]) if b >= 0 else fresh[a]
            assert rounds(balls, a, b, 1.0) == expected


def test_what_is_pressed_for_long_parts_ever_faster_up_to_a_bound(table, balls):
    """Twice as fast takes twice as long, so that pressing has no end of contacts."""
    now, speeds = 1.0, []
    for _ in range(MAX_PRESSES + 100):
        speeds.append(part(balls, table.for_kernels, 1, 2, 0.0, now))
        balls['last_contact_time'][[1, 2]] = now
        now += 0.5 * PRESS_WINDOW
    assert not pressed(balls, 0, 0, now)
    assert pressed(balls, 1, 0, now) and pressed(balls, 0, 2, now) and pressed(balls, 2, -3, now)
    assert max(speeds[:STEADY_PRESSES]) <= V_MIN
    late = np.array(speeds[STEADY_PRESSES + 1 :])
    settled = late == V_ROUNDING
    assert abs(settled.sum() - len(late) / SETTLE_EVERY) <= 1
    grown = late[~settled]
    assert np.all(np.diff(grown[:100]) > 0.0)
    assert grown.max() <= V_MIN * PRESS_GROWTH ** (MAX_PRESSES - STEADY_PRESSES)
    assert not pressed(balls, 1, 2, now + PRESS_WINDOW)


def test_what_lies_still_is_left_there(table, balls):
    balls['presses'], balls['last_contact_time'] = STEADY_PRESSES + 100, 1.0
    assert part(balls, table.for_kernels, 1, 2, 1e-5, 1.01, slower=0.0) == V_ROUNDING
    balls['presses'] = STEADY_PRESSES + 100
    assert part(balls, table.for_kernels, 1, 2, 1e-5, 1.01, slower=1.0) > V_MIN
    balls['presses'] = STEADY_PRESSES + 100
    assert part(balls, table.for_kernels, 1, 2, 1.0, 1.01) == 0.9, 'a strong contact is one still'
