"""A ball that spins against a cushion: all models against their twins and the laws they keep."""

import math

import naive_spin
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pool_sim_ros.physics.contacts import (
    EdgeLaw,
    collide_with_edge,
    friction_of_edge,
    from_contact_axes,
    lean_of,
    meet_edge,
    parting_of_push,
    rebound,
    to_contact_axes,
)
from pool_sim_ros.physics.contacts.edge import HAN, IMPULSE, MATHAVAN, STRONGE
from pool_sim_ros.physics.law_names import CUSHION_MODELS

RADIUS = 0.028575
EXACT_MODELS = ('han', 'impulse', 'stronge')


def test_the_numbers_are_those_of_the_names():
    numbers = [HAN, IMPULSE, STRONGE, MATHAVAN]
    assert [CUSHION_MODELS[k] for k in numbers] == ['han', 'impulse', 'stronge', 'mathavan']


def law_of(model, e=0.85, f=0.2, height=1.28, mu_slide=0.2):
    return EdgeLaw(CUSHION_MODELS.index(model), e, f, height * RADIUS, mu_slide)


def random_contact(rng, least_e=0.0):
    """A ball that moves into a cushion: velocity, spin, normal, law but for its model, nose."""
    angle, approach = rng.uniform(-math.pi, math.pi), rng.uniform(-1.4, 1.4)
    speed = rng.choice([1e-3, 1.0, 8.0])
    heading = angle + approach
    v = speed * math.cos(heading), speed * math.sin(heading)
    w = rng.choice([0.0, 1.0, 10.0]) * speed / RADIUS * rng.normal(size=3)
    if rng.random() < 0.3:
        w[:2] = -v[1] / RADIUS, v[0] / RADIUS
    law = dict(
        e=rng.uniform(least_e, 1.0),
        f=rng.choice([0.0, 0.2, 1.0]),
        height=rng.uniform(0.55, 1.9),
        mu_slide=rng.choice([0.0, 0.2, 1.0]),
    )
    nose = rng.choice([0.0, 0.00795, 0.02095])
    return v, tuple(w), (math.cos(angle), math.sin(angle)), law, nose


def flat(v, w):
    """Velocity and the spin's speed at the surface, m/s."""
    return np.array([*v, *(RADIUS * each for each in w)])


def energy(v, w):
    """By mass, J/kg; a sphere has 2/5 m R^2."""
    return 0.5 * (np.dot(v, v) + 0.4 * RADIUS**2 * np.dot(w, w))


@pytest.mark.parametrize('model', EXACT_MODELS)
def test_contact_equals_twin(model):
    rng = np.random.default_rng(61)
    for _ in range(200):
        v, w, normal, law, nose = random_contact(rng)
        found = collide_with_edge(law_of(model, **law), v, w, normal, (RADIUS, nose), -1e9)
        twin = naive_spin.collide_cushion(
            (*v, 0.0),
            w,
            naive_spin.unit((*normal, 0.0)),
            RADIUS,
            law['height'] * RADIUS,
            law['e'],
            law['f'],
            model,
            nose,
        )
        expected = flat(twin[0][:2], twin[1]).astype(float)
        scale = np.abs(flat(v, w)).max()
        slack = 1e-12 if model == 'stronge' else 1e-14
        np.testing.assert_allclose(flat(*found), expected, rtol=0, atol=slack * scale)


@pytest.mark.parametrize('model', CUSHION_MODELS)
def test_energy_never_rises(model):
    rng = np.random.default_rng(62)
    # Mathavan's model is integrated in steps; the others are formulas.
    slack, count = (1e-5, 300) if model == 'mathavan' else (1e-13, 2000)
    for _ in range(count):
        v, w, normal, law, nose = random_contact(rng)
        after = collide_with_edge(law_of(model, **law), v, w, normal, (RADIUS, nose), 0.0)
        assert energy(*after) <= energy(v, w) * (1 + slack), (v, w, normal, law, nose)


