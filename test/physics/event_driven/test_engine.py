"""The exact integrator against the high-precision oracle and the plain event loop."""

import dataclasses
import math

import naive_events
import numpy as np
import oracle
import pytest
from tables import LAWS, random_layout, random_table, random_velocity, report_shots, table_of
from thinned import soak

from pool_sim_ros.physics import Ball, Table, report_table, simulate


def assert_equals_oracle(table, velocities, within=1e-9, **start):
    """Compare a whole shot; return False where the oracle finds it ambiguous."""
    try:
        exact = oracle.simulate(table, velocities, **start)
    except oracle.AmbiguousShotError:
        return False
    shot = simulate(table, velocities, **start)
    assert np.abs(shot.final_positions - exact.final_positions).max() < within
    assert shot.duration == pytest.approx(exact.duration, abs=within)
    found = [(int(e['kind']), int(e['a']), int(e['b'])) for e in shot.events]
    assert found == [event[1:] for event in exact.events]
    times = [event[0] for event in exact.events]
    np.testing.assert_allclose(shot.events['t'], times, rtol=0, atol=within)
    return True


@pytest.mark.parametrize('law', LAWS)
def test_random_shots_on_the_report_table_equal_the_oracle(law):
    table = dataclasses.replace(report_table(), ball_friction=law)
    rng = np.random.default_rng(31)
    compared = sum(assert_equals_oracle(table, random_velocity(rng)) for _ in range(25))
    assert compared >= 23


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('shot', [1, 2, 3, 4])
def test_report_shots_equal_the_oracle(shot, law):
    table = dataclasses.replace(report_table(), ball_friction=law)
    assert assert_equals_oracle(table, report_shots()[shot - 1])


@pytest.mark.parametrize('law', LAWS)
def test_random_tables_equal_the_oracle(law):
    rng = np.random.default_rng(32)
    compared = 0
    for _ in range(12):
        table = random_table(rng, rng.integers(1, 7), law, mu_ball_surface=0.2)
        velocities = [random_velocity(rng, 0.2, 1.5) for _ in table.balls]
        compared += assert_equals_oracle(table, velocities)
    assert compared >= 10


@pytest.mark.parametrize('law', LAWS)
def test_without_surface_friction_equals_the_oracle(law):
    rng = np.random.default_rng(33)
    compared = 0
    for _ in range(6):
        table = random_table(rng, 5, law, mu_ball_surface=0.0)
        velocities = [random_velocity(rng, 0.2, 1.5) for _ in table.balls]
        compared += assert_equals_oracle(table, velocities, until=1.5)
    assert compared >= 5


@pytest.mark.parametrize('law', ['coulomb', *soak('report')])
def test_crowded_tables_equal_the_oracle(law):
    """So many balls that not every pair is looked at."""
    rng = np.random.default_rng(36)
    radii = rng.uniform(0.005, 0.03, 50)
    places = random_layout(rng, radii, 1.5, 0.9)
    balls = [Ball(str(k), 0.16, radii[k], tuple(places[k]), is_cue=k == 0) for k in range(50)]
    table = Table(1.5, 0.9, balls, ball_friction=law)
    velocities = [random_velocity(rng, 0.1, 2.0) for _ in range(50)]
    assert assert_equals_oracle(table, velocities, until=0.2)


def test_cut_by_until_equals_the_oracle():
    table = report_table()
    rng = np.random.default_rng(34)
    cuts = rng.uniform(0.2, 1.5, 6)
    assert all(assert_equals_oracle(table, random_velocity(rng, 2, 5), until=t) for t in cuts)


