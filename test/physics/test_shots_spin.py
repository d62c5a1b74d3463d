"""Shots of balls that spin, against two oracles of 40 digits: every event, and every place."""

import dataclasses

import numpy as np
import oracle_spin
import pytest
from billiards import oracle
from mpmath import mpf
from spinning import oracle_table, random_strikes, scattered, spinning_table, strikes_of

from pool_sim_ros.physics import pool_table, simulate, simulate_many

SHOTS = oracle()['shots']
KINDS = oracle_spin.KINDS
NUDGE = mpf('1e-25')  # m: what shows how sensitive a shot is
MODELS = ('han', 'impulse', 'stronge')
BOUNDS = ('impulse', 'restitution')
LAWS = ('coulomb', 'alciatore')


def tolerance(sensitivity):
    """What rounding may make of a place, m: three times that of a shot of this sensitivity."""
    return 3e-15 * sensitivity + 1e-12


def counts_of(events):
    return {kind: int((events['kind'] == number).sum()) for kind, number in KINDS.items()}


@pytest.mark.parametrize('number', range(len(SHOTS)))
def test_shots_of_another_oracle(number):
    """Twelve shots of 2 to 50 events, on all models but Mathavan's."""
    given = SHOTS[number]
    table = oracle_table(given)
    velocities, spins = strikes_of(given)
    shot = simulate(table, velocities, spins=spins)
    expected = {kind: given['counts'].get(kind, 0) for kind in KINDS}
    assert counts_of(shot.events) == expected
    allowed = tolerance(given['sensitivity'])
    np.testing.assert_allclose(
        shot.final_positions, np.array(given['finals'], float), rtol=0, atol=allowed
    )
    assert shot.complete
    many = simulate_many(table, velocities[None], spins=spins[None])
    assert many.finals[0].tobytes() == shot.final_positions.tobytes()
    assert many.durations[0] == shot.duration
    assert many.event_counts[0] == sum(expected.values())


def sensitivity_of(table, velocities, spins, places, found):
    """Return how much farther apart shots end that begin a little apart, by the oracle."""
    worst = 1.0
    rng = np.random.default_rng(0)
    for _ in range(2):
        nudges = rng.choice([-1, 1], places.shape)
        moved = [
            [mpf(x) + NUDGE * int(by) for x, by in zip(place, row, strict=True)]
            for place, row in zip(places, nudges, strict=True)
        ]
        other = oracle_spin.simulate(table, velocities, spins, moved)
        for one, two in zip(found.finals, other.finals, strict=True):
            apart = max(abs(x - y) for x, y in zip(one, two, strict=True))
            worst = max(worst, float(apart / NUDGE))
    return worst


def assert_as_the_oracle_has_it(table, velocities, spins, places):
    """Compare one shot; return whether the oracle knows its outcome."""
    try:
        found = oracle_spin.simulate(table, velocities, spins, places, most_events=80)
        sensitivity = sensitivity_of(table, velocities, spins, places, found)
    except oracle_spin.AmbiguousShotError:
        return False
    if sensitivity > 1e8:
        return False
    shot = simulate(table, velocities, spins=spins, positions=places)
    events = [(kind, a, b) for _, kind, a, b in oracle_spin.engine_events(found)]
    assert shot.events[['kind', 'a', 'b']].tolist() == events
    allowed = tolerance(sensitivity)
    finals = np.array([[float(x) for x in place] for place in found.finals])
    np.testing.assert_allclose(shot.final_positions, finals, rtol=0, atol=allowed)
    assert shot.pocketed.tolist() == found.pocketed
    many = simulate_many(table, velocities[None], spins=spins[None], positions=places)
    assert many.finals[0].tobytes() == shot.final_positions.tobytes()
    return True


def random_shot(seed, pockets):
    """Return a table, a strike and places, of which every seed has other laws."""
    rng = np.random.default_rng([seed, pockets])
    laws = dict(
        cushion_model=MODELS[seed % 3],
        friction_bound=BOUNDS[seed // 3 % 2],
        ball_friction=LAWS[seed // 6 % 2],
    )
    if pockets:
        full = pool_table('7ft')
        table = dataclasses.replace(full, balls=full.balls[:4], **laws)
    else:
        table = spinning_table([(0.3 + 0.3 * k, 0.5) for k in range(4)], **laws)
    velocities, spins = random_strikes(rng, 1, (0.3, 2.5), 60.0)
    return table, velocities[0], spins[0], scattered(rng, table)


def play_seeds(seeds, pockets):
    return sum(assert_as_the_oracle_has_it(*random_shot(seed, pockets)) for seed in seeds)


@pytest.mark.parametrize('pockets', [False, True])
def test_a_few_random_shots_on_our_own_oracle(pockets):
    assert play_seeds(range(3), pockets) > 0


@pytest.mark.soak
@pytest.mark.parametrize('pockets', [False, True])
def test_random_shots_on_our_own_oracle(pockets):
    """With all laws: models, bounds and friction."""
    assert play_seeds(range(36), pockets) >= 20
