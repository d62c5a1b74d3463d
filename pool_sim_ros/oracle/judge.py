"""Whether shots met a goal on a table, and what came instead."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.oracle.goal import Goal
from pool_sim_ros.physics import EventKind, Outcomes, Table, simulate_many

CUE = 0
"""Index of the cue ball."""


class Judge:
    """A goal on a table.

    Parameters
    ----------
    table : Table
    goal : Goal
    positions : ndarray of shape (n, 2)
        Where the balls lie, m.

    Raises
    ------
    ValueError
        Where the table has no such ball, pocket or place, and where a ball that is to do something
        lies in a pocket already.
    """

    def __init__(self, table: Table, goal: Goal, positions: NDArray[np.float64]) -> None:
        self.table, self.parts = table, goal.parts
        self.caught = pocketed_at(table, positions)
        if self.caught[CUE] >= 0:
            raise ValueError(
                f'positions: the cue ball lies in pocket {self.caught[CUE]}; place it on the cloth'
            )
        for part in self.parts:
            self._check(part)
        self.needs_events = any(part.touches or part.avoid for part in self.parts)

    def met(self, outcomes: Outcomes) -> NDArray[np.bool_]:
        """Return which shots were played and met the goal, (m,)."""
        met = np.asarray(outcomes.failed == 0)
        for part in self.parts:
            met &= self._part_met(part, outcomes)
        return met

    def misses(self, outcomes: Outcomes, met: NDArray[np.bool_]) -> NDArray[np.float64]:
        """Return by how much each shot missed, (m,), in the size of the goal: 1 where it met it.

        A place that is so many times as large would have been met. What has no size is missed by
        infinitely much.
        """
        missed = np.ones(len(met))
        for part in self.parts:
            if part.to is None and part.cue_to is None and part.rectangle is None:
                missed[~self._part_met(part, outcomes)] = np.inf
            else:
                missed = np.maximum(missed, self._away(part, outcomes))
        missed[outcomes.failed != 0] = np.inf
        missed[met] = 1.0
        return missed

    def instead(self, outcomes: Outcomes, start: NDArray[np.float64]) -> NDArray[np.object_]:
        """Say for each shot which part of the goal it missed first, and how; '' where it met all.

        Parameters
        ----------
        outcomes : Outcomes
        start : ndarray of shape (n, 2) or (m, n, 2)
            Where the balls lay before, m.

        Returns
        -------
        ndarray of object, (m,)
            Words.
        """
        words = np.full(len(outcomes.failed), '', object)
        moved = np.any(outcomes.finals != start, axis=-1)
        for part in reversed(self.parts):
            missed = ~self._part_met(part, outcomes)
            words[missed] = self._why(part, outcomes, moved)[missed]
        words[outcomes.failed != 0] = 'the shot cannot be played to its end'
        return words

    def _check(self, part: Goal) -> None:
        table = self.table
        for name in ('ball', 'first_hit', 'touches', 'avoid', 'keep'):
            label = getattr(part, name)
            if label is None:
                continue
            if label not in table.labels:
                raise ValueError(
                    f'goal: {name}: {label!r} is not on the table; it has {", ".join(table.labels)}'
                )
            index = table.labels.index(label)
            if index == CUE and name in ('first_hit', 'touches', 'avoid'):
                raise ValueError(f'goal: {name}: {label!r} is the cue ball, which touches others')
            if self.caught[index] >= 0 and name != 'avoid':
                raise ValueError(
                    f'goal: {name}: {label!r} lies in pocket {self.caught[index]} already'
                )
        if part.pocket is not None:
            count = len(table.pockets)
            if count == 0:
                raise ValueError(f'goal: pocket: {part.pocket!r}; this table has no pockets')
            if part.pocket != 'any' and int(part.pocket) >= count:
                raise ValueError(f'goal: pocket: {part.pocket} must be 0 to {count - 1}')
        self._check_place(part)

    def _check_place(self, part: Goal) -> None:
        centre, reach = part.to or part.cue_to, part.within or 0.0
        size = (self.table.length, self.table.width)
        if part.rectangle is not None:
            x0, y0, x1, y1 = part.rectangle
            nearest = np.maximum((x0, y0), 0.0) - np.minimum((x1, y1), size)
            off = bool((nearest > 0.0).any())
        elif centre is not None:
            off = bool(np.hypot(*(np.clip(centre, 0.0, size) - centre)) > reach)
        else:
            return
        if off:
            name = 'rectangle' if part.rectangle else 'to' if part.to else 'cue_to'
            raise ValueError(
                f'goal: {name}: {getattr(part, name)} is off the cloth, which is '
                f'{size[0]:g} x {size[1]:g} m from (0, 0)'
            )

    def _ball_of(self, part: Goal) -> int:
        label = part.ball or part.first_hit or part.touches or part.avoid or part.keep
        return CUE if label is None else self.table.labels.index(label)

    def _part_met(self, part: Goal, outcomes: Outcomes) -> NDArray[np.bool_]:
        ball = self._ball_of(part)
        met: Any
        caught, end = outcomes.pocketed[:, ball], outcomes.finals[:, ball]
        if part.pocket is not None:
            met = caught >= 0 if part.pocket == 'any' else caught == part.pocket
        elif part.rectangle is not None:
            x0, y0, x1, y1 = part.rectangle
            inside = (end >= (x0, y0)) & (end <= (x1, y1))
            met = inside.all(axis=-1) & (caught < 0)
        elif part.within is not None:
            away = np.hypot(*(end - np.array(part.to or part.cue_to)).T)
            met = (away <= part.within) & (caught < 0)
        elif part.first_hit is not None:
            met = outcomes.first_hit == ball
        elif part.keep is not None:
            met = caught < 0
        else:
            met = touched(outcomes, ball) == (part.touches is not None)
        return np.asarray(met)

    def _away(self, part: Goal, outcomes: Outcomes) -> NDArray[np.float64]:
        """Return how far from the middle of a place its ball ends, in the size of the place."""
        ball = self._ball_of(part)
        end = outcomes.finals[:, ball]
        if part.rectangle is not None:
            x0, y0, x1, y1 = part.rectangle
            size = 0.5 * np.array([x1 - x0, y1 - y0])
            away = (abs(end - (0.5 * (x0 + x1), 0.5 * (y0 + y1))) / size).max(axis=1)
        else:
            away = np.hypot(*(end - np.array(part.to or part.cue_to)).T) / part.within
        away[outcomes.pocketed[:, ball] >= 0] = np.inf
        return np.asarray(away)

    def _why(self, part: Goal, outcomes: Outcomes, moved: NDArray[np.bool_]) -> NDArray[np.object_]:
        """Return words for all shots, which say why they missed a part of the goal."""
        ball, count = self._ball_of(part), len(outcomes.failed)
        name = self.name(ball)
        caught = outcomes.pocketed[:, ball]
        where = np.array(
            [f'{name} falls into pocket {k}' for k in range(len(self.table.pockets))] + [''], object
        )
        if part.first_hit is not None:
            others = [f'the cue ball touches {self.name(k)} first' for k in range(len(moved[0]))]
            return np.array([*others, 'the cue ball touches nothing'], object)[outcomes.first_hit]
        if part.touches is not None:
            return np.full(count, f'the cue ball does not touch {name}', object)
        if part.avoid is not None:
            return np.full(count, f'the cue ball touches {name}', object)
        if part.pocket is not None:
            other = f'{name} stays on the cloth'
        else:
            other = f'{name} ends elsewhere'
        words = np.full(count, other, object)
        words[~moved[:, ball]] = f'{name} does not move'
        words[caught >= 0] = where[caught[caught >= 0]]
        return words

    def name(self, ball: int) -> str:
        """Return what a ball is called in words."""
        return 'the cue ball' if ball == CUE else f'ball {self.table.labels[ball]}'


def touched(outcomes: Outcomes, ball: int) -> NDArray[np.bool_]:
    """Return in which shots the cue ball touched a ball at some time, (m,); needs their events."""
    events, offsets = outcomes.events, outcomes.offsets
    assert events is not None and offsets is not None, 'played without events'
    a, b = events['a'], events['b']
    pair = ((a == CUE) & (b == ball)) | ((a == ball) & (b == CUE))
    hits = np.flatnonzero(pair & (events['kind'] == EventKind.BALL_BALL))
    result = np.zeros(len(offsets) - 1, bool)
    result[np.searchsorted(offsets, hits, side='right') - 1] = True
    return result


def pocketed_at(table: Table, positions: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return the pocket in which each ball lies, (n,), -1 for none.

    Raises ValueError where the balls cannot lie like that.
    """
    nothing = np.zeros((1, len(table.balls), 2))
    pocketed: NDArray[np.int64] = simulate_many(
        table, nothing, positions=positions, until=0.0, threads=1
    ).pocketed[0]
    return pocketed
