"""A region is what `simulate` makes of its shots, one by one."""

import dataclasses

import numpy as np
import pytest

from pool_sim_ros.physics import cue_strikes, pool_table, report_table, simulate
from pool_sim_ros.study.inputs import checked_inputs
from pool_sim_ros.study.plan import checked_plan
from pool_sim_ros.study.playing import CANNOT_BE, Player, table_with
from pool_sim_ros.study.ranges import normal, uniform
from pool_sim_ros.study.shot_random import normals, single_words, uniforms, words_of

REPORT, SEVEN_FOOT = report_table(), pool_table('7ft')


def plan_of(table, positions=None, samples=None, keep=None, balls=None, **inputs):
    return checked_plan(
        table, checked_inputs(table, inputs), positions, samples, 5, keep, balls, 1000
    )


def played(plan):
    return Player(plan, 1).play(plan.region(0))


def assert_same(table, found, shot, velocity, **given):
    one = simulate(table, velocity, **given)
    assert found['finals'][shot].tobytes() == one.final_positions.tobytes()
    assert found['durations'][shot] == one.duration
    assert found['event_counts'][shot] == len(one.events)
    if 'pocketed' in found:
        np.testing.assert_array_equal(found['pocketed'][shot], one.pocketed)


def test_coefficients_make_tables_of_their_own():
    plan = plan_of(REPORT, vx=[-4.0, -3.0], vy=0.1, e_ball_ball=[0.5, 0.9])
    found = played(plan)
    for k, (e, vx) in enumerate([(0.5, -4.0), (0.5, -3.0), (0.9, -4.0), (0.9, -3.0)]):
        assert_same(dataclasses.replace(REPORT, e_ball_ball=e), found, k, (vx, 0.1))


def test_a_fixed_coefficient_counts_too():
    found = played(plan_of(REPORT, vx=[-4.0, -3.0], vy=0.1, e_ball_ball=0.5))
    assert_same(dataclasses.replace(REPORT, e_ball_ball=0.5), found, 1, (-3.0, 0.1))


def test_spins_and_places():
    plan = plan_of(SEVEN_FOOT, vx=2.0, vy=[0.0, 0.3], wz=[-20.0, 20.0], x_C=0.5, y_C=0.6)
    found, places = played(plan), np.array(SEVEN_FOOT.positions)
    places[0] = 0.5, 0.6
    assert_same(SEVEN_FOOT, found, 2, (2.0, 0.3), spins=(0, 0, -20.0), positions=places)


def test_a_cue_gives_velocity_and_spin_and_may_slip_off():
    found = played(plan_of(SEVEN_FOOT, cue_speed=2.0, azimuth=180.0, side=[0.0, 0.3, 0.6]))
    velocities, spins = cue_strikes(SEVEN_FOOT, 2.0, 180.0, 0.0, [0.0, 0.3, 0.6])
    for k in (0, 1):
        assert_same(SEVEN_FOOT, found, k, velocities[k], spins=spins[k])
    assert found['failed'].tolist() == [0, 0, CANNOT_BE]
    assert np.isnan(found['finals'][2]).all() and found['event_counts'][2] == -1
    assert (found['pocketed'][2] == -1).all() and found['first_hit'][2] == -1


def test_layouts_are_a_dimension():
    moved = np.array(REPORT.positions)
    moved[0, 1] += 0.1
    found = played(plan_of(REPORT, np.stack([REPORT.positions, moved]), vx=[-4.0, -3.0], vy=0.0))
    assert_same(REPORT, found, 1, (-3.0, 0.0))
    assert_same(REPORT, found, 2, (-4.0, 0.0), positions=moved)


def test_jitter_moves_every_ball_by_what_is_drawn():
    still = plan_of(REPORT, samples=300, vx=0.0, vy=0.0, jitter=1e-4)
    moved = played(still)['finals'] - REPORT.positions
    assert abs(moved.std() - 1e-4) < 5e-6 and abs(moved.mean()) < 1e-5
    assert len(np.unique(moved)) > 0.9 * moved.size


def test_a_layout_that_cannot_be_fails_alone():
    found = played(plan_of(REPORT, vx=-4.0, vy=0.0, x_9=[0.5, -1.0], y_9=0.2))
    assert found['failed'].tolist() == [0, 1] and np.isnan(found['durations'][1])


def test_drawn_coefficients_and_those_that_cannot_be():
    plan = plan_of(REPORT, samples=20, vx=-4.0, vy=0.0, e_ball_ball=normal(0.95, 0.05))
    found = played(plan)
    drawn = found['e_ball_ball']
    np.testing.assert_array_equal(found['failed'] == CANNOT_BE, drawn > 1.0)
    shot = int(np.flatnonzero(drawn <= 1.0)[0])
    assert 0 < (drawn > 1.0).sum() < 20
    assert_same(dataclasses.replace(REPORT, e_ball_ball=drawn[shot]), found, shot, (-4.0, 0.0))


def test_only_what_is_kept_of_those_that_are_kept():
    plan = plan_of(REPORT, keep=['finals', 'pocketed'], balls=['9', 'C'], vx=[-4.0, -3.0], vy=0.1)
    found = played(plan)
    assert list(found) == ['finals', 'pocketed'] and (found['pocketed'] == -1).all()
    one = simulate(REPORT, (-3.0, 0.1)).final_positions
    np.testing.assert_array_equal(found['finals'][1], one[[REPORT.index('9'), 0]])


def test_a_player_uses_its_memory_again_and_that_changes_nothing():
    plan = plan_of(REPORT, samples=50, angle=uniform(0, 360), speed=[1.0, 4.0])
    player = Player(plan, 1)
    first = {name: values.copy() for name, values in player.play(plan.region(0)).items()}
    for name, values in player.play(plan.region(0)).items():
        assert values.tobytes() == first[name].tobytes()


def test_what_is_drawn_piece_by_piece_is_drawn_shot_by_shot(monkeypatch):
    inputs = {'vx': normal([-4.0, -3.0], 0.1), 'vy': uniform(-0.1, 0.1), 'jitter': 1e-4}
    plan = plan_of(REPORT, samples=40, **inputs)
    whole = {name: values.copy() for name, values in played(plan).items()}
    monkeypatch.setattr('pool_sim_ros.study.workspace.PIECE', 7)
    for name, values in played(plan).items():
        assert values.tobytes() == whole[name].tobytes()
    assert whole['vy'][43] == -0.1 + 0.2 * uniforms(single_words(5, 'vy', 43, 1))[0]
    words = words_of(5, 'vx', 43, 1)
    assert whole['vx'][43] == -3.0 + 0.1 * normals(words)[0, 0]
    noise = [normals(words_of(5, f'jitter {k}', 43, 1))[0] for k in range(6)]
    layout = REPORT.positions + 1e-4 * np.concatenate(noise)[:22].reshape(11, 2)
    assert_same(REPORT, whole, 43, (whole['vx'][43], whole['vy'][43]), positions=layout)


@pytest.mark.parametrize('value', [0.5, 7.0])
def test_a_table_with_another_coefficient(value):
    table = table_with(REPORT, ('e_ball_ball',), (value,))
    assert table is None if value > 1 else table.e_ball_ball == value
