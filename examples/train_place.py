"""Learn to bring a ball to a place with one shot, by the cross-entropy method: a minute's work.

    pip install '.[gym,plot]'  # in the folder of this repository
    python examples/train_place.py

The table is the report's with two balls on it. A policy has six numbers: how far beside the ball,
away from the place, it aims, and how its speed depends on what it sees. Each generation draws
policies from a normal distribution, lets each play the same starts, and fits the distribution to
the best of them (Rubinstein 1999).
"""

import argparse
import dataclasses
import time

import gymnasium
import numpy as np

import pool_sim_ros.study  # noqa: F401, registers the environments
from pool_sim_ros.physics import report_table

POLICIES, STARTS, BEST = 128, 512, 16
SHRINKS_TO = 0.005
"""Least standard deviation that is added, so that the search does not end too early."""


def two_balls():
    """Return the report's table with the cue ball and ball 9."""
    table = report_table()
    return dataclasses.replace(table, balls=(table.balls[0], table.balls[9]))


def make(count, table):
    """Return environments whose episodes are one shot long."""
    return gymnasium.make_vec(
        'PoolSim/Place-v0',
        count,
        table=table,
        max_episode_steps=1,
        autoreset_mode='SameStep',
    )


def act(seen, weights):
    """Return the actions of each policy, (p, s, 2), for weights (p, 6) and what is seen, (s, 6)."""
    cue, ball, place = seen[:, :2], seen[:, 2:4], seen[:, 4:]
    near, far = (np.linalg.norm(way, axis=1, keepdims=True) for way in (ball - cue, place - ball))
    ahead, onward = (ball - cue) / near, (place - ball) / far
    cut = (ahead * onward).sum(axis=1, keepdims=True)  # the cosine of the angle between the two
    beside, more, speed, by_far, by_near, by_cut = weights.T[:, :, np.newaxis, np.newaxis]
    aim = ahead + (beside + more * cut) * onward / near
    aim /= np.linalg.norm(aim, axis=2, keepdims=True)
    return aim * (speed + by_far * np.sqrt(far) + by_near * near + by_cut * cut)


def returns(envs, weights, seeds):
    """Return what each policy earns on average, (p,), for weights (p, 6) and the same seeds."""
    seen, _ = envs.reset(seed=np.tile(seeds, len(weights)))
    actions = act(seen[: len(seeds)], weights)
    _, rewards, *_ = envs.step(actions.reshape(-1, 2))
    return rewards.reshape(len(weights), -1).mean(axis=1)


def train(generations, seed=0, tell=print):
    """Return the weights that were learned, and what they earned after each generation."""
    rng, table = np.random.default_rng(seed), two_balls()
    envs, test = make(POLICIES * STARTS, table), make(2000, table)
    mean, deviation = np.zeros(6), np.full(6, 0.5)
    curve = []
    for generation in range(generations):
        weights = mean + deviation * rng.normal(size=(POLICIES, 6))
        seeds = rng.integers(1_000_000, 2**40, STARTS)
        best = np.argsort(returns(envs, weights, seeds))[-BEST:]
        mean = weights[best].mean(axis=0)
        deviation = weights[best].std(axis=0) + SHRINKS_TO
        curve.append(float(returns(test, mean[np.newaxis], np.arange(2000))[0]))
        tell(f'generation {generation + 1}: a shot earns {curve[-1]:.3f}')
    return mean, curve


def main():
    """Train, print what was learned, and write the curve."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--generations', type=int, default=60)
    parser.add_argument('--curve', metavar='FILE', help='write a picture of the curve')
    given = parser.parse_args()
    start = time.perf_counter()
    _, curve = train(given.generations)
    shots = given.generations * (POLICIES * STARTS + 2000)
    print(f'{shots:,} shots in {time.perf_counter() - start:.1f} s')
    if given.curve:
        from matplotlib.figure import Figure

        figure = Figure(figsize=(6, 3.5), layout='constrained')
        axes = figure.subplots()
        axes.plot(range(1, len(curve) + 1), curve)
        axes.set(xlabel='generation', ylabel='mean reward of a shot')
        figure.savefig(given.curve)


if __name__ == '__main__':
    main()
