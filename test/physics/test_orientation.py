"""How balls are turned, beside slow quadrature: many small turns about the spin in the middle."""

import math

import numpy as np
import pytest
from spin_tables import spin_table
from tables import table_of
from thinned import soak

from pool_sim_ros.physics import cue_strike, pool_table, simulate
from pool_sim_ros.physics.orientation import unit_quaternions

IDENTITY = (0.0, 0.0, 0.0, 1.0)
FAR = dict(length=100.0, width=100.0)


def turned(q, vector):
    """Return a quaternion turned about a vector by its length, rad."""
    angle = math.hypot(*vector)
    if angle == 0.0:
        return q
    axis, scalar = np.sin(angle / 2) / angle * np.asarray(vector), math.cos(angle / 2)
    return np.array(
        [*(scalar * q[:3] + q[3] * axis + np.cross(axis, q[:3])), scalar * q[3] - axis @ q[:3]]
    )


def angle_between(one, other):
    """Return the angle in rad by which two orientations differ."""
    dot = abs(float(np.dot(one, other)))
    chord = min(np.linalg.norm(one - other), np.linalg.norm(one + other))
    return 2 * math.acos(min(dot, 1.0)) if chord > 0.1 else 2 * chord


def quadrature(shot, ball, until, steps):
    """Return the orientation of a ball at `until`: one turn in each of so many equal steps.

    Steps end where its motion changes, and where its spin about the vertical axis ends, so that
    the spin is smooth in each.
    """
    own = shot.segments[shot.segments['ball'] == ball]
    fades = shot.table.for_kernels.spin
    joints = [*own['t'], *(own['t'] + np.abs(own['wz']) / fades), 0.0, until]
    joints = np.unique([t for t in joints if t <= until])
    q = np.array(IDENTITY)
    for begin, end in zip(joints[:-1], joints[1:], strict=True):
        count = max(math.ceil(steps * (end - begin) / until), 2)
        h = (end - begin) / count
        for w in shot.spins(begin + h * (np.arange(count) + 0.5))[:, ball]:
            q = turned(q, h * w)
    return q


def extrapolated(shot, ball, until, steps):
    """Return the same with the error of the second order taken away, and what that moved."""
    coarse, fine = (quadrature(shot, ball, until, n) for n in (steps, 2 * steps))
    best = (4 * fine - coarse) / 3
    return best / np.linalg.norm(best), angle_between(best, fine)


STROKES = {
    'stun': dict(speed=3.0, azimuth=20.0),
    'draw': dict(speed=4.0, azimuth=100.0, above=-0.4),
    'side': dict(speed=3.0, azimuth=-60.0, side=0.4, above=0.1),
    'masse': dict(speed=3.0, azimuth=180.0, elevation=60.0, side=0.3, above=-0.3),
}


@pytest.mark.parametrize('stroke', ['side', 'masse', *soak('stun', 'draw')])
def test_a_slide_beside_quadrature(stroke):
    """While slip turns the axis there is no formula; the bound is 1e-6 rad a shot."""
    table = spin_table([(50.0, 50.0)], **FAR)
    velocity, spin = cue_strike(table, **STROKES[stroke])
    shot = simulate(table, velocity, spins=spin)
    until = min(1.5, shot.duration)
    expected, moved = extrapolated(shot, 0, until, 20_000)
    assert moved < 1e-4
    assert angle_between(shot.orientations(until)[0], expected) < 1e-6


def test_a_break_beside_quadrature():
    table = pool_table('7ft')
    shot = simulate(table, (-6.0, 0.2), spins=(3.0, 40.0, 60.0), until=0.6)
    found = shot.orientations(0.6)
    for ball in (0, 1, 9):
        expected, moved = extrapolated(shot, ball, 0.6, 20_000)
        assert moved < 1e-4
        assert angle_between(found[ball], expected) < 1e-6


def test_rolling_without_slip_turns_by_distance_over_radius():
    table = spin_table([(50.0, 50.0)], **FAR)
    radius = table.radii[0]
    velocity = np.array([0.9, 1.2])
    spin = (-velocity[1] / radius, velocity[0] / radius, 0.0)
    shot = simulate(table, velocity, spins=spin)
    axis = np.array([-velocity[1], velocity[0], 0.0]) / math.hypot(*velocity)
    for t in np.linspace(0.0, shot.duration, 50):
        distance = math.hypot(*(shot.positions(t)[0] - table.positions[0]))
        half = distance / radius / 2
        expected = np.array([*(math.sin(half) * axis), math.cos(half)])
        assert angle_between(shot.orientations(t)[0], expected) < 1e-9


