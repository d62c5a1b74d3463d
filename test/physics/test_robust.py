"""Shots that break engines: each must end, keep the balls apart and inside, and repeat exactly."""

import itertools
import math

import naive_events
import numpy as np
import pytest
from soundness import V_MIN, assert_sound
from tables import (
    LAWS,
    random_layout,
    random_table,
    random_velocity,
    table_of,
    under,
)
from thinned import every, soak

from pool_sim_ros.physics import (
    Ball,
    Table,
    compile_kernels,
    report_table,
    simulate_many,
)

GRID = list(itertools.product(range(8), range(8)))
TINY = (0.0, 1e-14, -1e-14, 1e-12, -1e-12)


@pytest.fixture(scope='module', autouse=True)
def compiled():
    compile_kernels(report_table())


def sound_under_both_laws(table, velocities, **options):
    for law in LAWS:
        assert_sound(under(table, ball_friction=law), velocities, **options)


@pytest.mark.parametrize('restitution', [0.7, 1.0, 0.0])
def test_a_ball_at_a_cushion(restitution):
    shots = [(-1, 0), (-1, 0.3), (0, 1), (1, 0), (-1e-12, 1), (1e-12, 1), (-1e-300, 1), (-5e-5, 1)]
    ulp = np.spacing(0.05)
    for gap, velocity in itertools.product((*TINY, ulp, -ulp), shots):
        near = table_of([(0.05 + gap, 0.5)], e_ball_cushion=restitution)
        sound_under_both_laws(near, velocity)


@pytest.mark.parametrize('e', [1.0, 0.9, 0.5, 0.0])
@pytest.mark.parametrize('e_ball_cushion', [1.0, 0.7, 0.0])
def test_a_ball_frozen_on_a_cushion_is_struck(e, e_ball_cushion):
    elastic = dict(e_cue_ball=e, e_ball_ball=e, e_ball_cushion=e_ball_cushion)
    for gap, y in itertools.product(TINY, (0.5, 0.52, 0.599)):
        sound_under_both_laws(table_of([(0.6, y), (0.05 + gap, 0.5)], **elastic), (-3, 0))


@pytest.mark.parametrize('e', [1.0, 0.7, 0.0])
def test_corners(e):
    for gap in TINY:
        resting = table_of([(0.5, 0.5), (0.05 + gap, 0.05 + gap)], e_ball_cushion=e, e_cue_ball=e)
        sound_under_both_laws(resting, (-2.0, -2.0))
        sound_under_both_laws(resting, (-2.0, -2.02))
    for off in (0.0, 1e-12, 1e-9, 1e-6, -1e-6):
        sound_under_both_laws(table_of([(0.3, 0.3 + off)], e_ball_cushion=e), (-1.0, -1.0))
    three = table_of([(0.05, 0.05), (0.15, 0.05), (0.05, 0.15), (0.5, 0.5)], e_ball_cushion=e)
    sound_under_both_laws(three, [(0, 0), (-1, 0), (0, -1), (-2, -2)])


def rack(rows, gap, radius=0.0285):
    apart = 2 * radius + gap
    return [
        (1.4 + row * apart * math.sqrt(3) / 2, 0.6 + (k - row / 2) * apart)
        for row in range(rows)
        for k in range(row + 1)
    ]


@pytest.mark.parametrize(
    ('rows', 'gap', 'speed'), every(2, [4, 5], [0.0, 1e-12, 1e-9, 1e-6, 1e-4], [1.0, 4.0, 10.0])
)
def test_racks(rows, gap, speed):
    for off in (0.0, 0.02):
        places = [(0.5, 0.6 + off), *rack(rows, gap)]
        table = table_of(places, length=2.6, width=1.2, radius=0.0285, mass=0.17)
        sound_under_both_laws(table, (speed, 0.0))


@pytest.mark.parametrize('gap', [0.0, 1e-6])
def test_a_rack_of_55(gap):
    table = table_of([(0.5, 0.6), *rack(10, gap)], length=2.6, width=1.2, radius=0.0285, mass=0.17)
    sound_under_both_laws(table, (10.0, 0.0))


