"""A plan as text, and back: what a dataset says of the sweep that made it."""

from __future__ import annotations

import hashlib
import json
import platform
from collections.abc import Callable
from importlib.metadata import PackageNotFoundError, version
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros import __version__
from pool_sim_ros.physics import Table, source_hash, table_from_fields, table_to_fields
from pool_sim_ros.study.inputs import LAYOUT
from pool_sim_ros.study.plan import Plan
from pool_sim_ros.study.ranges import Normal, Range, Uniform, row_of

Floats = NDArray[np.float64]

LAYOUTS = 'layouts'
"""The array that has the layouts of a sweep."""


def description(plan: Plan) -> dict[str, Any]:
    """Return what two sweeps have in common if they are one: all but the values of rows."""
    return {
        'inputs': {name: _range_to_json(given) for name, given in plan.inputs.items()},
        'layouts': None if plan.layouts is None else _hash(plan.layouts),
        'samples': plan.samples,
        'keep': list(plan.keep),
        'balls': list(plan.balls),
        'table': _hash(json.dumps(table_to_fields(plan.table)).encode()),
        'seed': plan.seed,
    }


def attributes(plan: Plan) -> dict[str, Any]:
    """Return the attributes of the dataset of a plan."""
    versions = {
        'pool_sim_ros': __version__,
        'engine': engine(),
        'python': platform.python_version(),
    }
    for package in ('numpy', 'numba', 'zarr', 'xarray'):
        try:
            versions[package] = version(package)
        except PackageNotFoundError:
            continue
    return {
        **versions,
        'seed': plan.seed,
        'shots': plan.shots,
        'chunk': plan.chunk,
        'table': json.dumps(table_to_fields(plan.table)),
        'sweep': json.dumps(description(plan)),
    }


def engine() -> str:
    """Return what names the engine that plays: a hash of its source."""
    try:
        return source_hash()
    except OSError:
        return 'unknown'


def plan_of(attrs: dict[str, Any], row: Callable[[str], Floats]) -> Plan:
    """Return the plan that made a dataset.

    Parameters
    ----------
    attrs : dict
        Its attributes.
    row : callable
        Takes the name of a dimension, or `LAYOUTS`, and returns its values.

    Raises
    ------
    ValueError
        Where no sweep made it.
    """
    try:
        said = json.loads(attrs['sweep'])
        table: Table = table_from_fields(json.loads(attrs['table']))
        return Plan(
            table,
            {name: _range_of_json(name, given, row) for name, given in said['inputs'].items()},
            None if said['layouts'] is None else np.asarray(row(LAYOUTS), dtype=float),
            said['samples'],
            said['seed'],
            tuple(said['keep']),
            tuple(said['balls']),
            int(attrs['chunk']),
        )
    except (KeyError, TypeError, json.JSONDecodeError) as error:
        raise ValueError(f'dataset: no sweep made it ({error!r})') from None


def difference(old: dict[str, Any], new: dict[str, Any]) -> str | None:
    """Return in words how two descriptions differ, or None."""
    for name in new:
        if name == 'inputs':
            continue
        if old.get(name) != new[name]:
            return f'its {name} {"is" if name in ("table", "seed") else "are"} another'
    before, now = old['inputs'], new['inputs']
    for name in {**now, **before}:
        if name not in before or name not in now:
            return f'{name} is {"not " if name not in before else ""}in it'
        if before[name] != now[name]:
            return f'{name} is {_words(before[name])} there and {_words(now[name])} here'
    return None if list(before) == list(now) else 'its inputs are in another order'


def coordinate_rows(plan: Plan) -> dict[str, Floats]:
    """Return the values of each dimension that is an input, and of the layouts."""
    rows = {name: row_of(given) for name, given in plan.inputs.items()}
    found = {name: row for name, row in rows.items() if row is not None}
    if plan.layouts is not None and len(plan.layouts) > 1:
        found[LAYOUT] = np.arange(len(plan.layouts), dtype=float)
    return found


def _range_to_json(given: Range) -> Any:
    if isinstance(given, Uniform):
        return {'low': given.low, 'high': given.high}
    if isinstance(given, Normal):
        return {'mean': _range_to_json(given.mean), 'deviation': given.deviation}
    if isinstance(given, float):
        return given
    ends = {'first': float(given[0]), 'last': float(given[-1]), 'count': len(given)}
    return {**ends, 'hash': _hash(given)}


def _range_of_json(name: str, said: Any, row: Callable[[str], Floats]) -> Range:
    if not isinstance(said, dict):
        return float(said)
    if 'low' in said:
        return Uniform(said['low'], said['high'])
    if 'mean' in said:
        mean = _range_of_json(name, said['mean'], row)
        assert not isinstance(mean, (Uniform, Normal))
        return Normal(mean, said['deviation'])
    values = np.asarray(row(name), dtype=float)
    return values if values.ndim else float(values)


def _words(said: Any) -> str:
    if not isinstance(said, dict):
        return f'{said:g}'
    if 'low' in said:
        return f'uniform({said["low"]:g}, {said["high"]:g})'
    if 'mean' in said:
        return f'normal({_words(said["mean"])}, {said["deviation"]:g})'
    return f'{said["count"]} values from {said["first"]:g} to {said["last"]:g}'


def _hash(content: Floats | bytes) -> str:
    data = content if isinstance(content, bytes) else np.ascontiguousarray(content).tobytes()
    return hashlib.blake2b(data, digest_size=8).hexdigest()
