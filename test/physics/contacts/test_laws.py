"""The law of one contact that a table's type chooses: mirror images, momentum, energy, rolling."""

import math

import numpy as np
import pytest
from numba import njit
from spinning import RADIUS, random_strikes, spinning_table
from tables import table_of

from pool_sim_ros.physics.contacts.laws import bounce, collide_pair

MODELS = ('han', 'impulse', 'stronge', 'mathavan')
PLACES = [(0.6, 0.5), (0.9, 0.5)]


@njit
def pair(table, balls, va, vb, normal, parting):
    return collide_pair(table, balls[0], balls[1], va, vb, normal, parting)


@njit
def meet_cushion(table, balls, cushion, normal, velocity, speeds):
    return bounce(table, balls[0], cushion, normal, velocity, speeds)


def records(table, spins):
    balls = table.balls_at_rest.copy()
    for k, axis in enumerate('xyz'):
        balls[f'w{axis}'] = spins[:, k]
    return balls


def spins_of(balls):
    return np.column_stack([balls[f'w{axis}'] for axis in 'xyz'])


def hit(table, velocities, spins, normal):
    """Return both velocities and spins after balls 0 and 1 met."""
    balls = records(table, spins)
    closing = np.dot(velocities[0] - velocities[1], normal)
    va, vb = pair(
        table.for_kernels,
        balls,
        tuple(velocities[0]),
        tuple(velocities[1]),
        tuple(normal),
        table.e_cue_ball * closing,
    )
    return np.array([va, vb]), spins_of(balls)


def closing_pair(rng, table):
    """Return velocities and spins of two balls that meet, and the normal."""
    velocities, spins = random_strikes(rng, 2, (0.1, 5.0), 80.0)
    angle = rng.uniform(-math.pi, math.pi)
    normal = np.array([math.cos(angle), math.sin(angle)])
    if np.dot(velocities[0] - velocities[1], normal) < 0.0:
        normal = -normal
    return velocities, spins, normal


def energy(table, velocities, spins):
    parts = (velocities**2).sum(-1) + 0.4 * RADIUS**2 * (spins**2).sum(-1)
    return (table.masses * parts).sum() / 2


@pytest.fixture(params=[('coulomb', 'impulse'), ('alciatore', 'restitution')])
def table(request):
    law, bound = request.param
    fields = dict(ball_friction=law, friction_bound=bound, e_cue_ball=0.9)
    return spinning_table(PLACES, masses=[0.2, 0.1], **fields)


@pytest.mark.parametrize('seed', range(30))
def test_two_balls_keep_momentum_and_gain_no_energy(table, seed):
    velocities, spins, normal = closing_pair(np.random.default_rng(seed), table)
    after, turned = hit(table, velocities, spins, normal)
    masses = table.masses[:, None]
    np.testing.assert_allclose((masses * after).sum(0), (masses * velocities).sum(0), atol=1e-14)
    assert energy(table, after, turned) <= energy(table, velocities, spins) * (1 + 1e-14)
    closing = np.dot(velocities[0] - velocities[1], normal)
    assert np.dot(after[1] - after[0], normal) == pytest.approx(0.9 * closing)


@pytest.mark.parametrize('seed', range(10))
def test_the_image_of_two_balls_in_a_mirror(table, seed):
    velocities, spins, normal = closing_pair(np.random.default_rng(seed), table)
    after, turned = hit(table, velocities, spins, normal)
    flip, turn = np.array([1.0, -1.0]), np.array([-1.0, 1.0, -1.0])
    mirrored, mirrored_turned = hit(table, velocities * flip, spins * turn, normal * flip)
    np.testing.assert_allclose(mirrored, after * flip, rtol=1e-12, atol=1e-13)
    np.testing.assert_allclose(mirrored_turned, turned * turn, rtol=1e-12, atol=1e-11)


def at_cushion(model, velocity, spin, normal, least=0.0, **fields):
    """Return place, velocity and spin after ball 0 met a rail of a rectangle."""
    table = spinning_table(PLACES, cushion_model=model, **fields)
    balls = records(table, np.array([spin, np.zeros(3)]))
    cushion = [(-1, 0), (1, 0), (0, -1), (0, 1)].index(tuple(int(n) for n in normal))
    after = meet_cushion(table.for_kernels, balls, cushion, normal, tuple(velocity), (0.0, least))
    return (balls['x'][0], balls['y'][0]), np.array(after), spins_of(balls)[0]


@pytest.mark.parametrize('model', MODELS)
@pytest.mark.parametrize('seed', range(5))
def test_a_ball_leaves_a_rail_without_more_energy_and_lies_on_it(model, seed):
    (velocity,), (spin,) = random_strikes(np.random.default_rng(seed), 1, (0.1, 5.0), 80.0)
    velocity[1] = abs(velocity[1])
    place, after, turned = at_cushion(model, velocity, spin, (0.0, 1.0))
    assert place[1] == pytest.approx(0.9906 - RADIUS, abs=1e-15)
    assert after[1] < 0.0
    table = spinning_table(PLACES[:1])
    was, now = (energy(table, v[None], w[None]) for v, w in ((velocity, spin), (after, turned)))
    assert now <= was * (1 + 1e-12)


@pytest.mark.parametrize('model', MODELS)
@pytest.mark.parametrize('seed', range(3))
def test_all_four_rails_are_turned_images_of_each_other(model, seed):
    (velocity,), (spin,) = random_strikes(np.random.default_rng(seed), 1, (0.1, 5.0), 80.0)
    velocity[0] = abs(velocity[0])
    _, after, turned = at_cushion(model, velocity, spin, (1.0, 0.0))
    for quarter, normal in ((1, (0.0, 1.0)), (2, (-1.0, 0.0)), (3, (0.0, -1.0))):
        c, s = (0.0, -1.0, 0.0)[quarter - 1], (1.0, 0.0, -1.0)[quarter - 1]
        turn = np.array([[c, -s], [s, c]])
        spun = np.append(turn @ spin[:2], spin[2])
        _, found, found_turned = at_cushion(model, turn @ velocity, spun, normal)
        np.testing.assert_allclose(found, turn @ after, rtol=1e-10, atol=1e-11)
        expected = np.append(turn @ turned[:2], turned[2])
        np.testing.assert_allclose(found_turned, expected, rtol=1e-10, atol=1e-9)


@pytest.mark.parametrize('model', MODELS)
def test_a_ball_that_hardly_closes_parts_as_fast_as_it_is_told(model):
    _, after, _ = at_cushion(model, (0.3, 1e-4), np.zeros(3), (0.0, 1.0), least=5e-4)
    assert after[1] <= -5e-4


def test_discs_have_their_own_law():
    """Head on, without friction: they exchange velocities as e has it, and know no spin."""
    table = table_of(PLACES, radius=0.03, e_cue_ball=0.8, mu_ball_ball=0.0)
    balls = table.balls_at_rest.copy()
    va, vb = pair(table.for_kernels, balls, (1.0, 0.2), (0.0, 0.0), (1.0, 0.0), 0.8)
    np.testing.assert_allclose([va, vb], [(0.1, 0.2), (0.9, 0.0)], atol=1e-15)
    after = meet_cushion(table.for_kernels, balls, 1, (1.0, 0.0), (1.0, 0.0), (0.7, 0.0))
    np.testing.assert_allclose(after, (-0.7, 0.0), atol=1e-15)