@pytest.mark.parametrize('e', [1.0, 0.95, 0.1, 0.0])
@pytest.mark.parametrize('count', [3, 4, 5])
def test_cradles(count, e):
    for gap, power in itertools.product((0.0, 1e-12, 1e-9, -5e-10), (0, 2)):
        places = [(0.3, 0.5)] + [(0.8 + k * (0.1 + gap), 0.5) for k in range(count - 1)]
        balls = [
            Ball(str(k), 0.1 * (k + 1) ** power, 0.05, place, is_cue=k == 0)
            for k, place in enumerate(places)
        ]
        table = Table(2.0, 1.0, balls, e_cue_ball=e, e_ball_ball=e)
        sound_under_both_laws(table, (2.0, 0.0))
        from_both_ends = [(2.0, 0.0)] + [(0.0, 0.0)] * (count - 2) + [(-1.0, 0.0)]
        sound_under_both_laws(table, from_both_ends)


@pytest.mark.parametrize('e', [1.0, 0.95, 0.1, 0.0])
@pytest.mark.parametrize('e_ball_cushion', [1.0, 0.7, 0.0])
def test_a_line_of_balls_against_a_cushion(e, e_ball_cushion):
    elastic = dict(e_cue_ball=e, e_ball_ball=e, e_ball_cushion=e_ball_cushion)
    for count, gap in itertools.product((3, 5), (0.0, 1e-12, 1e-6)):
        places = [(0.3, 0.5)] + [(1.95 - k * (0.1 + gap), 0.5) for k in range(count - 1)]
        sound_under_both_laws(table_of(places, **elastic), (2.0, 0.0))


@pytest.mark.parametrize('e', [1.0, 0.9, 0.0])
def test_stops_at_a_contact(e):
    deceleration = report_table().deceleration
    way = 1.0 / (2 * deceleration)
    for off in (0.0, 1e-15, 1e-12, 1e-9, 1e-6, -1e-15, -1e-12, -1e-9, -1e-6):
        at_ball = table_of([(0.3, 0.5), (0.4 + way + off, 0.5)], e_cue_ball=e)
        sound_under_both_laws(at_ball, (1.0, 0.0))
        at_cushion = table_of([(0.3, 0.5)], length=0.35 + way + off, e_ball_cushion=e)
        sound_under_both_laws(at_cushion, (1.0, 0.0))
        both_stop = table_of([(0.3, 0.5), (0.4 + 2 * way + off, 0.5)], e_cue_ball=e)
        sound_under_both_laws(both_stop, [(1.0, 0.0), (-1.0, 0.0)])


@pytest.mark.parametrize('e', [1.0, 0.9, 0.0])
def test_grazes(e):
    sizes = (0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3)
    for clearance in (*sizes, *(-size for size in sizes)):
        table = table_of([(0.3, 0.5), (0.8, 0.6 + clearance)], e_cue_ball=e)
        for other in ((0, 0), (-2, 0), (1, 0), (1.9, 0.0)):
            sound_under_both_laws(table, [(2.0, 0.0), other])


@pytest.mark.parametrize('gap', [0.0, 1e-12, 1e-9, 1e-6, 1e-3, -5e-10])
@pytest.mark.parametrize('e', [1.0, 0.0])
def test_equal_and_nearly_equal_velocities(gap, e):
    beside = table_of([(0.5, 0.5), (0.5, 0.6 + gap)], e_cue_ball=e)
    behind = table_of([(0.5, 0.5), (0.6 + gap, 0.5)], e_cue_ball=e)
    for change in (0.0, 1e-15, -1e-12, 1e-9, -1e-6, 1e-4):
        sound_under_both_laws(beside, [(1.0, 0.0), (1.0, change)])
        sound_under_both_laws(beside, [(1.0, 1.0), (1.0, -1.0 + change)])
        sound_under_both_laws(beside, [(1.0, 0.5), (2.0, 0.5 + change)])
        sound_under_both_laws(behind, [(1.0, 0.0), (1.0 + change, 0.0)])
        sound_under_both_laws(behind, [(1.0, 0.0), (-1.0 - change, 0.0)])


