"""A sweep on disk: a zarr group that xarray opens, with a record of the regions that are there.

A region counts as finished when the record says so, which is written after its data. So a sweep
that is killed at any moment has no half region that counts.
"""

from __future__ import annotations

import json
import shutil
import uuid
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.extras import needs
from pool_sim_ros.study.description import (
    LAYOUTS,
    attributes,
    coordinate_rows,
    description,
    difference,
    engine,
    plan_of,
)
from pool_sim_ros.study.inputs import LAYOUT, known_inputs
from pool_sim_ros.study.outcome_arrays import stored_array, stored_name
from pool_sim_ros.study.plan import Plan, Region

with needs('a sweep', 'study'):
    import zarr

    from pool_sim_ros.study.chunk_files import CODEC, write_chunk

FINISHED = 'record/finished'
IDENTITY = 'identity'


class Store:
    """A sweep on disk; `opened` and `created` return one.

    Attributes
    ----------
    path : Path
    plan : Plan
    identity : str
        Another one for each folder that was made.
    """

    def __init__(self, path: Path, group: Any, plan: Plan) -> None:
        self.path, self.plan = path, plan
        self.identity = str(group.attrs[IDENTITY])
        self._group = group
        self._arrays = {name: group[stored_name(plan, name)] for name in (*plan.keep, *plan.drawn)}
        self._finished = group[FINISHED]

    def finished(self) -> NDArray[np.bool_]:
        """Return which regions are there, (regions,)."""
        return np.asarray(self._finished[:]) != 0

    def write(self, region: Region, outcomes: Mapping[str, NDArray[np.generic]]) -> None:
        """Write a region, then that it is there; raise OSError where that fails."""
        plan = self.plan
        place = tuple(each.start // b for each, b in zip(region.slices, plan.block, strict=True))
        for name, values in outcomes.items():
            array = self._arrays[name]
            if region.shape == plan.block:
                folder = self.path / stored_name(plan, name)
                write_chunk(array, folder, place + (0,) * (values.ndim - 1), values)
            else:  # at an end of the array a chunk is filled up
                array[region.slices] = values.reshape(*region.shape, *values.shape[1:])
        write_chunk(self._finished, self.path / FINISHED, (region.number,), np.ones(1))


def opened(path: Path) -> Store:
    """Return the sweep in a folder; raise FileNotFoundError or ValueError where there is none."""
    if not path.exists():
        raise FileNotFoundError(f'{path}: there is no such folder')
    try:
        if not path.is_dir():
            raise ValueError('it is a file')
        # Else zarr looks at each number before it writes a chunk: may all of it be left out?
        with zarr.config.set({'array.write_empty_chunks': True}):
            group: Any = zarr.open_group(path, mode='r+', use_consolidated=False)
            attrs = dict(group.attrs)
            if IDENTITY not in attrs:
                raise ValueError('its attributes do not say so')
            return Store(path, group, plan_of(attrs, lambda name: np.asarray(group[name][...])))
    except (ValueError, KeyError, FileNotFoundError, zarr.errors.BaseZarrError) as error:
        why = ' '.join(str(error).split())
        raise ValueError(f'{path}: no sweep of this package made it: {why}') from None


def created(path: Path, plan: Plan) -> Store:
    """Make the folder of a sweep, or open that which is there, if it is the same sweep.

    Raises
    ------
    FileExistsError
        Where another sweep, or something else, is there.
    OSError
        Where the folder cannot be made.
    """
    if path.exists() and not (path.is_dir() and not any(path.iterdir())):
        return _the_same(path, plan)
    path.parent.mkdir(parents=True, exist_ok=True)
    half = path.with_name(f'.{path.name}.{uuid.uuid4().hex[:8]}.new')
    try:
        _make(half, plan)
        # All at once: a folder that is there is whole.
        half.replace(path)
    finally:
        shutil.rmtree(half, ignore_errors=True)
    return opened(path)


def _the_same(path: Path, plan: Plan) -> Store:
    advice = 'take another name, or remove it'
    try:
        there = opened(path)
        attrs = dict(zarr.open_group(path, mode='r', use_consolidated=False).attrs)
    except ValueError as error:
        raise FileExistsError(f'out: {error}; {advice}') from None
    differs = difference(json.loads(str(attrs['sweep'])), description(plan))
    if differs is None and attrs['engine'] != engine():
        differs = f'version {attrs["pool_sim_ros"]} of the engine played it, which is not this one'
    if differs is not None:
        raise FileExistsError(f'out: {path} has another sweep: {differs}; {advice}')
    return there


def _make(path: Path, plan: Plan) -> None:
    root: Any = zarr.create_group(path, zarr_format=3)
    known = known_inputs(plan.table)

    def add(name: str, values: NDArray[Any], dimensions: tuple[str, ...], **said: str) -> None:
        array = root.create_array(
            name,
            shape=values.shape,
            chunks=values.shape,
            dtype=str if values.dtype == object else values.dtype,
            dimension_names=dimensions,
            attributes=said,
        )
        array[...] = values

    for name, row in coordinate_rows(plan).items():
        said = (
            {'units': known[name].units, 'long_name': known[name].meaning} if name in known else {}
        )
        add(name, row, (name,), **said)
    if plan.layouts is not None:
        add(LAYOUTS, plan.layouts, (LAYOUT, 'layout_ball', 'axis'), units='m')
    add('ball', np.array([plan.table.labels[k] for k in plan.balls], dtype=object), ('ball',))
    add('axis', np.array(['x', 'y'], dtype=object), ('axis',))
    for name in (*plan.keep, *plan.drawn):
        stored, said = stored_array(plan, name)
        lengths = tuple({'ball': len(plan.balls), 'axis': 2}[each] for each in stored.dimensions)
        root.create_array(
            stored_name(plan, name),
            shape=(*plan.shape, *lengths),
            chunks=(*plan.block, *lengths),
            dtype=stored.dtype,
            fill_value=stored.fill,
            compressors=CODEC,
            dimension_names=(*plan.sizes, *stored.dimensions),
            attributes=said,
        )
    record = root.create_group('record')
    shape = (plan.regions,)
    record.create_array(
        'finished', shape=shape, chunks=(1,), dtype='u1', fill_value=0, compressors=None
    )
    root.attrs.update({**attributes(plan), IDENTITY: uuid.uuid4().hex})
    with warnings.catch_warnings():
        # What xarray looks for first; zarr says that others may not know it.
        warnings.simplefilter('ignore')
        zarr.consolidate_metadata(root.store)
