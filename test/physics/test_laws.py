"""What holds for every shot: conservation, symmetry, determinism, one motion however it is cut."""

import dataclasses
import itertools
import math

import numpy as np
import pytest
from tables import (
    LAWS,
    kinetic_energy,
    random_table,
    random_velocity,
    table_of,
    worst_overlap,
)

from pool_sim_ros.physics import report_table, simulate, simulate_many

V_MIN = 1e-4  # m/s: what the rule for sustained contact may give a ball


def random_shots(seed, count, law, balls=6, fastest=3.0, **fields):
    rng = np.random.default_rng(seed)
    for _ in range(count):
        table = random_table(rng, balls, law, **fields)
        yield table, np.array([random_velocity(rng, 0.1, fastest) for _ in table.balls])


def just_before(shot, table, event):
    """Velocities immediately before an event, from those just after the one before it."""
    earlier = shot.events['t'][shot.events['t'] < event['t']]
    since = earlier[-1] if len(earlier) else 0.0
    velocities = shot.velocities(since)
    speeds = np.linalg.norm(velocities, axis=1, keepdims=True)
    loss = table.mu_ball_surface * table.gravity * (event['t'] - since)
    left = np.maximum(speeds - loss, 0.0)
    return velocities * np.divide(left, speeds, out=np.zeros_like(left), where=speeds > 0)


def test_energy_never_rises_under_coulomb():
    for table, velocities in random_shots(41, 30, 'coulomb'):
        shot = simulate(table, velocities)
        times = np.unique(np.concatenate([[0.0], shot.events['t']]))
        energy = kinetic_energy(table, shot.velocities(times))
        slack = 1e-12 * energy[0] + table.masses.sum() * V_MIN**2
        assert np.all(np.diff(energy) <= slack)


def test_energy_is_kept_where_nothing_takes_it():
    lossless = dict(mu_ball_ball=0.0, mu_ball_surface=0.0, mu_ball_cushion=0.0)
    elastic = dict(e_cue_ball=1.0, e_ball_ball=1.0, e_ball_cushion=1.0)
    for table, velocities in random_shots(42, 10, 'coulomb', **lossless, **elastic):
        shot = simulate(table, velocities, until=3.0)
        assert len(shot.events) > 10
        energy = kinetic_energy(table, shot.velocities(shot.events['t']))
        before = kinetic_energy(table, velocities)
        np.testing.assert_allclose(energy, before, rtol=1e-12)


def test_momentum_is_kept_in_every_ball_contact_under_coulomb():
    contacts = 0
    for table, velocities in random_shots(43, 20, 'coulomb'):
        shot = simulate(table, velocities)
        for time in np.unique(shot.events['t'][shot.events['kind'] == 0]):
            here = shot.events[shot.events['t'] == time]
            if np.any(here['kind'] != 0):
                continue
            before = just_before(shot, table, here[0])
            change = table.masses @ (shot.velocities(time) - before)
            assert np.abs(change).max() < 1e-12
            contacts += 1
    assert contacts > 30


@pytest.mark.parametrize('law', LAWS)
def test_contacts_obey_restitution(law):
    """The speed at which a pair parts is e times that at which it met."""
    contacts = 0
    for table, velocities in random_shots(44, 10, law):
        shot = simulate(table, velocities)
        for event in shot.events[shot.events['kind'] == 0]:
            if event['speed'] < 1e-3 or np.sum(shot.events['t'] == event['t']) > 1:
                continue
            a, b = event['a'], event['b']
            after = shot.velocities(event['t'])
            parting = (after[b] - after[a]) @ [event['nx'], event['ny']]
            cue = table.balls[a].is_cue or table.balls[b].is_cue
            e = table.e_cue_ball if cue else table.e_ball_ball
            assert parting == pytest.approx(e * event['speed'], abs=1e-12)
            contacts += 1
    assert contacts > 20


@pytest.mark.parametrize('law', LAWS)
def test_no_ball_is_ever_in_another_or_outside(law):
    for table, velocities in random_shots(45, 20, law, balls=8):
        shot = simulate(table, velocities)
        times = np.concatenate([np.linspace(0.0, shot.duration, 2000), shot.events['t']])
        assert worst_overlap(table, shot.positions(times)) < 1e-9


def mirror_x(table, places):
    return np.array([table.length, 0.0]) + places * [-1.0, 1.0]


def mirror_y(table, places):
    return np.array([0.0, table.width]) + places * [1.0, -1.0]


def half_turn(table, places):
    return mirror_x(table, mirror_y(table, places))


def quarter_turn(table, places):
    return np.stack([table.width - places[:, 1], places[:, 0]], axis=1)


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('image', [mirror_x, mirror_y, half_turn, quarter_turn])
def test_an_image_of_the_table_gives_the_image_of_the_motion(image, law):
    for table, velocities in random_shots(46, 8, law, balls=4, fastest=1.5, mu_ball_surface=0.2):
        places = image(table, table.positions)
        balls = [
            dataclasses.replace(b, position=p) for b, p in zip(table.balls, places, strict=True)
        ]
        size = (table.length, table.width)
        length, width = size[::-1] if image is quarter_turn else size
        image_table = dataclasses.replace(table, balls=balls, length=length, width=width)
        image_velocities = image(table, velocities) - image(table, np.zeros_like(velocities))
        expected = image(table, simulate(table, velocities).final_positions)
        found = simulate(image_table, image_velocities).final_positions
        # The images' rounding differs, and every contact multiplies it.
        assert np.abs(found - expected).max() < 1e-9


