from dataclasses import replace

import numpy as np
import pytest

from pool_sim_ros.physics import Ball, Table, report_table, simulate
from pool_sim_ros.simulator.health import ENERGY_SAMPLES, REASON_LENGTH, Health, energy_rise


def diagnose(health, now=10.0, stamp=0, factor=1.0, behind=0, slips=0):
    return health.diagnose(now, stamp, factor, behind, slips)


def test_the_speed_is_sim_time_over_wall_time_since_the_last_diagnosis():
    health = Health()
    assert diagnose(health, 5.0, 0).values['achieved speed (sim s / s)'] == 'unknown'
    later = diagnose(health, 7.0, 5_000_000_000)
    assert float(later.values['achieved speed (sim s / s)']) == 2.5


def test_the_worst_lateness_is_that_since_the_last_diagnosis():
    health = Health()
    for lateness in (0.001, 0.004, 0.002):
        health.frame(lateness)
    assert float(diagnose(health).values['worst frame lateness (ms)']) == 4.0
    health.frame(0.003)
    assert float(diagnose(health).values['worst frame lateness (ms)']) == 3.0


def test_rejections_are_counted_and_the_last_one_shown_in_brief():
    health = Health()
    health.rejected('first')
    health.rejected('x' * 10_000)
    values = diagnose(health).values
    assert values['rejected commands'] == '2'
    assert values['last rejection'] == 'x' * REASON_LENGTH


@pytest.mark.parametrize(
    ('rise', 'may_rise', 'words', 'warned'),
    [
        (0.0, False, 'never rose', False),
        (1e-14, False, 'never rose', False),
        (0.01, True, 'report', False),
        (0.01, False, 'rose', True),
        (None, False, 'no result', False),
    ],
)
def test_the_energy_check_warns_where_the_law_does_not_let_it_rise(rise, may_rise, words, warned):
    health = Health()
    assert diagnose(health).values['energy check'] == 'no shot yet'
    health.shot(0.25, rise, may_rise)
    diagnosis = diagnose(health)
    assert words in diagnosis.values['energy check']
    assert diagnosis.values['compute time of the last shot (s)'] == '0.25'
    assert bool(diagnosis.warning) == warned


def test_a_slip_is_warned_of_once():
    health = Health()
    assert diagnose(health, slips=3).warning == ''
    assert 'slipped' in diagnose(health, slips=4).warning
    assert diagnose(health, slips=4).warning == ''


def test_energy_never_rises_under_coulomb_friction():
    table = replace(report_table(), ball_friction='coulomb')
    for angle in np.linspace(0.0, 6.0, 13):
        shot = simulate(table, (4.0 * np.cos(angle), 4.0 * np.sin(angle)))
        assert energy_rise(shot) <= 1e-12


class Recharged:
    """A trajectory of two balls whose kinetic energies, in J, are given at each event."""

    def __init__(self, energies):
        balls = [Ball(str(k), 2.0, 0.1, (0.3 + k, 0.5)) for k in range(2)]
        self.table = Table(2.0, 1.0, balls)
        self.events = np.zeros(len(energies) - 1, [('t', 'f8')])
        self.events['t'] = np.arange(1, len(energies))
        self._speeds = np.sqrt(energies)

    def velocities(self, times):
        found = np.zeros((len(times), 2, 2))
        found[:, 1, 0] = self._speeds[np.asarray(times, int)]
        return found


def test_a_rise_of_the_energy_is_relative_to_the_strike_and_from_the_least():
    assert energy_rise(Recharged([8.0, 6.0, 2.0, 3.0, 4.0, 1.0])) == pytest.approx(0.25)
    assert energy_rise(Recharged([8.0, 6.0, 2.0])) == 0.0
    assert energy_rise(Recharged([0.0])) == 0.0


def test_a_long_shot_is_sampled():
    energies = np.linspace(9.0, 1.0, 20 * ENERGY_SAMPLES)
    energies[10 * ENERGY_SAMPLES :] += 4.0
    assert energy_rise(Recharged(energies)) == pytest.approx(4.0 / 9.0, rel=1e-2)


RACK = tuple(
    Ball(
        f'{row}{place}', 0.17, 0.028, (1.2 + row * 0.028 * 3**0.5, 0.5 + (2 * place - row) * 0.028)
    )
    for row in range(5)
    for place in range(row + 1)
)


@pytest.mark.parametrize('e', [0.0, 0.5, 0.9, 1.0])
@pytest.mark.parametrize('speed', [1e-4, 1e-3, 1e-2, 0.1, 1.0, 8.0])
def test_a_strike_within_a_rack_that_touches_is_not_warned_of(speed, e):
    """Weak contacts may add what parting at V_MIN takes: docs/physics.md allows that."""
    cue = Ball('C', 0.17, 0.028, (1.2 - 0.056, 0.5), is_cue=True)
    table = Table(2.5, 1.2, (cue, *RACK), ball_friction='coulomb', e_ball_ball=e, e_cue_ball=e)
    health = Health()
    health.shot(0.1, energy_rise(simulate(table, (speed, 0.1 * speed))), False)
    assert diagnose(health).warning == ''


@pytest.mark.parametrize(('after', 'warned'), [(7.9, False), (8.0 + 3e-8, False), (8.0008, True)])
def test_a_rise_that_weak_contacts_cannot_make_is_warned_of(after, warned):
    """Two balls of 2 kg: 1.6e-7 J are allowed at four events."""
    health = Health()
    health.shot(0.1, energy_rise(Recharged([8.0, 8.0, after, 7.0, 7.0])), False)
    assert bool(diagnose(health).warning) == warned
