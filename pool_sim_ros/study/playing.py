"""Plays the shots of a region: from its inputs to what comes of them."""

from __future__ import annotations

import dataclasses
import threading
from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import Outcomes, Table, cue_strikes, simulate_many, unit_vectors
from pool_sim_ros.study.inputs import LAYOUT, SPINS, coefficients_of, strike_of
from pool_sim_ros.study.outcome_arrays import STORED
from pool_sim_ros.study.plan import Plan, Region
from pool_sim_ros.study.ranges import is_random, row_of
from pool_sim_ros.study.shot_random import WORDS, normals, words_of

Floats = NDArray[np.float64]
Value = Callable[[str], Floats]

CANNOT_BE = 4
"""In `failed`: the tip slips off, or a coefficient that was drawn is out of its range."""


class Player:
    """Plays the regions of a plan, in any order, in memory that it keeps.

    Parameters
    ----------
    plan : Plan
    threads : int or None
        As in `simulate_many`.
    """

    def __init__(self, plan: Plan, threads: int | None) -> None:
        self._plan, self._threads = plan, threads
        self._kept = threading.local()

    def play(self, region: Region) -> dict[str, NDArray[np.generic]]:
        """Return what is kept of a region: name -> array of shape (count, ...).

        The arrays are good until the thread plays its next one.
        """
        plan = self._plan
        value = lru_cache(maxsize=None)(lambda name: plan.values(name, region))
        velocities, spins = self._strikes(region, value)
        positions = self._layouts(region, value)
        wrong = np.isnan(velocities[:, 0])
        velocities[wrong] = 0.0
        if spins is not None:
            spins[wrong] = 0.0
        out = self._room(region.count)
        pocketed = (
            np.full((region.count, len(plan.table.balls)), -1) if len(plan.table.pockets) else None
        )
        for table, part in self._runs(region, value):
            if table is None:
                wrong[part] = True
                continue
            played = simulate_many(
                table,
                velocities[part],
                spins=None if spins is None else spins[part],
                positions=positions[part]
                if positions is not None and positions.ndim == 3
                else positions,
                errors='mark',
                threads=self._threads,
                out=_part(out, part),
            )
            if pocketed is not None:
                pocketed[part] = played.pocketed
        outcomes = _with_pocketed(out, pocketed)
        if wrong.any():
            outcomes.failed[wrong] = CANNOT_BE
        if (outcomes.failed != 0).any():
            _erase(outcomes, outcomes.failed != 0)
        return {**self._outcomes(outcomes), **{name: value(name) for name in plan.drawn}}

    def _outcomes(self, outcomes: Outcomes) -> dict[str, NDArray[np.generic]]:
        plan, found = self._plan, {}
        every = plan.balls == tuple(range(len(plan.table.balls)))
        for name in plan.keep:
            array = getattr(outcomes, name)
            if array is None:
                array = np.full((len(outcomes.durations), len(plan.balls)), -1)
            elif 'ball' in STORED[name].dimensions and not every:
                array = array[:, plan.balls]
            found[name] = array.astype(STORED[name].dtype, copy=False)
        return found

    def _room(self, count: int) -> Outcomes:
        """Return arrays to write to: those of this thread, if they are large enough."""
        room: Outcomes | None = getattr(self._kept, 'room', None)
        if room is None or len(room.durations) < count:
            n = len(self._plan.table.balls)
            room = Outcomes(
                np.empty((count, n, 2)),
                np.empty(count),
                np.empty(count, np.int64),
                None,  # type: ignore[arg-type]
                np.empty(count, np.int64),
                np.empty(count, np.int8),
                None,
                None,
            )
            self._kept.room = room
        return _part(room, slice(0, count))

    def _strikes(self, region: Region, value: Value) -> tuple[Floats, Floats | None]:
        plan = self._plan
        kind = strike_of(plan.inputs)
        if kind == 'cue':
            names = ('cue_speed', 'azimuth', 'elevation', 'side', 'above')
            velocities, spins = cue_strikes(plan.table, *map(value, names))
            return velocities, spins if plan.table.motion == 'ball' else None
        if kind == 'polar':
            x, y = unit_vectors(value('angle'))
            speed = value('speed')
            velocities = np.stack([speed * x, speed * y], axis=1)
        else:
            velocities = np.stack([value('vx'), value('vy')], axis=1)
        if not any(name in plan.inputs for name in SPINS):
            return velocities, None
        still = np.zeros(region.count)
        turning = [value(name) if name in plan.inputs else still for name in SPINS]
        return velocities, np.stack(turning, axis=1)

    def _layouts(self, region: Region, value: Value) -> Floats | None:
        """Return one layout for all, (n, 2), one a shot, (count, n, 2), or None: the table's."""
        plan, n = self._plan, len(self._plan.table.balls)
        placed = [k for k, label in enumerate(plan.table.labels) if f'x_{label}' in plan.inputs]
        layouts = plan.layouts
        if layouts is not None:
            layouts = layouts[plan.places(LAYOUT, region)] if len(layouts) > 1 else layouts[0]
        if not placed and 'jitter' not in plan.inputs:
            return layouts
        base = plan.table.positions if layouts is None else layouts
        layouts = np.array(np.broadcast_to(base, (region.count, n, 2)))
        for k in placed:
            label = plan.table.labels[k]
            layouts[:, k, 0] = value(f'x_{label}')
            layouts[:, k, 1] = value(f'y_{label}')
        if 'jitter' in plan.inputs:
            drawn = [
                normals(words_of(plan.seed, f'jitter {k}', region.first, region.count))
                for k in range(-(-2 * n // WORDS))
            ]
            noise = np.concatenate(drawn, axis=1)[:, : 2 * n].reshape(region.count, n, 2)
            layouts += value('jitter')[:, np.newaxis, np.newaxis] * noise
        return layouts

    def _runs(self, region: Region, value: Value) -> list[tuple[Table | None, slice]]:
        """Return which shots are played on which table; None: it cannot be."""
        plan = self._plan
        names = [name for name in coefficients_of(plan.table) if name in plan.inputs]
        if not names:
            return [(plan.table, slice(0, region.count))]
        if all(row_of(plan.inputs[n]) is None and not is_random(plan.inputs[n]) for n in names):
            fixed = tuple(float(value(n)[0]) for n in names)
            return [(table_with(plan.table, tuple(names), fixed), slice(0, region.count))]
        values = np.stack([value(name) for name in names], axis=1)
        changes = np.flatnonzero((values[1:] != values[:-1]).any(axis=1)) + 1
        ends = [0, *changes.tolist(), region.count]
        return [
            (
                table_with(plan.table, tuple(names), tuple(values[first].tolist())),
                slice(first, stop),
            )
            for first, stop in zip(ends, ends[1:], strict=False)
        ]


@lru_cache(maxsize=64)
def table_with(table: Table, names: tuple[str, ...], values: tuple[float, ...]) -> Table | None:
    """Return a table with other coefficients, or None where they cannot be."""
    try:
        changes: dict[str, Any] = dict(zip(names, values, strict=True))
        return dataclasses.replace(table, **changes)
    except ValueError:
        return None


def _part(outcomes: Any, part: slice) -> Outcomes:
    parts: list[Any] = [each if each is None else each[part] for each in outcomes]
    return Outcomes(*parts)


def _with_pocketed(outcomes: Any, pocketed: NDArray[np.int64] | None) -> Outcomes:
    """Return outcomes with these, None where nobody pockets anything."""
    complete: Outcomes = outcomes._replace(pocketed=pocketed)
    return complete


def _erase(outcomes: Outcomes, failed: NDArray[np.bool_]) -> None:
    outcomes.finals[failed] = np.nan
    outcomes.durations[failed] = np.nan
    outcomes.event_counts[failed] = -1
    outcomes.first_hit[failed] = -1
    if outcomes.pocketed is not None:
        outcomes.pocketed[failed] = -1