def test_other_start_positions_equal_the_oracle():
    table = table_of([(0.5, 0.5), (1.0, 0.5), (1.5, 0.52)])
    positions = [(1.7, 0.2), (0.3, 0.25), (0.9, 0.22)]
    assert assert_equals_oracle(table, (-2.0, 0.05), positions=positions)


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('shot', [0, 1, 2])
def test_time_slicing_converges_to_first_order(shot, law):
    """A tenth of the slice, about a tenth of the error, where both see the same contacts."""
    table = dataclasses.replace(report_table(), ball_friction=law)
    velocity = report_shots()[shot]
    exact = simulate(table, velocity)
    contacts = exact.events[exact.events['kind'] != 2][['kind', 'a', 'b']]
    errors = []
    for time_slice in (1e-5, 1e-6):
        sliced = simulate(table, velocity, integrator='time_slice', time_slice=time_slice)
        seen = sliced.events[sliced.events['kind'] != 2][['kind', 'a', 'b']]
        assert seen.tolist() == contacts.tolist()
        errors.append(np.abs(sliced.final_positions - exact.final_positions).max())
    assert errors[1] < 1e-3
    # One contact's error hangs on where in its slice it falls, so a factor of ten varies.
    assert errors[1] < 0.5 * errors[0]


CLUSTERS = {
    'two at once, symmetric': ([(0.5, 0.5), (0.8, 0.5505), (0.8, 0.4495)], (2.0, 0.0)),
    'two touching': ([(0.5, 0.5), (0.8, 0.55), (0.8, 0.45)], (2.0, 0.0)),
    'two touching, off centre': ([(0.5, 0.51), (0.8, 0.55), (0.8, 0.45)], (2.0, 0.0)),
    'cradle of three': ([(0.5, 0.5), (0.8, 0.5), (0.9, 0.5)], (2.0, 0.0)),
    'cradle of four': ([(0.5, 0.5), (0.8, 0.5), (0.9, 0.5), (1.0, 0.5)], (2.0, 0.0)),
    'frozen on a cushion': ([(0.5, 0.2), (0.8, 0.05)], (2.0, -0.9)),
    'frozen on a cushion, square': ([(0.8, 0.5), (0.8, 0.05)], (0.0, -2.0)),
    'in a corner': ([(1.7, 0.7), (1.95, 0.95)], (2.0, 2.0)),
    'into a corner': ([(1.7, 0.7)], (2.0, 2.0)),
    'triangle': ([(0.5, 0.5), (1.0, 0.5), (1.0 + 0.05 * 3**0.5, 0.55)], (3.0, 0.1)),
}


@pytest.mark.parametrize('e', [1.0, 0.9, 0.5])
@pytest.mark.parametrize('case', CLUSTERS)
def test_several_contacts_at_one_instant_equal_the_plain_loop(case, e):
    positions, velocity = CLUSTERS[case]
    table = table_of(
        positions,
        ball_friction='coulomb',
        e_cue_ball=e,
        e_ball_ball=e,
        mu_ball_ball=0.1,
        mu_ball_surface=0.3,
    )
    # Where something presses on, it is parted at 1e-4 m/s, by a rule of which only this speed is
    # laid down: it moves a ball by (1e-4 m/s)^2 / 2 a, some 1e-9 m.
    until = 0.3
    twin = naive_events.event_driven(table, velocity, until=until)
    shot = simulate(table, velocity, until=until)
    assert np.abs(shot.final_positions - twin.positions).max() < 1e-8
    assert np.abs(shot.final_velocities - twin.velocities).max() < 1e-6


@pytest.mark.parametrize('e', [1.0, 0.8, 0.5])
def test_touching_balls_all_in_motion_equal_the_plain_loop(e):
    """In a corner: several clusters, several rounds of contacts in one instant."""
    rng = np.random.default_rng(35)
    corner = [(0.05 + 0.1 * i + 0.05 * j, 0.05 + j * 0.05 * 3**0.5) for i in (0, 1) for j in (0, 1)]
    for _ in range(8):
        table = table_of(corner, ball_friction='coulomb', e_cue_ball=e, e_ball_ball=e)
        velocities = rng.normal(size=(4, 2))
        twin = naive_events.event_driven(table, velocities, until=1e-6)
        shot = simulate(table, velocities, until=1e-6)
        assert np.abs(shot.final_velocities - twin.velocities).max() < 1e-9


def test_balls_that_touch_at_rest_do_nothing():
    spots = [(0.3, 0.5), (0.5, 0.5), (0.6, 0.5), (0.55, 0.5 + 0.05 * math.sqrt(3))]
    table = table_of(spots)
    shot = simulate(table, (0.0, 0.0))
    assert len(shot.events) == 0
    assert shot.duration == 0.0
    np.testing.assert_array_equal(shot.final_positions, spots)
