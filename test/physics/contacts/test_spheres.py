"""Two balls that spin: the kernels against their plain twin, and the laws they must keep."""

import math

import naive_spin
import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from pool_sim_ros.physics.contacts import (
    BallLaw,
    collide_spheres,
    friction_bound,
    friction_of_balls,
    rub_spheres,
)
from pool_sim_ros.physics.contacts.spheres import friction_coefficient, slip_of_balls

RADIUS = 0.028575
REST = ((0.0, 0.0), (0.0, 0.0, 0.0))
ALCIATORE = BallLaw(0.0, True, False)


def law_of(mu=0.05, bound='impulse'):
    return BallLaw(mu, False, bound == 'restitution')


def random_contact(rng):
    angle = rng.uniform(-math.pi, math.pi)
    spin = rng.choice([0.0, 50.0, 1e4], 2)
    return dict(
        one=(tuple(rng.normal(size=2)), tuple(spin[0] * rng.normal(size=3))),
        other=(tuple(rng.normal(size=2)), tuple(spin[1] * rng.normal(size=3))),
        normal=(math.cos(angle), math.sin(angle)),
        masses=tuple(rng.uniform(0.05, 0.5, 2)),
        e=rng.uniform(0.0, 1.0),
    )


def closing_speed(one, other, normal):
    return np.dot(np.subtract(one[0], other[0]), normal)


def collide(law, one, other, normal, masses, e):
    inverses = 1 / masses[0], 1 / masses[1]
    restitution = e, e * closing_speed(one, other, normal)
    return collide_spheres(law, one, other, normal, RADIUS, inverses, restitution)


def twin_of(law, one, other, normal, masses, e):
    mu = naive_spin.alciatore if law.alciatore else lambda _: naive_spin.mpf(law.mu)
    return naive_spin.collide_balls(
        (*one[0], 0.0),
        one[1],
        (*other[0], 0.0),
        other[1],
        naive_spin.unit((*normal, 0.0)),
        *masses,
        RADIUS,
        e,
        mu,
        'restitution' if law.by_restitution else 'impulse',
    )


def flat(motions):
    """Velocities and spins, the latter as speeds of the surface, m/s."""
    return np.concatenate([np.concatenate([v, np.multiply(w, RADIUS)]) for v, w in motions])


def energy(motions, masses):
    """J; a sphere has 2/5 m R^2."""
    return sum(
        0.5 * m * (np.dot(v, v) + 0.4 * RADIUS**2 * np.dot(w, w))
        for (v, w), m in zip(motions, masses, strict=True)
    )


@pytest.mark.parametrize('law', [law_of(), law_of(2.0), law_of(0.05, 'restitution'), ALCIATORE])
def test_contact_equals_twin(law):
    rng = np.random.default_rng(31)
    for _ in range(150):
        contact = random_contact(rng)
        found = collide(law, **contact)
        v1, w1, v2, w2 = twin_of(law, **contact)
        twin = np.array([*v1[:2], *(RADIUS * w for w in w1), *v2[:2], *(RADIUS * w for w in w2)])
        speed = np.abs(flat([contact['one'], contact['other']])).max()
        ratio = max(contact['masses']) / min(contact['masses'])
        np.testing.assert_allclose(
            flat(found), twin.astype(float), rtol=0, atol=1e-14 * speed * ratio
        )


def test_momentum_is_kept_and_energy_never_rises():
    rng = np.random.default_rng(32)
    for _ in range(2000):
        contact = random_contact(rng)
        one, other, normal = contact['one'], contact['other'], contact['normal']
        if closing_speed(one, other, normal) < 0.0:
            one, other = other, one
        contact |= dict(one=one, other=other)
        law = [law_of(rng.choice([0.0, 0.05, 1.0, 50.0])), ALCIATORE][rng.integers(2)]
        found = collide(law, **contact)
        masses = contact['masses']
        before = np.add(
            *(np.multiply(m, v) for m, (v, _) in zip(masses, (one, other), strict=True))
        )
        after = np.add(*(np.multiply(m, v) for m, (v, _) in zip(masses, found, strict=True)))
        np.testing.assert_allclose(after, before, atol=1e-14)
        parts = closing_speed(*found, normal)
        assert parts == pytest.approx(-contact['e'] * closing_speed(one, other, normal), abs=1e-13)
        start = energy((one, other), masses)
        assert energy(found, masses) <= start * (1 + 1e-14)


