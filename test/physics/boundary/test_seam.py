"""The engine knows no rectangle: it plays within straight cushions in any direction.

There are such only here. Given as four lines, a rectangle must play as the package's own.
"""

import dataclasses
import math

import numpy as np
import pytest
from benchmark.workloads import dense_table, random_velocities
from numba import njit
from plain_engine import play_in_plain_python
from seam_shots import play_on
from seams import chosen_functions
from straight_cushions import IMPLEMENTATIONS, polygon, rectangle_of, turned
from tables import LAWS, random_shots, table_of

from pool_sim_ros.physics import boundary, report_table, simulate
from pool_sim_ros.physics.boundary import (
    cushion_gap,
    cushion_normal,
    distance_to_cushions,
    from_cushion_axes,
    n_cushions,
    to_cushion_axes,
    touches_cushion,
)
from pool_sim_ros.physics.validation import first_fault


@pytest.fixture(params=['plain Python', pytest.param('compiled', marks=pytest.mark.soak)])
def play_all(request, tmp_path):
    """Play shots, each the arguments of `play_on`; to compile for a boundary takes long."""
    if request.param == 'compiled':
        return lambda shots: [play_on(*shot) for shot in shots]
    return lambda shots: play_in_plain_python(shots, tmp_path)


def within(table, other):
    """Return the kernels' table with another boundary."""
    return table.for_kernels._replace(boundary=other)