def test_the_order_of_the_balls_does_not_matter_under_coulomb():
    rng = np.random.default_rng(47)
    shots = random_shots(48, 12, 'coulomb', balls=5, fastest=1.5, mu_ball_surface=0.2)
    for table, velocities in shots:
        order = rng.permutation(5)
        shuffled = dataclasses.replace(table, balls=[table.balls[k] for k in order])
        expected = simulate(table, velocities).final_positions[order]
        found = simulate(shuffled, velocities[order]).final_positions
        assert np.abs(found - expected).max() < 1e-9


@pytest.mark.parametrize('gap', [0.0, 1e-3])
def test_a_symmetric_hit_stays_symmetric_under_coulomb(gap):
    """A ball between two others, all mirror images of themselves about y = 0.5."""
    half = 0.05 + gap / 2
    table = table_of([(0.5, 0.5), (0.9, 0.5 + half), (0.9, 0.5 - half)], ball_friction='coulomb')
    shot = simulate(table, (2.0, 0.0), until=0.45)
    x, y = shot.final_positions.T
    assert shot.events[shot.events['kind'] == 0].size >= 2
    assert abs(y[0] - 0.5) < 1e-12
    assert abs(x[1] - x[2]) < 1e-12
    assert abs((y[1] - 0.5) + (y[2] - 0.5)) < 1e-12


@pytest.mark.parametrize('e', [1.0, 0.95, 0.5])
def test_four_balls_that_meet_in_the_middle_stay_symmetric_under_coulomb(e):
    """Four balls that run at the centre at once, from four sides."""
    table = table_of(
        [(0.7, 0.5), (1.3, 0.5), (1.0, 0.8), (1.0, 0.2)],
        ball_friction='coulomb',
        e_cue_ball=e,
        e_ball_ball=e,
    )
    velocities = [(1.0, 0.0), (-1.0, 0.0), (0.0, -1.0), (0.0, 1.0)]
    shot = simulate(table, velocities, until=0.4)
    offsets = shot.final_positions - [1.0, 0.5]
    assert shot.events[shot.events['kind'] == 0].size >= 4
    for k, (ux, uy) in enumerate([(-1, 0), (1, 0), (0, 1), (0, -1)]):
        assert offsets[k] @ [ux, uy] == pytest.approx(offsets[0] @ [-1, 0], abs=1e-12)
        assert abs(offsets[k] @ [-uy, ux]) < 1e-12


@pytest.mark.parametrize('e', [1.0, 0.9, 0.5])
def test_separate_contacts_of_one_instant_come_before_what_they_cause(e):
    """Four touching balls, the outer two driven inwards: both outer contacts, then the inner."""
    places = [(0.5 + 0.1 * k, 0.5) for k in range(4)]
    table = table_of(places, e_cue_ball=e, e_ball_ball=e, ball_friction='coulomb')
    shot = simulate(table, [(1.0, 0.0), (0.0, 0.0), (0.0, 0.0), (-1.0, 0.0)], until=1e-3)
    along = shot.final_velocities[:, 0]
    assert np.abs(along + along[::-1]).max() < 1e-9
    assert along[3] > 0.1


def test_the_order_of_balls_that_touch_does_not_matter_under_coulomb():
    rng = np.random.default_rng(54)
    cells = [
        (0.05 + 0.1 * i + 0.05 * (j % 2), 0.05 + j * 0.05 * 3**0.5)
        for i in range(3)
        for j in (0, 1)
    ]
    for _ in range(20):
        velocities = rng.normal(size=(len(cells), 2))
        table = table_of(cells, ball_friction='coulomb', e_cue_ball=0.8, e_ball_ball=0.8)
        order = rng.permutation(len(cells))
        shuffled = dataclasses.replace(table, balls=[table.balls[k] for k in order])
        expected = simulate(table, velocities, until=1e-6).final_velocities[order]
        found = simulate(shuffled, velocities[order], until=1e-6).final_velocities
        assert np.abs(found - expected).max() < 1e-9


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('integrator', ['event', 'time_slice'])
def test_a_shot_taken_up_again_goes_on_as_before(law, integrator):
    """Stop at t, start anew from there: the same end, later by t."""
    slicing = dict(integrator=integrator, time_slice=1e-5)
    for table, velocities in random_shots(49, 5, law, balls=4, fastest=1.5, mu_ball_surface=0.2):
        whole = simulate(table, velocities, **slicing)
        cut = round(0.4 * whole.duration, 3)
        first = simulate(table, velocities, until=cut, **slicing)
        rest = simulate(table, first.final_velocities, positions=first.final_positions, **slicing)
        assert np.abs(rest.final_positions - whole.final_positions).max() < 1e-9
        assert first.duration + rest.duration == pytest.approx(whole.duration, abs=1e-9)


