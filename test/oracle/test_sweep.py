"""The sweep: its map beside brute force, its peaks, and its smoothing beside a plain loop."""

import numpy as np
import pytest
from tables import table_of

from pool_sim_ros.oracle import Goal, Noise
from pool_sim_ros.oracle.space import Space
from pool_sim_ros.oracle.sweep import PASS, Map, Sweep, along
from pool_sim_ros.oracle.trials import Trials
from pool_sim_ros.physics import pool_table

TABLE = table_of([(0.5, 0.5), (1.0, 0.5)])
NOISE = Noise(speed=0.1, azimuth=1.0)


def sweep_of(goal, noise=NOISE, shots=100_000, table=TABLE, offset=0.0, seed=1):
    trials = Trials(table, goal, noise, np.array(table.positions), 1)
    sweep = Sweep(trials, Space((0.5, 3.0), offset), shots, seed)
    sweep.go_on(shots, lambda: False)
    return sweep


def brute_force(sweep, aims, count=20_000):
    """Return the chance of each aim from shots of its own."""
    rng = np.random.default_rng(9)
    strokes = [sweep.trials.executed(aim, rng.standard_normal((count, 5))) for aim in aims]
    return [sweep.trials.play(stroke).met.mean() for stroke in strokes]


def test_the_map_is_the_chance_of_every_aim():
    sweep = sweep_of(Goal(ball='1', rectangle=(1.5, 0.3, 2.0, 0.7)))
    (chart,) = sweep.maps
    chances = chart.chances()
    for row, column in [(10, 0), (20, 4), (30, 2), (15, 716), (40, 350)]:
        aim = np.zeros(5)
        aim[:2] = np.array([chart.low, 0.0]) + (np.array([row, column]) + 0.5) * chart.cell
        (truth,) = brute_force(sweep, [aim])
        assert chances[row, column] == pytest.approx(truth, abs=0.08)
    assert 0.2 < chances.max() <= 1.1


def test_peaks_are_good_aims_best_first_apart_and_within_the_speeds():
    sweep = sweep_of(Goal(ball='1', rectangle=(1.5, 0.3, 2.0, 0.7)))
    aims, spreads = sweep.peaks(20)
    assert 3 < len(aims) <= 20
    assert ((aims[:, 0] >= 0.5) & (aims[:, 0] <= 3.0)).all() and not aims[:, 2:].any()
    np.testing.assert_array_equal(spreads, np.tile(sweep.maps[0].spread, (len(aims), 1)))
    first, last = brute_force(sweep, [aims[0], aims[-1]])
    assert first > last
    rng = np.random.default_rng(2)
    guesses = np.zeros((100, 5))
    guesses[:, :2] = rng.uniform((0.5, -10.0), (3.0, 10.0), (100, 2))
    assert first > max(brute_force(sweep, guesses, 1000)) - 0.1


def test_shots_are_played_as_told_and_a_cut_comes_after_a_pass():
    sweep = sweep_of(Goal(first_hit='1'), shots=70_000)
    assert sweep.trials.played == 70_000 and sweep.passes == 3
    sweep = sweep_of(Goal(first_hit='1'), shots=1000)
    assert sweep.trials.played == 1000
    again = Sweep(sweep.trials, Space((0.5, 3.0), 0.0), 70_000, 1)
    again.go_on(70_000, lambda: True)
    assert again.passes == 1 and again.maps[0].count == PASS


def test_a_goal_that_is_never_met_has_no_peaks():
    sweep = sweep_of(Goal(first_hit='1') & Goal(avoid='1'), shots=5000)
    assert sweep.met == 0
    aims, spreads = sweep.peaks(10)
    assert aims.shape == (0, 5) and spreads.shape == (0, 2)


def test_few_shots_and_no_noise_make_a_coarse_map():
    shared = sweep_of(Goal(first_hit='1'), Noise(), shots=10_000)
    (chart,) = shared.maps
    # Five shots a standard deviation's ellipse: 4 pi sd sd / area of 10,000.
    ellipse = 4.0 * np.pi * chart.spread.prod() / (2.5 * 360.0)
    assert 10_000 * ellipse == pytest.approx(5.0, rel=1e-6)
    assert chart.successes.size < 200_000