def turn(vectors, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return np.asarray(vectors) @ np.array([[c, s], [-s, c]])


def assert_same_contacts(found, expected):
    assert found[['kind', 'a', 'b']].tolist() == expected[['kind', 'a', 'b']].tolist()


def test_nothing_is_asked_of_a_boundary_but_what_it_registers():
    assert set(IMPLEMENTATIONS) == set(chosen_functions(boundary).values())


@pytest.mark.parametrize('law', LAWS)
def test_a_rectangle_of_four_lines_plays_as_the_rectangle(law, play_all):
    table = dataclasses.replace(report_table(), ball_friction=law)
    kernels_table = within(table, rectangle_of(table))
    cushions, velocities = 0, random_velocities(60, seed=11)
    shots = [(kernels_table, table.balls_at_rest, velocity) for velocity in velocities]
    for velocity, found in zip(velocities, play_all(shots), strict=True):
        expected = simulate(table, velocity)
        assert np.abs(found.final_positions - expected.final_positions).max() < 1e-12
        assert found.duration == pytest.approx(expected.duration, abs=1e-12)
        assert_same_contacts(found.events, expected.events)
        cushions += np.sum(found.events['kind'] == 1)
    assert cushions > 60


def test_a_crowded_rectangle_of_four_lines_plays_as_the_rectangle(play_all):
    table = dense_table(60, decelerating=True)
    velocities = np.random.default_rng(12).normal(size=(60, 2))
    expected = simulate(table, velocities, until=0.3)
    kernels_table = within(table, rectangle_of(table))
    (found,) = play_all([(kernels_table, table.balls_at_rest, velocities, 0.3)])
    assert np.sum(expected.events['kind'] == 1) > 10
    assert np.abs(found.final_positions - expected.final_positions).max() < 1e-12
    assert_same_contacts(found.events, expected.events)


@pytest.mark.parametrize(
    ('degrees', 'law'),
    [
        (30.0, 'coulomb'),
        (137.0, 'report'),
        *(
            pytest.param(degrees, law, marks=pytest.mark.soak)
            for degrees, law in [(30.0, 'report'), (90.0, 'report'), (90.0, 'coulomb')]
        ),
    ],
)
def test_a_table_that_is_turned_plays_the_turned_shot(degrees, law, play_all):
    """Shots of a few balls, slow, so that each contact multiplies the rounding but little."""
    given = list(random_shots(68, 20, law, balls=3, fastest=1.5, mu_ball_surface=0.2))
    shots, shifts, contacts = [], [], 0
    for table, velocities in given:
        size = table.length, table.width
        corners = turn([(0, 0), (size[0], 0), (0, size[1]), size], degrees)
        shifts.append(-corners.min(axis=0))
        length, width = np.ptp(corners, axis=0).tolist()
        other = turned(rectangle_of(table), degrees, shifts[-1])
        other = other._replace(length=length, width=width)
        records = table.balls_at_rest.copy()
        records['x'], records['y'] = (turn(table.positions, degrees) + shifts[-1]).T
        shots.append((within(table, other), records, turn(velocities, degrees)))
    for (table, velocities), shift, found in zip(given, shifts, play_all(shots), strict=True):
        expected = simulate(table, velocities)
        ends = turn(expected.final_positions, degrees) + shift
        assert np.abs(found.final_positions - ends).max() < 1e-9
        assert_same_contacts(found.events, expected.events)
        normals = np.column_stack([expected.events['nx'], expected.events['ny']])
        found_normals = np.column_stack([found.events['nx'], found.events['ny']])
        assert np.abs(found_normals - turn(normals, degrees)).max() < 1e-9
        contacts += np.sum(found.events['kind'] == 1)
    assert contacts > 8


def test_the_numbers_of_the_cushions_are_the_boundary_s(play_all):
    table, order = report_table(), (3, 0, 2, 1)
    kernels_table = within(table, rectangle_of(table, order))
    expected = simulate(table, (-4.0, 0.5))
    (found,) = play_all([(kernels_table, table.balls_at_rest, (-4.0, 0.5))])
    numbers = [order[b] for b in found.events['b'][found.events['kind'] == 1]]
    assert numbers == expected.events['b'][expected.events['kind'] == 1].tolist()


def hexagon(size=1.0):
    angles = np.arange(6) * math.pi / 3 + 0.1
    corners = size * np.column_stack([np.cos(angles), np.sin(angles)])
    return polygon(corners - corners.min(axis=0))


def test_a_table_of_six_sides_holds_the_balls(play_all):
    """No ball leaves it, energy falls, and each side is met."""
    cloth = hexagon()
    spots = [(1.0, 0.9), (0.6, 0.9), (1.3, 0.8), (0.9, 0.5)]
    table = table_of(spots, length=2.0, width=2.0, ball_friction='coulomb', mu_ball_surface=0.02)
    met = set()
    velocities = random_velocities(40, seed=13)
    kernels_table = within(table, cloth)
    for shot in play_all([(kernels_table, table.balls_at_rest, v) for v in velocities]):
        assert shot.complete
        for x, y in [*shot.final_positions, *shot.segments[['x', 'y']].tolist()]:
            assert np.min(cloth.offset - 0.05 - (cloth.nx * x + cloth.ny * y)) > -1e-9
        cushions = shot.events[shot.events['kind'] == 1]
        met |= set(cushions['b'].tolist())
        for event in cushions:
            assert (event['nx'], event['ny']) == (cloth.nx[event['b']], cloth.ny[event['b']])
            assert event['speed'] >= 0.0
    assert met == set(range(6))


def test_several_contacts_at_one_instant_at_a_slanted_cushion(play_all):
    """A ball frozen on a cushion is driven into it: the same as on the rectangle, turned."""
    table = table_of([(0.8, 0.5), (0.8, 0.05)], ball_friction='coulomb', e_ball_cushion=0.9)
    expected = simulate(table, (0.0, -2.0), until=0.5)
    other = turned(rectangle_of(table), 30.0, (1.0, 0.0))._replace(length=3.0, width=3.0)
    records = table.balls_at_rest.copy()
    records['x'], records['y'] = (turn(table.positions, 30.0) + (1.0, 0.0)).T
    (found,) = play_all([(within(table, other), records, turn((0.0, -2.0), 30.0), 0.5)])
    assert_same_contacts(found.events[:2], expected.events[:2])
    ends = turn(expected.final_positions, 30.0) + (1.0, 0.0)
    assert np.abs(found.final_positions - ends).max() < 1e-8


@njit
def asked(boundary, x, y, ux, uy):
    normal = cushion_normal(boundary, 2, x, y)
    parts = to_cushion_axes(boundary, 2, normal, (ux, uy))
    return (
        n_cushions(boundary),
        cushion_gap(boundary, 2, x, y, 0.05),
        normal,
        distance_to_cushions(boundary, x, y, ux, uy, 0.05),
        from_cushion_axes(boundary, 2, normal, parts),
        touches_cushion(boundary, x, y, 0.2, -1),
    )


def test_the_compiler_chooses_by_the_boundary_too():
    lines, plain = rectangle_of(report_table()), report_table().for_kernels.boundary
    for x, y in np.random.default_rng(15).uniform(0.1, 1.0, (50, 2)):
        found, expected = (np.hstack(asked(one, x, y, 0.6, -0.8)) for one in (lines, plain))
        np.testing.assert_allclose(found, expected, atol=1e-14)


def test_layouts_are_checked_by_the_boundary():
    cloth = hexagon()
    order, radii = np.array([0]), np.array([0.05])
    inside = 0
    for spot in np.random.default_rng(14).uniform(0.0, 2.0, (200, 2)):
        gap = np.min(cloth.offset - 0.05 - (cloth.nx * spot[0] + cloth.ny * spot[1]))
        found = first_fault(spot[np.newaxis], radii, cloth, order)
        assert found == ((-1, -1) if gap >= 0.0 else (0, -1))
        inside += gap >= 0.0
    assert 0 < inside < 200
