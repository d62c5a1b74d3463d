"""Twelve problems for a search of shots, and the true chance of a shot.

Discs on the report's table and on random layouts of it; places and touching; errors of a stroke as
in the presets, and a camera of 0.5 to 2 mm.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.oracle import Goal, Noise
from pool_sim_ros.oracle.trials import Trials
from pool_sim_ros.physics import Ball, Table, report_table

SPEEDS = (0.3, 5.0)
"""Least and greatest speed that is sought, m/s: the default of `find_shots`."""

PASS = 100_000
"""Shots that are played in one call."""


@dataclass(frozen=True)
class Problem:
    """A goal on a table, for somebody with these errors."""

    name: str
    table: Table
    goal: Goal
    noise: Noise

    def trials(self) -> Trials:
        """Return what plays shots of this problem, on one core."""
        return Trials(self.table, self.goal, self.noise, np.array(self.table.positions), 1)


def seen(preset: str, camera: float) -> Noise:
    """Return the noise of a preset with a camera, m."""
    return dataclasses.replace(Noise.preset(preset), camera=camera)


def layout(count: int, seed: int) -> Table:
    """Return the report's table with its first balls at random places, at least 1 cm apart."""
    table, rng = report_table(), np.random.default_rng(seed)
    balls: list[Ball] = []
    while len(balls) < count:
        ball = table.balls[len(balls)]
        margin = ball.radius + 0.01
        place = rng.uniform(margin, (table.length - margin, table.width - margin))
        if all(np.hypot(*(place - b.position)) > ball.radius + b.radius + 0.01 for b in balls):
            balls.append(dataclasses.replace(ball, position=tuple(place.tolist())))
    return dataclasses.replace(table, balls=tuple(balls))


def problems() -> list[Problem]:
    """Return the twelve, the report's table first."""
    own, olympic, robot = report_table(), seen('fastfiz', 1e-3), seen('sjtu', 1e-3)
    found = [
        ('place 9', own, Goal(ball='9', to=(0.3, 0.2), within=0.1), olympic),
        ('touch 2 and 3', own, Goal(touches='2') & Goal(touches='3'), seen('sjtu', 2e-3)),
        ('place 1 in a corner', own, Goal(ball='1', rectangle=(1.7, 0.0, 2.2, 0.4)), robot),
        (
            '1 first, cue home',
            own,
            Goal(first_hit='1') & Goal(cue_to=(1.6, 0.5), within=0.3),
            robot,
        ),
        ('place 5, rare', own, Goal(ball='5', to=(0.6, 0.9), within=0.05), seen('fastfiz', 5e-4)),
        ('place 2 of four', layout(4, 1), Goal(ball='2', to=(1.1, 0.3), within=0.08), olympic),
        ('cue in a corner', layout(7, 2), Goal(cue_to=(0.2, 0.2), within=0.06), robot),
        ('touch 1, 2 and 3', layout(5, 3), Goal(all=[Goal(touches=k) for k in '123']), olympic),
        (
            'place 4, avoid 5 and 6',
            layout(7, 4),
            Goal(ball='4', to=(1.8, 0.9), within=0.06) & Goal(avoid='5') & Goal(avoid='6'),
            robot,
        ),
        ('place 10 of eleven', layout(11, 5), Goal(ball='10', to=(1.5, 0.5), within=0.07), olympic),
        (
            'place two',
            layout(6, 6),
            Goal(ball='1', to=(0.5, 0.5), within=0.2) & Goal(cue_to=(1.6, 0.6), within=0.25),
            seen('sjtu', 5e-4),
        ),
        ('7 first, 3 stays near', layout(11, 7), near_after(layout(11, 7), '7', '3'), olympic),
    ]
    return [Problem(*given) for given in found]


def near_after(table: Table, first: str, other: str) -> Goal:
    """Return the goal to touch a ball first, and another one, which then ends near its place."""
    x, y = table.balls[table.index(other)].position
    place = Goal(ball=other, to=(x, y), within=0.3)
    return Goal(first_hit=first) & Goal(touches=other) & place


def passes(shots: int) -> Iterator[int]:
    """Yield how many shots to play in each of some calls."""
    while shots > 0:
        yield min(shots, PASS)
        shots -= PASS


def true_chance(trials: Trials, aim: NDArray[np.float64], shots: int, seed: list[int]) -> float:
    """Return the chance of an aim, (5,), from shots that nobody else plays."""
    rng, met = np.random.default_rng(seed), 0
    for count in passes(shots):
        strokes = trials.executed(aim, rng.standard_normal((count, 5)))
        met += int(trials.play(strokes, trials.layouts.draw(count, rng)).met.sum())
    return met / shots
