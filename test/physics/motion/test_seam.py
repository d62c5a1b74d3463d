"""The engine knows no law of motion: it plays another one, of which only the tests know.

On a cloth without friction a disc moves as a point that nothing slows, and so must play alike.
"""

import numpy as np
import pytest
from benchmark.workloads import dense_table, random_velocities
from numba import njit
from plain_engine import play_in_plain_python
from point_motion import IMPLEMENTATIONS, PointTable, point_table
from seam_shots import play_on
from seams import chosen_functions
from tables import LAWS, random_shots, under

from pool_sim_ros.physics import motion, report_table, simulate
from pool_sim_ros.physics.motion import (
    MOVES,
    RESTS,
    BallTable,
    DiscTable,
    acceleration,
    path_from,
    position_at,
    set_off,
    velocity_at,
)


@njit
def set_off_and_look(balls, i, table, velocity, t):
    ball = balls[i]
    set_off(ball, table, velocity[0], velocity[1])
    return (
        position_at(ball, table, t),
        velocity_at(ball, table, t),
        acceleration(ball, table),
        path_from(ball, table, t),
    )


def frictionless_shots(law):
    """Return shots on a cloth without friction, (table, velocities, until)."""
    table = under(report_table(), mu_ball_surface=0.0, ball_friction=law)
    shots = [(table, velocity, 1.5) for velocity in random_velocities(40, seed=21)]
    shots += [
        (table, velocities, 0.7)
        for table, velocities in random_shots(22, 10, law, mu_ball_surface=0.0)
    ]
    many = under(dense_table(45, decelerating=False), ball_friction=law)
    shots.append((many, np.random.default_rng(23).normal(size=(45, 2)), 0.03))
    return shots


def on_points(table, velocities, until):
    """Return the arguments of `play_on` for a shot in which nothing slows the balls."""
    return point_table(table), table.balls_at_rest, velocities, until


def assert_plays_as_a_disc(found, table, velocities, until):
    expected = simulate(table, velocities, until=until)
    assert found.events[['kind', 'a', 'b']].tolist() == expected.events[['kind', 'a', 'b']].tolist()
    assert np.abs(found.events['t'] - expected.events['t']).max(initial=0.0) < 1e-9
    assert np.abs(found.final_positions - expected.final_positions).max() < 1e-9
    assert np.abs(found.final_velocities - expected.final_velocities).max() < 1e-8
    return len(found.events)


def test_every_function_has_an_implementation_for_each_motion():
    declared = chosen_functions(motion)
    assert len(declared) == 27
    for name, function in declared.items():
        assert {BallTable, DiscTable} <= set(function.implementations), name


def test_nothing_is_asked_of_a_motion_but_what_it_registers():
    assert set(IMPLEMENTATIONS) == set(chosen_functions(motion).values())


@pytest.mark.parametrize('law', LAWS)
def test_another_motion_plays_through_the_same_engine(law, tmp_path):
    """As plain Python: to compile the engine once more would take half a minute."""
    shots = frictionless_shots(law)
    played = play_in_plain_python([on_points(*shot) for shot in shots], tmp_path)
    events = sum(
        assert_plays_as_a_disc(shot, *given) for shot, given in zip(played, shots, strict=True)
    )
    assert events > 300


@pytest.mark.soak
@pytest.mark.parametrize('law', LAWS)
def test_another_motion_plays_through_the_compiled_engine(law):
    for shot in frictionless_shots(law):
        assert_plays_as_a_disc(play_on(*on_points(*shot)), *shot)


@pytest.mark.parametrize('law', LAWS)
def test_the_compiled_engine_gives_the_bits_of_plain_python(law, tmp_path):
    table = under(report_table(), ball_friction=law)
    shots = [(table, velocity, 100.0) for velocity in random_velocities(40, seed=24)]
    shots += [(*shot, 1.0) for shot in random_shots(25, 10, law)]
    shots.append((dense_table(45, decelerating=True), np.ones((45, 2)), 0.1))
    given = [
        (table.for_kernels, table.balls_at_rest, velocities, until)
        for table, velocities, until in shots
    ]
    played = play_in_plain_python(given, tmp_path)
    for plain, (table, velocities, until) in zip(played, shots, strict=True):
        shot = simulate(table, velocities, until=until)
        assert plain.events.tobytes() == shot.events.tobytes()
        assert plain.segments.tobytes() == shot.segments.tobytes()
        assert plain.final_positions.tobytes() == shot.final_positions.tobytes()
        assert plain.final_velocities.tobytes() == shot.final_velocities.tobytes()
        assert plain.duration == shot.duration


def test_the_compiler_chooses_by_the_table_too():
    table = under(report_table(), mu_ball_surface=0.1)
    balls = table.balls_at_rest.copy()
    x, y = table.positions[2]
    slowing = table.deceleration
    found = set_off_and_look(balls, 2, table.for_kernels, (3.0, 4.0), 0.5)
    assert balls[2]['phase'] == MOVES
    distance = 5.0 * 0.5 - 0.5 * slowing * 0.25
    assert found[0] == pytest.approx((x + 0.6 * distance, y + 0.8 * distance), abs=1e-14)
    assert found[1] == pytest.approx((0.6 * (5.0 - 0.5 * slowing), 0.8 * (5.0 - 0.5 * slowing)))
    assert found[2] == pytest.approx((-0.6 * slowing, -0.8 * slowing))
    balls = table.balls_at_rest.copy()
    found = set_off_and_look(balls, 2, point_table(table), (3.0, 4.0), 0.5)
    assert isinstance(point_table(table), PointTable)
    assert found[:3] == ((x + 1.5, y + 2.0), (3.0, 4.0), (0.0, 0.0))
    assert found[3] == (x + 1.5, y + 2.0, 3.0, 4.0)
    set_off_and_look(balls, 2, point_table(table), (0.0, 0.0), 0.5)
    assert balls[2]['phase'] == RESTS
