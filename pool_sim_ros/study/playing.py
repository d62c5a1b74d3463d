"""Plays the shots of a region: from its inputs to what comes of them."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from functools import cache, lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import Outcomes, Table, cue_strikes, simulate_many, unit_vectors
from pool_sim_ros.study.inputs import LAYOUT, SPINS, STRIKES, coefficients_of, strike_of
from pool_sim_ros.study.outcome_arrays import STORED
from pool_sim_ros.study.plan import Plan, Region
from pool_sim_ros.study.ranges import is_random, row_of
from pool_sim_ros.study.shot_random import WORDS, normals, words_of
from pool_sim_ros.study.workspace import Workspace, pieces

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
        self._kept = Workspace()

    def play(self, region: Region) -> dict[str, NDArray[np.generic]]:
        """Return what is kept of a region: name -> array of shape (count, ...).

        The arrays are good until the thread plays its next one.
        """
        plan = self._plan

        @cache
        def value(name: str) -> Floats:
            return plan.values(name, region, self._kept.room(f'input {name}', region.count))

        velocities, spins = self._strikes(region, value)
        positions = self._layouts(region, value)
        wrong = np.isnan(velocities[:, 0])
        if wrong.any():
            velocities[wrong] = 0.0
            if spins is not None:
                spins[wrong] = 0.0
        outcomes = self._room(region.count)
        for table, part in self._runs(region, value):
            if table is None:
                wrong[part] = True
                continue
            simulate_many(
                table,
                velocities[part],
                spins=None if spins is None else spins[part],
                positions=positions[part]
                if positions is not None and positions.ndim == 3
                else positions,
                errors='mark',
                threads=self._threads,
                out=_part(outcomes, part),
            )
        if wrong.any():
            outcomes.failed[wrong] = CANNOT_BE
        if outcomes.failed.any():
            _erase(outcomes, outcomes.failed != 0)
        return {**self._outcomes(outcomes), **{name: value(name) for name in plan.drawn}}

    def _outcomes(self, outcomes: Outcomes) -> dict[str, NDArray[np.generic]]:
        """Return the outcomes as a sweep stores them."""
        plan, found = self._plan, {}
        every = plan.balls == tuple(range(len(plan.table.balls)))
        for name in plan.keep:
            array, stored = getattr(outcomes, name), STORED[name]
            if array is not None and 'ball' in stored.dimensions and not every:
                array = array[:, plan.balls]
            if array is None or array.dtype != stored.dtype:
                row = (len(plan.balls),) if 'ball' in stored.dimensions else ()
                room = self._kept.room(f'stored {name}', len(outcomes.failed), row, stored.dtype)
                np.copyto(room, -1 if array is None else array, casting='same_kind')
                array = room
            found[name] = array
        return found

    def _room(self, count: int) -> Outcomes:
        """Return arrays to write to; no pockets, none for what lies in them."""
        room, n = self._kept.room, len(self._plan.table.balls)
        return Outcomes(
            finals=room('finals', count, (n, 2)),
            durations=room('durations', count),
            event_counts=room('event_counts', count, (), np.int64),
            pocketed=room('pocketed', count, (n,), np.int64)
            if len(self._plan.table.pockets)
            else None,  # type: ignore[arg-type]
            first_hit=room('first_hit', count, (), np.int64),
            failed=room('failed', count, (), np.int8),
            events=None,
            offsets=None,
        )

    def _strikes(self, region: Region, value: Value) -> tuple[Floats, Floats | None]:
        """Return velocities, (count, 2) in m/s, and spins, (count, 3) in rad/s, or None."""
        plan = self._plan
        kind = strike_of(plan.inputs)
        given = [value(name) for name in STRIKES[kind]]
        velocities = self._kept.room('velocities', region.count, (2,))
        turning = kind == 'cue' and plan.table.motion == 'ball'
        turning = turning or any(name in plan.inputs for name in SPINS)
        spins = self._kept.room('spins', region.count, (3,)) if turning else None
        for part in pieces(region.count):
            here = velocities[part]
            if kind == 'cue':
                here[...], turns = cue_strikes(plan.table, *(each[part] for each in given))
                if spins is not None:
                    spins[part] = turns
                continue
            if kind == 'polar':
                angle, speed = given
                for k, along in enumerate(unit_vectors(angle[part])):
                    np.multiply(speed[part], along, out=here[:, k])
            else:
                here[:, 0], here[:, 1] = (each[part] for each in given)
        if spins is not None and kind != 'cue':
            for k, name in enumerate(SPINS):
                spins[:, k] = value(name) if name in plan.inputs else 0.0
        return velocities, spins

    def _layouts(self, region: Region, value: Value) -> Floats | None:
        """Return one layout for all, (n, 2), one a shot, (count, n, 2), or None: the table's."""
        plan, n = self._plan, len(self._plan.table.balls)
        placed = [k for k, label in enumerate(plan.table.labels) if f'x_{label}' in plan.inputs]
        several = plan.layouts is not None and len(plan.layouts) > 1
        base = None if plan.layouts is None else plan.layouts[0]
        if not (placed or several or 'jitter' in plan.inputs):
            return base
        layouts = self._kept.room('layouts', region.count, (n, 2))
        if plan.layouts is not None and several:
            base = plan.spread(LAYOUT, plan.layouts, region)
        layouts.reshape(*region.shape, n, 2)[...] = plan.table.positions if base is None else base
        for k in placed:
            for axis, name in enumerate('xy'):
                layouts[:, k, axis] = value(f'{name}_{plan.table.labels[k]}')
        if 'jitter' in plan.inputs:
            self._jitter(layouts, region, value('jitter'))
        return layouts

    def _jitter(self, layouts: Floats, region: Region, deviations: Floats) -> None:
        """Add to each coordinate what is drawn for it."""
        flat = layouts.reshape(region.count, -1)
        for part in pieces(region.count):
            spread, here = deviations[part, np.newaxis], flat[part]
            for k in range(0, flat.shape[1], WORDS):
                name = f'jitter {k // WORDS}'
                noise = normals(words_of(self._plan.seed, name, *region.indices(part)))
                columns = here[:, k : k + WORDS]
                columns += spread * noise[:, : columns.shape[1]]

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


def _erase(outcomes: Outcomes, failed: NDArray[np.bool_]) -> None:
    outcomes.finals[failed] = np.nan
    outcomes.durations[failed] = np.nan
    outcomes.event_counts[failed] = -1
    outcomes.first_hit[failed] = -1
    if outcomes.pocketed is not None:
        outcomes.pocketed[failed] = -1
