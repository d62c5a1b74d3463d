"""A sweep as a dataset of xarray: in memory, or opened from disk."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.extras import needs
from pool_sim_ros.study.description import LAYOUTS, attributes, coordinate_rows
from pool_sim_ros.study.inputs import LAYOUT, known_inputs
from pool_sim_ros.study.outcome_arrays import stored_array, stored_name
from pool_sim_ros.study.plan import Plan
from pool_sim_ros.study.playing import Player
from pool_sim_ros.study.tally import Tally

if TYPE_CHECKING:
    import xarray


def open_sweep(path: str | os.PathLike[str]) -> xarray.Dataset:
    """Open what a sweep has written, also while it still runs.

    Parameters
    ----------
    path : path_like
        `out` of the sweep.

    Returns
    -------
    xarray.Dataset
        As `sweep` returns it; chunk by chunk from disk. What is not played yet is NaN and -1.

    Raises
    ------
    FileNotFoundError
        Where there is none.
    ValueError
        Where no sweep made it.
    ModuleNotFoundError
        Where the extra `study` is not installed.
    """
    with needs('a sweep', 'study'):
        import xarray

        from pool_sim_ros.study.store import opened
    folder = Path(path).expanduser()
    opened(folder)
    return xarray.open_zarr(folder)


def dataset_in_memory(plan: Plan, tally: Tally) -> xarray.Dataset:
    """Play all of a plan in this process, on every core, and return what comes of it."""
    with needs('a sweep', 'study'):
        import xarray
    player = Player(plan, None)
    arrays: dict[str, NDArray[Any]] = {}
    for number in range(plan.regions):
        region = plan.region(number)
        outcomes = player.play(region)
        for name, values in outcomes.items():
            if name not in arrays:
                arrays[name] = np.empty((plan.shots, *values.shape[1:]), values.dtype)
            arrays[name][region.first : region.first + region.count] = values
        tally.add(region.count)
    variables = {}
    for name, flat in arrays.items():
        stored, said = stored_array(plan, name)
        dimensions = (*plan.sizes, *stored.dimensions)
        shaped = flat.reshape(*plan.shape, *flat.shape[1:])
        variables[stored_name(plan, name)] = dimensions, shaped, said
    known = known_inputs(plan.table)
    places: dict[str, Any] = {}
    for name, row in coordinate_rows(plan).items():
        units = (
            {'units': known[name].units, 'long_name': known[name].meaning} if name in known else {}
        )
        places[name] = (name,), row, units
    places |= {'ball': [plan.table.labels[k] for k in plan.balls], 'axis': ['x', 'y']}
    if plan.layouts is not None:
        variables[LAYOUTS] = (LAYOUT, 'layout_ball', 'axis'), plan.layouts, {'units': 'm'}
    return xarray.Dataset(variables, places, attributes(plan))
