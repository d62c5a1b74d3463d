"""The arrays that a sweep keeps: dimensions, types, units and meanings."""

from __future__ import annotations

from typing import NamedTuple

from pool_sim_ros.study.inputs import known_inputs
from pool_sim_ros.study.plan import Plan


class Stored(NamedTuple):
    """One array of `Outcomes`, as a sweep keeps it.

    `dimensions` come after those of the shots. `fill` stands where nothing was played yet.
    """

    dimensions: tuple[str, ...]
    dtype: str
    fill: float
    units: str
    meaning: str


STORED = {
    'finals': Stored(('ball', 'axis'), 'f8', float('nan'), 'm', 'where the balls are at the end'),
    'durations': Stored((), 'f8', float('nan'), 's', 'time until the last ball rests'),
    'event_counts': Stored((), 'i4', -1, '1', 'number of events'),
    'pocketed': Stored(
        ('ball',), 'i2', -1, '1', 'number of the pocket in which a ball is, -1 for none'
    ),
    'first_hit': Stored(
        (), 'i4', -1, '1', 'index of the ball that the cue ball touches first, -1 for none'
    ),
    'failed': Stored(
        (),
        'i1',
        -1,
        '1',
        '0 played, 1 bad layout, 2 too many events, 3 runs away, 4 miscue or coefficient that '
        'cannot be, -1 not played yet',
    ),
}
"""What a sweep may keep, by name."""

DRAWN = Stored((), 'f8', float('nan'), '', 'as drawn for each shot')
"""An input that is drawn; units and meaning are the input's."""


def stored_name(plan: Plan, name: str) -> str:
    """Return the name of an array in the dataset: that of a dimension is taken."""
    return f'{name}_drawn' if name in plan.drawn and name in plan.sizes else name


def stored_array(plan: Plan, name: str) -> tuple[Stored, dict[str, str]]:
    """Return how an outcome or a drawn input is kept, and its attributes."""
    if name in STORED:
        stored = STORED[name]
        return stored, {'units': stored.units, 'long_name': stored.meaning}
    units, meaning = known_inputs(plan.table)[name]
    return DRAWN, {'units': units, 'long_name': f'{meaning}, {DRAWN.meaning}'}