@pytest.mark.parametrize('law', LAWS)
def test_until_equals_the_look_up(law):
    for table, velocities in random_shots(50, 10, law):
        whole = simulate(table, velocities)
        for until in (0.0, 0.1, 0.5 * whole.duration, 0.999 * whole.duration):
            part = simulate(table, velocities, until=until)
            assert part.duration == until
            assert np.abs(part.final_positions - whole.positions(until)).max() < 1e-12
            assert np.abs(part.final_velocities - whole.velocities(until)).max() < 1e-12
            assert np.all(part.events['t'] <= until)


def test_until_after_the_end_of_a_shot():
    whole = simulate(report_table(), (-4.0, 0.0))
    longer = simulate(report_table(), (-4.0, 0.0), until=1000.0)
    np.testing.assert_array_equal(longer.final_positions, whole.final_positions)
    assert longer.events.tobytes() == whole.events.tobytes()
    assert not np.any(longer.final_velocities)


@pytest.mark.parametrize('integrator', ['event', 'time_slice'])
@pytest.mark.parametrize('law', LAWS)
def test_the_same_input_gives_the_same_bits(law, integrator):
    for table, velocities in random_shots(51, 5, law):
        slicing = dict(integrator=integrator, time_slice=1e-4)
        one, two = (simulate(table, velocities, **slicing) for _ in range(2))
        assert one.final_positions.tobytes() == two.final_positions.tobytes()
        assert one.events.tobytes() == two.events.tobytes()
        assert one.duration == two.duration


@pytest.mark.parametrize(
    ('integrator', 'count'),
    [('event', 300), ('time_slice', 6)],
)
@pytest.mark.parametrize('law', LAWS)
def test_many_shots_are_bit_for_bit_those_played_one_by_one(law, integrator, count):
    rng = np.random.default_rng(52)
    table = dataclasses.replace(report_table(), ball_friction=law)
    velocities = np.array([random_velocity(rng) for _ in range(count)])
    options = dict(integrator=integrator, time_slice=1e-4)
    finals, durations, counts = simulate_many(table, velocities, **options)
    assert finals.shape == (count, 11, 2)
    for k, velocity in enumerate(velocities):
        shot = simulate(table, velocity, **options)
        assert finals[k].tobytes() == shot.final_positions.tobytes()
        assert durations[k] == shot.duration
        assert counts[k] == len(shot.events)


def test_many_shots_of_all_balls_with_other_positions_and_until():
    rng = np.random.default_rng(53)
    table = random_table(rng, 5)
    velocities = rng.normal(size=(40, 5, 2))
    mirrored = np.array([table.length, 0.0]) + table.positions * [-1.0, 1.0]
    options = dict(positions=mirrored, until=0.7)
    finals, durations, counts = simulate_many(table, velocities, **options)
    for k in range(len(velocities)):
        shot = simulate(table, velocities[k], **options)
        assert finals[k].tobytes() == shot.final_positions.tobytes()
        assert (durations[k], counts[k]) == (shot.duration, len(shot.events))


def test_no_shots_at_all():
    finals, durations, counts = simulate_many(report_table(), np.empty((0, 2)))
    assert finals.shape == (0, 11, 2)
    assert durations.shape == counts.shape == (0,)


def test_one_ball_rolls_as_far_as_friction_lets_it():
    table = table_of([(0.2, 0.5)], length=10.0)
    shot = simulate(table, (3.0, 0.0))
    assert shot.final_positions[0] == pytest.approx((0.2 + 9.0 / (2 * 0.980665), 0.5), abs=1e-14)
    assert shot.duration == pytest.approx(3.0 / 0.980665, rel=1e-15)
    assert shot.events['kind'].tolist() == [2]


def test_cradle_hands_the_speed_on():
    for count, gap in itertools.product((3, 4, 5), (0.0, 1e-10)):
        places = [(0.3, 0.5)] + [(0.8 + k * (0.1 + gap), 0.5) for k in range(count - 1)]
        table = table_of(places, e_cue_ball=1.0, e_ball_ball=1.0, mu_ball_surface=0.0)
        shot = simulate(table, (1.0, 0.0), until=0.6)
        expected = np.zeros((count, 2))
        expected[-1] = (1.0, 0.0)
        assert np.abs(shot.final_velocities - expected).max() < 1e-9


def test_speed_after_a_hit_by_hand():
    """Head on, e = 0.7, masses 0.2 and 0.16: Equations 1 and 2 worked by hand."""
    table = dataclasses.replace(
        report_table(), balls=report_table().balls[:2], mu_ball_surface=0.0, mu_ball_ball=0.0
    )
    cue, target = table.positions
    toward = (target - cue) / math.dist(target, cue)
    shot = simulate(table, toward, until=0.8)
    # v_a' = (m_a - e m_b) / (m_a + m_b), v_b' = (1 + e) m_a / (m_a + m_b)
    np.testing.assert_allclose(shot.final_velocities[0], toward * 0.088 / 0.36, atol=1e-12)
    np.testing.assert_allclose(shot.final_velocities[1], toward * 0.34 / 0.36, atol=1e-12)