def test_spin_in_place_turns_by_its_integral():
    table = spin_table([(0.5, 0.5)])
    shot = simulate(table, (0.0, 0.0), spins=(0.0, 0.0, -50.0))
    fades = table.for_kernels.spin
    assert shot.duration == pytest.approx(50.0 / fades)
    for t in np.linspace(0.0, shot.duration, 20):
        half = -(50.0 * t - fades * t * t / 2) / 2
        expected = np.array([0.0, 0.0, math.sin(half), math.cos(half)])
        assert angle_between(shot.orientations(t)[0], expected) < 1e-9


def test_lengths_are_one_and_no_sign_jumps():
    shot = simulate(pool_table('7ft'), (-8.0, 0.1), spins=(10.0, -100.0, 80.0))
    times = np.arange(0.0, shot.duration, 1e-4)
    found = shot.orientations(times)
    np.testing.assert_allclose(np.linalg.norm(found, axis=2), 1.0, rtol=0, atol=1e-12)
    # At most 8 m/s and its slip: some 500 rad/s, half of which turns the quaternion.
    assert np.abs(np.diff(found, axis=0)).max() < 1e-4 * 500 / 2 * 1.5
    np.testing.assert_array_equal(found[0], [IDENTITY] * 16)


def test_times_in_any_order():
    shot = simulate(pool_table('7ft'), (-3.0, 0.1))
    times = np.array([0.7, 0.0, 1.2, 0.7])
    found = shot.orientations(times)
    assert found.shape == (4, 16, 4) and shot.orientations(0.7).shape == (16, 4)
    np.testing.assert_array_equal(found[0], found[3])
    for k, t in enumerate(times):
        for ball in range(16):
            assert angle_between(found[k, ball], shot.orientations(t)[ball]) < 1e-9
    assert shot.orientations([]).shape == (0, 16, 4)
    resting = shot.orientations([shot.duration, shot.duration + 1e3])
    np.testing.assert_allclose(resting[0], resting[1], rtol=0, atol=1e-9)


def test_orientations_at_the_strike_are_turned_on():
    """Turning on from q is the turn from the identity times q."""
    table = spin_table([(0.5, 0.5), (1.5, 0.5)])
    shot = simulate(table, (2.0, 0.3), spins=(5.0, 0.0, 30.0))
    start = np.random.default_rng(74).normal(size=(2, 4))
    start /= np.linalg.norm(start, axis=1)[:, None]
    found = shot.orientations([0.0, 0.4], start)
    np.testing.assert_allclose(found[0], start, rtol=0, atol=1e-15)
    for ball, turn in enumerate(shot.orientations(0.4)):
        (x, y, z, w), q = turn, start[ball]
        v = np.array([x, y, z])
        vector = w * q[:3] + q[3] * v + np.cross(v, q[:3])
        expected = np.array([*vector, w * q[3] - v @ q[:3]])
        assert angle_between(found[1, ball], expected) < 1e-9


def test_the_next_shot_goes_on_where_this_one_ended():
    table = spin_table([(0.5, 0.5)])
    whole = simulate(table, (1.0, 0.3))
    half = simulate(table, (1.0, 0.3), until=0.5)
    rest = simulate(table, half.final_velocities, positions=half.final_positions,
                    spins=half.spins(0.5))  # fmt: skip
    found = rest.orientations(rest.duration, half.orientations(0.5))
    assert angle_between(found[0], whole.orientations(whole.duration)[0]) < 1e-9


def test_a_disc_stays_as_it_was():
    shot = simulate(table_of([(0.5, 0.5)]), (2.0, 1.0))
    assert shot.orientations([0.0, 0.3, 9.0]).tolist() == [[list(IDENTITY)]] * 3
    half = math.sqrt(0.5)
    assert shot.orientations(0.3, [(0.0, 0.0, half, half)])[0] == pytest.approx((0, 0, half, half))


@pytest.mark.parametrize(
    ('given', 'words'),
    [
        ([IDENTITY], r'shape \(1, 4\) must be \(2, 4\)'),
        ([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)], r'shape \(2, 3\)'),
        ('none', 'none'),
    ],
)
def test_a_wrong_shape_is_named(given, words):
    with pytest.raises(ValueError, match=f'^orientations0: .*{words}'):
        unit_quaternions(given, 2)


@pytest.mark.parametrize('wrong', [(0.0, 0.0, 0.0, 0.0), (0, 0, 0, 1.001), (0, 0, 0, math.nan)])
def test_what_is_no_unit_quaternion_is_named(wrong):
    with pytest.raises(
        ValueError, match=r'^orientations0\[1\]: \[0.0, .* must be a unit'
    ) as caught:
        unit_quaternions([IDENTITY, wrong], 2)
    assert str(float(wrong[3])) in str(caught.value)
