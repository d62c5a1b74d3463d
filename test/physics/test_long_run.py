"""The long run's own checks: they pass sound shots and name those that are not."""

import threading

import long_run
import numpy as np
import pytest


def first_chunk():
    return next(long_run.chunks(shots=60, seed=1))


def test_sound_shots_pass():
    laws = []
    for chunk in long_run.chunks(shots=60, seed=1):
        assert chunk.play(every=10).failures == ()
        laws.append(chunk.table.ball_friction)
    assert laws == ['report', 'coulomb']


@pytest.mark.parametrize(
    ('name', 'value', 'words'),
    [
        ('ALLOWED', -1.0, 'deep in another or in a cushion'),
        ('MOST_EVENTS', 0, 'events, more than 0'),
    ],
)
def test_a_fault_at_the_end_names_the_shot(monkeypatch, name, value, words):
    monkeypatch.setattr(long_run, name, value)
    failures = first_chunk().play(every=60).failures
    assert len(failures) == 60
    assert failures[7].startswith('shot 7, report, velocity (')
    assert words in failures[7]


def test_another_end_on_the_way_is_a_fault():
    chunk = first_chunk()
    elsewhere = np.zeros((11, 2))
    fault = long_run.fault_on_the_way(chunk.table, chunk.velocities[0], elsewhere)
    assert fault == 'simulate() ends elsewhere than simulate_many()'


def test_rising_energy_is_a_fault(monkeypatch):
    monkeypatch.setattr(long_run, 'kinetic_energy', lambda table, v: np.arange(len(v), dtype=float))
    _, chunk = long_run.chunks(shots=1, seed=1)
    assert 'energy rises by' in chunk.play(every=1).failures[0]


def test_every_tenth_shot_is_looked_at_whole_across_chunks(monkeypatch):
    looked_at = []
    monkeypatch.setattr(long_run, 'CHUNK', 15)
    monkeypatch.setattr(long_run, 'fault_on_the_way', lambda t, v, f: looked_at.append(v) or '')
    made = [chunk for chunk in long_run.chunks(shots=45, seed=1)][::2]
    for chunk in made:
        chunk.play(every=10)
    velocities = np.concatenate([chunk.velocities for chunk in made])
    np.testing.assert_array_equal(looked_at, velocities[::10])


def test_an_endless_shot_is_named(monkeypatch):
    let_go = threading.Event()
    monkeypatch.setattr(long_run, 'ENDLESS_SHOT', 0.0)
    monkeypatch.setattr(long_run, 'simulate_many', lambda table, velocities: let_go.wait())
    chunk = first_chunk()
    try:
        assert long_run.first_endless(chunk) == chunk.name(0)
    finally:
        let_go.set()