def test_half_of_the_shots_hit_the_middle_of_a_ball_that_spins():
    table = pool_table('7ft')
    sweep = sweep_of(Goal(first_hit='1'), Noise(0.1, 1.0), 4000, table, 0.4)
    assert len(sweep.maps) == 9 and sweep.maps[0].count == 2000
    assert [chart.count for chart in sweep.maps[1:]] == [250] * 8
    aims, _ = sweep.peaks(200)
    assert len(np.unique(aims[:, 3:], axis=0)) > 3


@pytest.mark.parametrize('axis', [0, 1])
def test_smoothing_is_a_plain_sum(axis):
    rng = np.random.default_rng(4)
    values, weights = rng.random((9, 11)), rng.random(4)
    expected = np.zeros_like(values)
    for i in range(9):
        for j in range(11):
            for k in range(-3, 4):
                row, column = (i + k, j) if axis == 0 else (i, (j + k) % 11)
                if 0 <= row < 9:
                    expected[i, j] += weights[abs(k)] * values[row, column]
    np.testing.assert_allclose(along(values, axis, weights), expected)


def test_a_map_with_one_success_is_the_noise_round_it():
    chart = Map((1.0, 2.0), np.array([0.05, 1.0]))
    chart.spread_evenly(2)
    met = np.array([True, False])
    chart.add(np.array([[1.5, 359.9], [1.5, 180.0]]), met, np.where(met, 1.0, np.inf))
    chances = chart.chances()
    row, column = np.unravel_index(chances.argmax(), chances.shape)
    assert chart.low + (row + 0.5) * chart.cell[0] == pytest.approx(1.5, abs=chart.cell[0])
    assert column == chances.shape[1] - 1
    # Two cells are one standard deviation, and north is crossed.
    assert chances[row, 1] / chances[row, column] == pytest.approx(np.exp(-0.5), rel=1e-3)
    assert chances.sum() * 2 / chances.size == pytest.approx(1.0)


def test_focused_strokes_are_many_where_the_first_succeeded_and_count_for_less():
    """A map of strokes that are played twice as often there says the same of every aim."""
    rng = np.random.default_rng(3)
    chart = Map((1.0, 2.0), np.array([0.05, 5.0]))

    def play(strokes):
        met = abs(strokes[:, 0] - 1.5) + abs(strokes[:, 1] - 90.0) / 100.0 < 0.1
        chart.add(strokes, met, np.where(met, 1.0, np.inf))
        return met.mean()

    size = np.array([chart.high - chart.low, 360.0])
    chart.spread_evenly(40_000)
    rare = play((chart.low, 0.0) + rng.random((40_000, 2)) * size)
    before = chart.chances()
    chart.look_where(1.0, 1.0)
    often = play(chart.focused(40_000, rng))
    assert often > 5.0 * rare > 0.0
    after = chart.chances()
    assert chart.played.sum() == pytest.approx(80_000)
    assert after.max() == pytest.approx(before.max(), rel=0.1)
    assert after.sum() == pytest.approx(before.sum(), rel=0.1)


def test_near_misses_tell_where_to_look():
    """Of a goal that hardly any shot meets, the focus plays more shots that meet it."""
    rare = Goal(ball='1', to=(1.6, 0.3), within=0.01)
    even = sweep_of(rare, shots=20_000)
    focused = sweep_of(rare, shots=10_000)
    focused.focus(5000, 1.0, lambda: False)
    focused.focus(5000, 2.0, lambda: False)
    assert focused.trials.played == pytest.approx(20_000, abs=4)
    assert even.met < 20 and focused.met > 5 * max(even.met, 1)


def test_nothing_near_is_no_focus():
    sweep = sweep_of(Goal(first_hit='1') & Goal(avoid='1'), shots=5000)
    sweep.focus(5000, 1.0, lambda: False)
    assert sweep.trials.played == 5000