def test_slip_never_turns_and_stops_with_friction_enough():
    rng = np.random.default_rng(33)
    for _ in range(500):
        contact = random_contact(rng) | dict(e=0.5)
        for mu in (0.05, 1e6):
            law = law_of(mu)
            one, other = collide(law, **contact)
            before = slip_of_balls(contact['one'], contact['other'], contact['normal'], RADIUS)
            after = slip_of_balls(one, other, contact['normal'], RADIUS)
            if closing_speed(contact['one'], contact['other'], contact['normal']) <= 0.0:
                continue
            slack = 1e-12 * math.hypot(*before) + 1e-14
            assert after[0] * before[0] >= -slack and after[1] * before[1] >= -slack
            assert math.hypot(*after) <= math.hypot(*before) + slack
            if mu == 1e6:
                # Balls stay on the cloth: what would lift them does not stop the slip.
                assert abs(after[0]) <= slack


def test_mirrored_contacts_are_mirrored():
    """At y = 0: a velocity changes the sign of y, a spin those of x and z."""

    def mirrored(motion):
        (vx, vy), (wx, wy, wz) = motion
        return (vx, -vy), (-wx, wy, -wz)

    rng = np.random.default_rng(34)
    for _ in range(300):
        contact = random_contact(rng)
        image = contact | dict(
            one=mirrored(contact['one']),
            other=mirrored(contact['other']),
            normal=(contact['normal'][0], -contact['normal'][1]),
        )
        for law in (law_of(), ALCIATORE):
            found = [mirrored(motion) for motion in collide(law, **contact)]
            np.testing.assert_array_equal(flat(collide(law, **image)), flat(found))


def test_the_order_of_the_balls_does_not_matter():
    rng = np.random.default_rng(35)
    for _ in range(300):
        contact = random_contact(rng)
        swapped = contact | dict(
            one=contact['other'],
            other=contact['one'],
            normal=(-contact['normal'][0], -contact['normal'][1]),
            masses=contact['masses'][::-1],
        )
        one, other = collide(ALCIATORE, **contact)
        speed = np.abs(flat([contact['one'], contact['other']])).max()
        np.testing.assert_allclose(
            flat(collide(ALCIATORE, **swapped)), flat([other, one]), rtol=0, atol=1e-14 * speed * 10
        )


NUMBERS = st.sampled_from([0.0, -0.0, 1e-300, 1e-160, -1e-12, 1.0, -1.0, 1e6])
SPINS = st.sampled_from([0.0, 1e-300, -1e-12, 1.0, -1e4, 1e9])


@given(
    *[st.tuples(st.tuples(NUMBERS, NUMBERS), st.tuples(SPINS, SPINS, SPINS))] * 2,
    st.sampled_from([0.0, 0.05, 1e3]),
    st.sampled_from([0.0, 0.5, 1.0]),
    st.booleans(),
    st.booleans(),
)
@example(((0.0, 0.0), (0.0, 0.0, 0.0)), ((0.0, 1e-300), (0.0, 0.0, 0.0)), 0.05, 0.0, False, False)
def test_nothing_is_nan(one, other, mu, e, alciatore, by_restitution):
    law = BallLaw(mu, alciatore, by_restitution)
    for normal in ((1.0, 0.0), (-0.6, 0.8)):
        found = collide(law, one, other, normal, (0.17, 0.17), e)
        assert np.isfinite(flat(found)).all()


