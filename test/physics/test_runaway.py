"""The report's law of friction can add energy at every contact; such a shot is given up."""

import naive
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numba import njit
from tables import LAWS, kinetic_energy, random_table, random_velocity, under

from pool_sim_ros.physics import report_table, simulate, simulate_many
from pool_sim_ros.physics.motion import runs_away
from pool_sim_ros.physics.runaway import most_energy
from pool_sim_ros.physics.tolerances import RUNAWAY_GAIN


@njit
def compiled_runs_away(balls, i, table, most):
    return runs_away(balls[i], table, most)


LIVELY = {'e_cue_ball': 1.0, 'e_ball_ball': 1.0, 'mu_ball_surface': 1e-3}
"""Coefficients with which little but friction between the balls takes energy away."""


@pytest.mark.parametrize('integrator', ['event', 'time_slice'])
@pytest.mark.parametrize('mu', [1.0, 1.5, 10.0, 1000.0])
@pytest.mark.parametrize('velocity', [(-1e-2, 1e-4), (-10.0, 0.1), (-1e3, 10.0)])
def test_a_shot_that_gains_energy_without_end_is_given_up(integrator, mu, velocity):
    cloth = {'mu_ball_surface': 1e-5 * velocity[0] ** 2}
    table = under(report_table(), **LIVELY | cloth, mu_ball_ball=mu)
    how = {'integrator': integrator, 'time_slice': 1e-4 / abs(velocity[0])}
    with pytest.raises(ValueError, match="mu_ball_ball: .*this shot.*'coulomb'") as caught:
        simulate(table, velocity, **how)
    assert '\n' not in str(caught.value)
    with pytest.raises(ValueError, match='mu_ball_ball: .*shot 1 '):
        simulate_many(table, [(0.0, 0.0), velocity, (0.0, 0.0)], **how)
    how['until'] = 1.0 / abs(velocity[0])
    peaceful = simulate(under(table, ball_friction='coulomb'), velocity, **how)
    assert np.isfinite(peaceful.final_positions).all()


@settings(max_examples=60)
@given(
    mu=st.floats(0.0, 2.0),
    e=st.floats(0.5, 1.0),
    speed=st.floats(0.1, 30.0),
    angle=st.floats(-0.3, 0.3),
)
def test_every_shot_ends_or_is_given_up(mu, e, speed, angle):
    table = under(report_table(), **LIVELY | {'e_ball_ball': e, 'e_cue_ball': e}, mu_ball_ball=mu)
    velocity = (-speed * np.cos(angle), speed * np.sin(angle))
    try:
        shot = simulate(table, velocity, until=10.0)
    except ValueError as error:
        assert 'without end' in str(error)
        assert mu > 0.1, 'no energy is gained without friction'
        return
    before = 0.5 * table.masses[0] * speed**2
    for t in np.linspace(0.0, shot.duration, 50):
        assert kinetic_energy(table, shot.velocities(t)) <= len(table.balls) * RUNAWAY_GAIN * before


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('struck', [1, 5])
@pytest.mark.parametrize('fastest', [1e-300, 1e-3, 1.0, 1e6])
def test_against_the_plain_twin(law, struck, fastest):
    rng = np.random.default_rng(struck)
    for _ in range(20):
        table = random_table(rng, 5, law)
        velocities = np.array([random_velocity(rng, 0.0, fastest) for _ in range(struck)])
        most = most_energy(table.balls_at_rest, table.for_kernels, velocities)
        energy = naive.runaway_energy(table, velocities)
        assert most == pytest.approx(2.0 * energy, rel=1e-12)
        records = table.balls_at_rest.copy()
        for i, ball in enumerate(table.balls):
            for speed in (0.0, 1.0, 9.3 * fastest, 97.0 * fastest, 1e7):
                records[i]['speed'] = speed
                away = 0.5 * ball.mass * speed**2 > energy
                assert compiled_runs_away(records, i, table.for_kernels, most) == away