@pytest.mark.parametrize('model', CUSHION_MODELS)
def test_a_smooth_edge_at_the_height_of_the_centre_takes_no_energy(model):
    law = law_of(model, e=1.0, f=0.0, height=1.0, mu_slide=0.0)
    rng = np.random.default_rng(63)
    for _ in range(50):
        v, w, normal, _, _ = random_contact(rng)
        after = collide_with_edge(law, v, w, normal, (RADIUS, 0.0), 0.0)
        into = np.dot(v, normal)
        np.testing.assert_allclose(after[0], v - 2 * into * np.array(normal), atol=1e-12)
        np.testing.assert_allclose(after[1], w, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize('model', CUSHION_MODELS)
def test_mirrored_contacts_are_mirrored(model):
    rng = np.random.default_rng(64)
    for _ in range(100):
        (vx, vy), (wx, wy, wz), (nx, ny), law, nose = random_contact(rng)
        law = law_of(model, **law)
        v, w = collide_with_edge(law, (vx, vy), (wx, wy, wz), (nx, ny), (RADIUS, nose), 0.0)
        image = collide_with_edge(law, (vx, -vy), (-wx, wy, -wz), (nx, -ny), (RADIUS, nose), 0.0)
        np.testing.assert_array_equal(flat(*image), flat((v[0], -v[1]), (-w[0], w[1], -w[2])))


@pytest.mark.parametrize('model', CUSHION_MODELS)
def test_turned_contacts_are_turned(model):
    rng = np.random.default_rng(65)
    for _ in range(100):
        v, w, normal, law, nose = random_contact(rng)
        law, angle = law_of(model, **law), rng.uniform(-3.0, 3.0)
        cosine, sine = math.cos(angle), math.sin(angle)

        def turned(vector, cosine=cosine, sine=sine):
            x, y, *z = vector
            return (cosine * x - sine * y, sine * x + cosine * y, *z)

        one = collide_with_edge(law, v, w, normal, (RADIUS, nose), 0.0)
        other = collide_with_edge(law, turned(v), turned(w), turned(normal), (RADIUS, nose), 0.0)
        scale = np.abs(flat(v, w)).max()
        slack = 1e-9 if model in ('mathavan', 'stronge') else 1e-13
        expected = flat(turned(one[0]), turned(one[1]))
        np.testing.assert_allclose(flat(*other), expected, rtol=0, atol=slack * scale)


@pytest.mark.parametrize('model', EXACT_MODELS)
def test_the_map_is_homogeneous_in_speed(model):
    rng = np.random.default_rng(66)
    for _ in range(100):
        v, w, normal, law, nose = random_contact(rng)
        law = law_of(model, **law)
        one = collide_with_edge(law, v, w, normal, (RADIUS, nose), 0.0)
        slower = tuple(each / 1024 for each in v), tuple(each / 1024 for each in w)
        other = collide_with_edge(law, *slower, normal, (RADIUS, nose), 0.0)
        np.testing.assert_allclose(flat(*other) * 1024, flat(*one), rtol=1e-12, atol=1e-12)


def test_a_ball_need_not_part_and_is_cut_off():
    """e 0.1 and f 0.2: friction on a rolling ball leaves it on its way in, so it stays or parts."""
    v, w = (1.0, 0.0), (0.0, -40.0 / RADIUS, 0.0)
    law = law_of('han', e=0.1, f=0.2)
    assert meet_edge(law, v, w, RADIUS, 0.0)[0][0] > 0.0
    for separation in (0.0, 1e-4, 1e-3):
        after = collide_with_edge(law, v, w, (1.0, 0.0), (RADIUS, 0.0), separation)
        assert after[0][0] == -separation
    assert (
        collide_with_edge(law_of('han'), v, (0.0, 0.0, 0.0), (1.0, 0.0), (RADIUS, 0.0), 1e-4)[0][0]
        < -0.5
    )


@pytest.mark.parametrize('model', EXACT_MODELS)
def test_the_parts_make_the_whole(model):
    """The push along the normal first, friction from the motion before it, as contact groups do."""
    rng = np.random.default_rng(67)
    for _ in range(100):
        v, w, normal, law, nose = random_contact(rng)
        law = law_of(model, **law)
        lean = lean_of(law, RADIUS, nose)
        local = to_contact_axes(v, w, normal)
        closing = local[0][0]
        parting = parting_of_push(law, lean, closing)
        assert parting <= law.e * closing
        # What changes the speed along the normal so is the push times its cosine.
        push = (closing + parting) / lean[0]
        friction = friction_of_edge(law, *local, RADIUS, lean, push)
        pushed = (-parting, local[0][1]), local[1]
        rubbed = rebound(*pushed, RADIUS, lean, 0.0, friction)
        found = from_contact_axes(*rubbed, normal)
        whole = collide_with_edge(law, v, w, normal, (RADIUS, nose), -1e9)
        scale = np.abs(flat(v, w)).max()
        np.testing.assert_allclose(flat(*found), flat(*whole), rtol=0, atol=1e-12 * scale)


def test_friction_of_mathavan_in_a_group_is_that_of_han():
    v, w = (1.0, 0.5), (3.0, -20.0, 40.0)
    han, mathavan = law_of('han'), law_of('mathavan')
    lean = lean_of(mathavan, RADIUS, 0.02)
    assert lean == lean_of(han, RADIUS, 0.02)
    assert friction_of_edge(mathavan, v, w, RADIUS, lean, 1.5) == friction_of_edge(
        han, v, w, RADIUS, lean, 1.5
    )


def test_axes_of_a_contact_and_back():
    rng = np.random.default_rng(68)
    for _ in range(50):
        v, w, normal, _, _ = random_contact(rng)
        (v_n, v_t), (w_n, w_t, w_z) = to_contact_axes(v, w, normal)
        tangent = (-normal[1], normal[0])
        assert (v_n, v_t) == pytest.approx((np.dot(v, normal), np.dot(v, tangent)), abs=1e-13)
        assert (w_n, w_t) == pytest.approx(
            (np.dot(w[:2], normal), np.dot(w[:2], tangent)), rel=1e-12, abs=1e-9
        )
        again = from_contact_axes((v_n, v_t), (w_n, w_t, w_z), normal)
        np.testing.assert_allclose(again[0], v, atol=1e-14)
        np.testing.assert_allclose(again[1], w, rtol=1e-13, atol=1e-12)


def test_without_a_push_nothing_changes():
    for model in CUSHION_MODELS:
        for v in ((0.0, 1.0), (-1.0, 1.0), (-0.0, 0.0)):
            assert meet_edge(law_of(model), v, (1.0, 2.0, 3.0), RADIUS, 0.0) == (v, (1.0, 2.0, 3.0))


def test_stronge_s_ball_leaves_with_more_of_its_slip_reversed_than_a_rigid_one():
    """The spring gives back: backspin comes out of a slip that a rigid edge only stops."""
    v, w = (1.0, 0.1), (0.0, 0.0, 0.0)
    rigid = meet_edge(law_of('impulse'), v, w, RADIUS, 0.0)
    compliant = meet_edge(law_of('stronge'), v, w, RADIUS, 0.0)
    assert compliant[0][1] < rigid[0][1]
    assert compliant[1][2] < rigid[1][2] < 0.0


SPEEDS = st.sampled_from([0.0, 1e-300, 1e-160, 1e-12, 1e-4, 1.0, 1e6])
SPINS = st.sampled_from([0.0, -0.0, 1e-300, -1e-12, 1.0, -1e4, 1e9])


@given(
    st.sampled_from(CUSHION_MODELS),
    SPEEDS,
    SPEEDS,
    st.tuples(SPINS, SPINS, SPINS),
    st.sampled_from([0.0, 1e-9, 0.5, 1.0]),
    st.sampled_from([0.0, 1e-9, 0.2, 1e3]),
    st.sampled_from([0.51, 1.0, 1.28, 1.99]),
)
def test_nothing_is_nan(model, v_n, v_t, w, e, f, height):
    law = law_of(model, e, f, height, f)
    after = collide_with_edge(law, (v_n, v_t), w, (1.0, 0.0), (RADIUS, 0.0), 0.0)
    assert np.isfinite(flat(*after)).all()
    assert v_n == 0.0 or after[0][0] <= 0.0