def test_friction_by_hand():
    """A ball with sidespin 10 m/s at its surface meets one at rest, head-on, at 1 m/s."""
    one = (1.0, 0.0), (0.0, 0.0, 10.0 / RADIUS)
    (v1, w1), (v2, w2) = collide(law_of(0.05), one, REST, (1.0, 0.0), (0.2, 0.2), 0.9)
    # The push is 0.95 m/s, friction 0.05 of it: against the slip of ball 1, which is along +y.
    assert v1 == pytest.approx((0.05, -0.0475), abs=1e-15)
    assert v2 == pytest.approx((0.95, 0.0475), abs=1e-15)
    assert w1[2] * RADIUS == pytest.approx(10.0 - 2.5 * 0.0475, abs=1e-14)
    assert w2[2] * RADIUS == pytest.approx(-2.5 * 0.0475, abs=1e-15)


def test_topspin_does_not_lift_a_ball_but_gives_backspin():
    rolling = (1.0, 0.0), (0.0, 1.0 / RADIUS, 0.0)
    (v1, w1), (v2, w2) = collide(law_of(0.05), rolling, REST, (1.0, 0.0), (0.2, 0.2), 0.9)
    assert v1 == pytest.approx((0.05, 0.0), abs=1e-15)
    assert v2 == pytest.approx((0.95, 0.0), abs=1e-15)
    assert w1[1] * RADIUS == pytest.approx(1.0 - 2.5 * 0.0475, abs=1e-15)
    assert w2[1] * RADIUS == pytest.approx(-2.5 * 0.0475, abs=1e-15)


def test_alciatore_s_coefficient():
    """Its three constants at slips of 0, 1 and many m/s."""
    assert friction_coefficient(ALCIATORE, 0.0) == pytest.approx(0.117951, abs=1e-15)
    expected = 0.009951 + 0.108 * math.exp(-1.088)
    assert friction_coefficient(ALCIATORE, 1.0) == pytest.approx(expected, abs=1e-15)
    assert friction_coefficient(ALCIATORE, 1e3) == pytest.approx(0.009951, abs=1e-15)
    assert friction_coefficient(law_of(0.07), 1e3) == 0.07


def test_what_bounds_friction():
    # Of balls of 1 kg that close at 2 m/s: a push of (1 + e)/2 times 2, or e times 2.
    assert friction_bound(law_of(), 1.5, 0.5) == 1.5
    assert friction_bound(law_of(bound='restitution'), 1.5, 0.5) == pytest.approx(1.0)
    assert friction_bound(law_of(bound='restitution'), 1.0, 0.0) == 0.0


def test_the_parts_make_the_whole():
    """Push first, then friction from the velocities after it: as a contact group does it."""
    rng = np.random.default_rng(36)
    for _ in range(100):
        contact = random_contact(rng)
        (v1, w1), (v2, w2) = contact['one'], contact['other']
        normal, masses, e = np.array(contact['normal']), contact['masses'], contact['e']
        inverses = 1 / masses[0], 1 / masses[1]
        mass = 1 / sum(inverses)
        impulse = mass * (1 + e) * closing_speed(contact['one'], contact['other'], normal)
        pushed = (
            (tuple(v1 - impulse * inverses[0] * normal), w1),
            (tuple(v2 + impulse * inverses[1] * normal), w2),
        )
        bound = friction_bound(ALCIATORE, impulse, e)
        friction = friction_of_balls(ALCIATORE, *pushed, tuple(normal), RADIUS, mass, bound)
        found = rub_spheres(*pushed, tuple(normal), RADIUS, inverses, friction)
        whole = collide(ALCIATORE, **contact)
        speed = np.abs(flat([contact['one'], contact['other']])).max()
        np.testing.assert_allclose(flat(found), flat(whole), rtol=0, atol=1e-13 * speed)
