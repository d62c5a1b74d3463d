"""Steps a second of the environments, beside the calls of `simulate_many` that they make."""

import statistics
import time

import numpy as np
import pytest
from benchmark.cores import cores
from benchmark.results import per_second, significant

from pool_sim_ros.physics import simulate_many

gymnasium = pytest.importorskip('gymnasium')

import pool_sim_ros.study  # noqa: E402, F401, registers the environments

SECTION = 'Environments, one core'
ROUNDS = 15
TARGETS = {
    ('PoolSim/Place-v0', 1): ('', ''),
    ('PoolSim/Place-v0', 64): ('600,000 steps/s', ''),
    ('PoolSim/Place-v0', 4096): ('1,000,000 steps/s', ''),
    ('PoolSim/Pot-v0', 64): ('', '0.8'),
    ('PoolSim/Pot-v0', 4096): ('', '0.8'),
}
STEPS = {1: 2000, 64: 200, 4096: 8}


class Recorded:
    """A `simulate_many` that keeps what it is given, to be played again without an environment."""

    def __init__(self):
        self.calls = []

    def __call__(self, table, velocities, *, spins, positions, **rest):
        copies = None if spins is None else spins.copy()
        self.calls.append((table, velocities.copy(), copies, positions.copy(), rest))
        return simulate_many(table, velocities, spins=spins, positions=positions, **rest)

    def again(self):
        for table, velocities, spins, positions, rest in self.calls:
            simulate_many(table, velocities, spins=spins, positions=positions, **rest)


@pytest.mark.parametrize(('name', 'count'), TARGETS)
def test_steps_beside_the_same_shots_alone(results, monkeypatch, name, count):
    envs = gymnasium.make_vec(name, count)
    steps = STEPS[count] if name == 'PoolSim/Place-v0' else max(STEPS[count] // 4, 2)
    width = envs.single_action_space.shape[0]
    actions = np.random.default_rng(1).uniform(-1.0, 1.0, (steps, count, width))

    def play():
        envs.reset(seed=0)
        start = time.thread_time()
        for action in actions:
            envs.step(action)
        return (time.thread_time() - start) / (steps * count)

    recorded = Recorded()
    with monkeypatch.context() as patch:
        patch.setattr('pool_sim_ros.study.tasks.simulate_many', recorded)
        play()
    own, alone = [], []
    with cores(1):
        for _ in range(ROUNDS):
            own.append(play())
            start = time.thread_time()
            recorded.again()
            alone.append((time.thread_time() - start) / (steps * count))
    rate, share = TARGETS[name, count]
    results.add(SECTION, f'`{name}`, {count} at once', own, per_second(1, 'steps'), rate)
    ratio = statistics.median(shots / step for shots, step in zip(alone, own, strict=True))
    what = f'`{name}`, {count} at once, beside `simulate_many` of the same shots'
    results.note(SECTION, what, significant(ratio, 2), share)
