"""A window of a sweep, swept anew."""

from __future__ import annotations

import dataclasses
import math
import reprlib
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.study.checks import counted
from pool_sim_ros.study.datasets import dataset_in_memory
from pool_sim_ros.study.description import LAYOUTS, plan_of
from pool_sim_ros.study.plan import SAMPLE, Plan
from pool_sim_ros.study.ranges import Normal, Range, uniform
from pool_sim_ros.study.tally import Tally

if TYPE_CHECKING:
    import xarray

POINTS = 300
"""Values along each side of a window: as many as a picture shows."""


def zoom(
    dataset: xarray.Dataset, *, points: int = POINTS, **window: tuple[float, float]
) -> xarray.Dataset:
    """Sweep a window of a sweep anew, in memory.

    Parameters
    ----------
    dataset : xarray.Dataset
        Of `sweep` or `open_sweep`. Where ``dataset.sel`` or ``isel`` has chosen one value of a
        dimension, it stays at this.
    points : int, optional
        Values along each side of the window.
    **window
        Name of an input -> lowest and highest value.

    Returns
    -------
    xarray.Dataset
        As `sweep` returns it. What is drawn is drawn anew.

    Raises
    ------
    ValueError
        For a dataset that no sweep made, and for a window of an input that does not vary.
    ModuleNotFoundError
        Where the extra `study` is not installed.
    """
    points = counted('points', points, 1)
    plan = _plan_of(dataset)
    inputs = dict(plan.inputs)
    for name, ends in window.items():
        if name not in inputs or isinstance(inputs[name], float):
            there = ', '.join(n for n, given in inputs.items() if not isinstance(given, float))
            raise ValueError(f'{name}: it does not vary in this sweep; there are {there}')
        inputs[name] = _narrowed(name, inputs[name], _ends(name, ends), points)
    plan = dataclasses.replace(plan, inputs=inputs)
    with Tally(plan.shots, 0, False) as tally:
        return dataset_in_memory(plan, tally)


def _plan_of(dataset: Any) -> Plan:
    """Return the plan of what is left of a dataset."""
    if not hasattr(dataset, 'attrs') or 'sweep' not in dataset.attrs:
        raise ValueError(
            'dataset: it must be a dataset of sweep() or open_sweep(), with its attributes'
        )

    def row(name: str) -> NDArray[np.float64]:
        values: NDArray[np.float64] = dataset[name].values
        return values[np.newaxis] if name == LAYOUTS and values.ndim == 2 else values

    plan = plan_of(dataset.attrs, row)
    return plan if SAMPLE in dataset.sizes else dataclasses.replace(plan, samples=None)


def _narrowed(name: str, given: Range, ends: tuple[float, float], points: int) -> Range:
    if isinstance(given, np.ndarray):
        return np.linspace(*ends, points)
    if isinstance(given, Normal) and isinstance(given.mean, np.ndarray):
        return Normal(np.linspace(*ends, points), given.deviation)
    return uniform(*ends)


def _ends(name: str, given: Any) -> tuple[float, float]:
    try:
        low, high = map(float, given)
    except (TypeError, ValueError):
        low = high = math.nan
    if not low < high or math.isinf(low) or math.isinf(high):
        raise ValueError(f'{name}: {reprlib.repr(given)} must be (lowest, highest)')
    return low, high