@pytest.mark.parametrize('speed', [1e-300, 1e-20, 1e-12, 1e-9, 1e-6, 1e-3, 1.0, 100.0])
def test_speeds_from_almost_nothing_to_100_m_per_s(speed):
    fan = [(speed * math.cos(k), speed * math.sin(k)) for k in range(11)]
    sound_under_both_laws(report_table(), fan, most_events=100_000)
    touching = table_of([(0.5, 0.5), (0.6, 0.5), (0.55, 0.5 + 0.05 * math.sqrt(3))])
    for along in ((1, 0), (1, 1), (-1, 0)):
        sound_under_both_laws(touching, np.multiply(speed, along))


@pytest.mark.parametrize('ratio', [1000.0, 1.0, 0.001])
@pytest.mark.parametrize('radius', [0.05, 5e-5])
def test_masses_and_radii_a_thousandfold_apart(ratio, radius):
    balls = [
        Ball('a', 0.1, 0.05, (0.3, 0.5), is_cue=True),
        Ball('b', 0.1 * ratio, radius, (0.8, 0.5)),
        Ball('c', 0.1 / ratio, radius, (0.8, 0.5 + 2 * radius)),
        Ball('d', 0.1 * ratio, 0.05, (0.85 + radius, 0.5)),
    ]
    for e, across in itertools.product((1.0, 0.7, 0.0), (0.0, 0.1)):
        table = Table(2.0, 1.0, balls, e_cue_ball=e, e_ball_ball=e)
        sound_under_both_laws(table, (3.0, across))


def test_a_ball_that_a_collision_stops_dead_is_in_the_way():
    """Equal masses, e = 1: ball 0 stops exactly where ball 2 is heading."""
    places = [(0.25, 0.5), (0.75, 0.5), (0.625, 0.9)]
    lossless = dict(mu_ball_ball=0.0, mu_ball_surface=0.0, e_cue_ball=1.0, e_ball_ball=1.0)
    table = table_of(places, radius=0.0625, mass=1.0, ball_friction='coulomb', **lossless)
    shot = assert_sound(table, [(1.0, 0.0), (0.0, 0.0), (0.0, -0.5)], until=1.0)
    assert (0, 0, 2) in shot.events[['kind', 'a', 'b']].tolist()


@pytest.mark.parametrize(
    'velocity',  # found among a million random shots
    [
        (-3.9706859238996057, 0.4230753827606785),
        *soak(
            [-4.822651705627597, -3.1604251295734396],
            [-3.898047371511313, 0.4151587704491879],
        ),
    ],
)
def test_inelastic_collapse_on_the_report_table(velocity):
    """Two moving balls bounce on each other ever faster; what ends it moves them little."""
    table = under(report_table(), ball_friction='coulomb')
    shot = assert_sound(table, velocity, most_events=1000)
    hits = shot.events[shot.events['kind'] == 0]
    assert np.any(hits['speed'] < V_MIN)
    twin = naive_events.event_driven(table, velocity)
    assert np.abs(shot.final_positions - twin.positions).max() < 1e-6


@pytest.mark.parametrize('slack', [0.0, 1e-12])
@pytest.mark.parametrize('e_ball_cushion', [0.7, 1.0])
def test_wedged_between_cushions(slack, e_ball_cushion):
    channel = table_of([(0.5, 0.05), (0.8, 0.05)], width=0.1 + slack, e_ball_cushion=e_ball_cushion)
    for velocity in ((1.0, 0.0), (1.0, 0.3), (0.0, 1.0), (1.0, 1e-6)):
        sound_under_both_laws(channel, velocity)


@pytest.mark.parametrize('e_ball_cushion', [0.7, 1.0])
def test_two_balls_wedged_between_cushions(e_ball_cushion):
    elastic = dict(e_ball_cushion=e_ball_cushion, e_cue_ball=1.0, e_ball_ball=1.0)
    full = table_of([(0.05, 0.05), (0.15, 0.05)], length=0.2, width=0.1, **elastic)
    sound_under_both_laws(full, [(1.0, 0.5), (-1.0, 0.3)])
    places = [(0.5, 0.05), (0.5, 0.15), (0.8, 0.05), (0.8, 0.15), (1.0, 0.1)]
    across = table_of(places, width=0.2, **elastic)
    for velocity in ((0.0, 1.0), (1.0, 0.3)):
        sound_under_both_laws(across, velocity)


