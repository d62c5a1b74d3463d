"""`find_shots`: the shots that most likely meet a goal, given how badly one shoots and sees."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pool_sim_ros.oracle.assess import assess
from pool_sim_ros.oracle.checks import checked_positions, time_allowed, whole
from pool_sim_ros.oracle.climb import climb_best
from pool_sim_ros.oracle.cluster import Cluster
from pool_sim_ros.oracle.goal import Goal, goal_of
from pool_sim_ros.oracle.noise import Noise, NoiseName, noise_of
from pool_sim_ros.oracle.plan import Plan
from pool_sim_ros.oracle.race import race
from pool_sim_ros.oracle.space import checked_space
from pool_sim_ros.oracle.sweep import Sweep
from pool_sim_ros.oracle.trials import Trials
from pool_sim_ros.physics import Table

SWEEP, RACE, CLIMB, FRESH = 0.5, 0.15, 0.25, 0.1
"""Shares of the shots. A good map matters most: what it misses nobody finds later."""

EVENLY, POWERS = 0.6, (1.0, 2.0)
"""Of the sweep, what is spread evenly; and how much the rest prefers the better places."""

DEADLINES = {'sweep': 0.65, 'race': 0.8, 'climb': 0.9}
"""Shares of `seconds` after which a stage ends, so that those after it have some time left."""

PEAKS = 256
"""Of the map that are raced."""

FEWEST = 1000
"""Shots below which a search would find nothing but luck."""


def find_shots(
    table: Table,
    goal: Goal | dict[str, Any],
    noise: Noise | NoiseName | dict[str, float],
    shots: int = 330_000,
    seed: int = 0,
    seconds: float | None = None,
    threads: int | None = None,
    *,
    positions: ArrayLike | None = None,
    count: int = 5,
    speeds: tuple[float, float] = (0.3, 5.0),
    offset: float = 0.0,
    on_round: Callable[[int], object] | None = None,
    cluster: Cluster | None = None,
) -> Plan:
    """Search for the shots that most likely meet a goal.

    Parameters
    ----------
    table : Table
        Its first ball is the cue ball.
    goal : Goal, or its fields
    noise : Noise, its fields, or the name of a preset
        How badly the shot is executed, and how badly the balls were seen.
    shots : int, optional
        That are played, about; at least 1000. They alone decide what is found. Where a goal is met
        so seldom that the sweep goes on, they are up to 1.7 times as many.
    seed : int, optional
        The same seed gives the same answer, whatever the number of threads.
    seconds : float, optional
        Ends the search after so many s, between two rounds, before all shots are played; the answer
        then says so.
    threads : int, optional
        At most so many; by default one for each core.
    positions : array_like of shape (n, 2), optional
        Where the balls were seen instead of their own places, m.
    count : int, optional
        Shots to return, at most.
    speeds : (float, float), optional
        Least and greatest speed sought, m/s: of the cue where balls spin, otherwise of the ball.
    offset : float, optional
        Greatest offset of the tip that is sought, radii; 0 aims at the middle of the ball. Only
        where balls spin; give more `shots` with it.
    on_round : callable, optional
        Called with the number of shots played: 0 once all is checked, and then between two rounds.
        What it raises ends the search, and reaches the caller.
    cluster : Cluster, optional
        Where to play instead of here; the answer is the same.

    Returns
    -------
    Plan
        The shots, best first, none where none was found.

    Raises
    ------
    ValueError
        For a goal that the table cannot have, and for values out of range; names them.
    ClusterError
        Where the cluster does not play.

    Examples
    --------
    >>> from pool_sim_ros.physics import report_table
    >>> goal = Goal(ball='9', to=(0.3, 0.2), within=0.2)
    >>> plan = find_shots(report_table(), goal, Noise(speed=0.05, azimuth=0.2), shots=40_000)
    >>> plan[0].chance > 0.3
    True
    """
    begin = time.perf_counter()
    shots, seed, count = (
        whole('shots', shots, FEWEST),
        whole('seed', seed),
        whole('count', count, 1),
    )
    allowed = time_allowed(seconds)
    space = checked_space(table, speeds, offset)
    seen = checked_positions(table, positions)
    trials = Trials(table, goal_of(goal), noise_of(noise), seen, threads, cluster)
    cut: list[str] = []
    if on_round is not None:
        on_round(0)

    def late(stage: str) -> Callable[[], bool]:
        def is_late() -> bool:
            if on_round is not None:
                on_round(trials.played)
            if time.perf_counter() - begin > allowed * DEADLINES[stage]:
                cut.append(stage)
            return bool(cut)

        return is_late

    sweep = Sweep(trials, space, int(EVENLY * SWEEP * shots), seed)
    sweep.go_on(int(EVENLY * SWEEP * shots), late('sweep'))
    for power in POWERS:
        if not cut:
            part = (1.0 - EVENLY) / len(POWERS)
            sweep.focus(int(part * SWEEP * shots), power, late('sweep'))
    if sweep.met == 0 and not cut:
        sweep.go_on(shots, late('sweep'))
    if sweep.met == 0:
        return Plan((), trials.played, bool(cut))
    # What a cut sweep did not play nobody plays later either.
    budget = min(shots, int(trials.played / SWEEP))
    swept_all = not cut
    cut.clear()
    aims = race(trials, space, sweep.peaks(PEAKS), int(RACE * budget), seed, late('race'))
    aims = climb_best(trials, space, aims, (int(CLIMB * budget), count), seed, late('climb'))
    fresh = int(FRESH * budget)
    ranked = [
        assess(trials, aim, max(share, 100), np.random.default_rng([seed, 6, k]))
        for k, (aim, share) in enumerate(zip(aims, shares(fresh, len(aims)), strict=True))
    ]
    found = [shot for shot in ranked if shot.chance > 0.0]
    return Plan(found, trials.played, bool(cut) or not swept_all)


def shares(shots: int, count: int) -> list[int]:
    """Share shots out to so many aims: the best gets half of them."""
    if count == 1:
        return [shots]
    return [shots // 2] + [shots // 2 // (count - 1)] * (count - 1)
