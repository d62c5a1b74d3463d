"""What holds in every shot: energy, momentum, restitution, no overlap; some cases by hand."""

import dataclasses
import itertools
import math

import numpy as np
import pytest
from tables import LAWS, kinetic_energy, random_shots, table_of, worst_overlap

from pool_sim_ros.physics import report_table, simulate

V_MIN = 1e-4  # m/s: what the rule for sustained contact may give a ball


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