def test_balls_that_fill_the_table_from_rail_to_rail():
    """Rails return nearly all: that rounding has them part is no reason to give a shot up."""
    rng = np.random.default_rng(1)
    for _ in range(40):
        radius = float(rng.choice([0.03, 0.05, 0.06]))
        radii = [radius, *rng.choice([radius, radius / 2], rng.integers(0, 6))]
        ends = np.cumsum(2.0 * np.array(radii) + rng.choice([0.0, 0.05], len(radii)))
        table = Table(
            float(ends[-1] + rng.choice([0.0, 0.1])),
            2.0 * radius * (1.0 + float(rng.choice([0.0, 1e-16, 1e-12, 1e-10]))),
            [
                Ball(str(k), 10.0 ** rng.uniform(-2.0, 0.0), r, (end - r, radius), is_cue=k == 0)
                for k, (r, end) in enumerate(zip(radii, ends.tolist(), strict=True))
            ],
            mu_ball_ball=float(rng.choice([0.0, 0.06])),
            mu_ball_surface=0.05,
            mu_ball_cushion=float(rng.choice([0.0, 0.2])),
            e_cue_ball=float(rng.choice([0.0, 0.5, 1.0])),
            e_ball_ball=float(rng.choice([0.0, 0.5, 1.0])),
            e_ball_cushion=float(rng.choice([0.9, 0.99, 1.0])),
            ball_friction='coulomb',
        )
        outcomes = simulate_many(table, rng.normal(0.0, 2.0, (10, 2)), until=2.0, errors='mark')
        assert not outcomes.failed.any() and np.isfinite(outcomes.finals).all()
        assert outcomes.event_counts.max() < 20_000


@pytest.mark.parametrize('law', LAWS)
def test_random_tables(law):
    """Also with nothing that takes energy, or everything; the report's law where it is tame."""
    rng = np.random.default_rng(71)
    for count in (1, 2, 3, 5, 10, 20, 40):
        for _ in range(6):
            fields = {}
            if law == 'coulomb':
                fields['e_ball_ball'] = rng.choice([0.0, 0.5, 1.0])
                fields['e_cue_ball'] = rng.choice([0.0, 0.5, 1.0])
                fields['e_ball_cushion'] = rng.choice([0.0, 0.5, 1.0])
                fields['mu_ball_ball'] = rng.choice([0.0, 0.1, 2.0])
            else:
                fields['mu_ball_ball'] = 0.05
                fields['e_ball_ball'] = fields['e_cue_ball'] = 0.8
            fields['mu_ball_surface'] = 0.2
            table = random_table(rng, count, law, **fields)
            velocities = [random_velocity(rng, 0.01, 5.0) for _ in range(count)]
            assert_sound(table, velocities, most_events=100_000)


def test_lattices_of_touching_balls():
    rng = np.random.default_rng(72)
    for gap, e in itertools.product((0.0, 1e-12, 1e-9, 1e-6), (1.0, 0.9, 0.0)):
        apart = 0.1 + gap
        square = [(0.3 + i * apart, 0.25 + j * apart) for i in range(4) for j in range(3)]
        table = table_of(square, length=1.5, width=1.2, e_cue_ball=e, e_ball_ball=e)
        steps = rng.choice([-1.0, 0.0, 1.0], size=(len(square), 2))
        sound_under_both_laws(table, steps, most_events=50_000)


@pytest.mark.parametrize('law', LAWS)
def test_crowded_tables(law):
    rng = np.random.default_rng(73)
    for count in (60, 100):
        places = random_layout(rng, np.full(count, 0.02), 1.4, 0.8)
        table = table_of(places, length=1.4, width=0.8, radius=0.02, ball_friction=law)
        velocities = [random_velocity(rng, 0.1, 2.0) for _ in range(count)]
        assert_sound(table, velocities, most_events=100_000)


def test_a_crowd_on_a_grid():
    """Balls that move along and across the lines on which a table may be divided."""
    rng = np.random.default_rng(74)
    for side, off in itertools.product((0.25, 0.125), (0.0, 0.25)):
        centers = [(side * (i + 0.5 - off), side * (j + 0.5 - off)) for i, j in GRID]
        table = table_of(centers, length=8 * side, width=8 * side, radius=side / 4)
        sound_under_both_laws(table, rng.choice([-1.0, 0.0, 1.0], size=(64, 2)), until=0.3)
