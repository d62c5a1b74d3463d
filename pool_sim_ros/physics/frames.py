"""Results as labelled tables: events as a pandas frame, outcomes as an xarray dataset."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros import __version__
from pool_sim_ros.extras import needs
from pool_sim_ros.physics.log import EventKind
from pool_sim_ros.physics.outcomes import Outcomes
from pool_sim_ros.physics.table_file import table_to_fields

if TYPE_CHECKING:
    import pandas
    import xarray

    from pool_sim_ros.physics.table import Table

DESCRIBED = {
    'finals': (('shot', 'ball', 'axis'), 'm', 'where the balls are at the end'),
    'durations': (('shot',), 's', 'time until the last ball rests'),
    'event_counts': (('shot',), '1', 'number of events'),
    'pocketed': (('shot', 'ball'), '1', 'number of the pocket in which a ball is, -1 for none'),
    'first_hit': (('shot',), '1', 'index of the ball that the cue ball touches first, -1 for none'),
    'failed': (('shot',), '1', '0 played, 1 bad layout, 2 too many events, 3 runs away'),
}
"""Dimensions, unit and meaning of each array of `Outcomes`."""


def events_frame(events: NDArray[np.void], labels: Sequence[str] | None) -> pandas.DataFrame:
    """Return events as a frame: the fields, `kind` in words, and the balls by their labels."""
    with needs('a frame of events', 'frames'):
        import pandas
    kinds = pandas.Categorical.from_codes(events['kind'], [kind.name.lower() for kind in EventKind])
    columns = {name: np.ascontiguousarray(events[name]) for name in events.dtype.names or ()}
    columns['kind'] = kinds
    if labels is not None:
        names = np.array(labels, dtype=object)
        second = np.full(len(events), None, dtype=object)
        both = events['kind'] == EventKind.BALL_BALL
        second[both] = names[events['b'][both]]
        columns |= {'ball': names[events['a']], 'other': second}
    return pandas.DataFrame(columns)


def outcomes_events_frame(outcomes: Outcomes, table: Table | None) -> pandas.DataFrame:
    """Return the events of all shots as a frame; see `Outcomes.events_frame`."""
    if outcomes.events is None or outcomes.offsets is None:
        raise ValueError('events: none were kept; simulate_many(..., events=True) keeps them')
    frame = events_frame(outcomes.events, _labels(outcomes, table))
    counts = np.diff(outcomes.offsets)
    frame.insert(0, 'shot', np.repeat(np.arange(len(counts)), counts))
    return frame


def outcomes_dataset(outcomes: Outcomes, table: Table | None) -> xarray.Dataset:
    """Return outcomes as a dataset; see `Outcomes.to_xarray`."""
    labels = _labels(outcomes, table)
    with needs('to_xarray()', 'frames'):
        import xarray
    variables = {
        # One number may stand for all of `pocketed`, and cannot be written to.
        name: (dims, np.array(getattr(outcomes, name)), {'units': units, 'long_name': meaning})
        for name, (dims, units, meaning) in DESCRIBED.items()
    }
    attributes = {'pool_sim_ros': __version__}
    if table is not None:
        attributes['table'] = json.dumps(table_to_fields(table))
    balls = range(outcomes.finals.shape[1]) if labels is None else labels
    places = {'ball': list(balls), 'axis': ['x', 'y']}
    return xarray.Dataset(variables, places, attributes)


def _labels(outcomes: Outcomes, table: Table | None) -> tuple[str, ...] | None:
    balls = outcomes.finals.shape[1]
    if table is not None and balls != len(table.balls):
        raise ValueError(f'table: it has {len(table.balls)} balls, but the outcomes are of {balls}')
    return None if table is None else table.labels
