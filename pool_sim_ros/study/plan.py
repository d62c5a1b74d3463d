"""What a sweep plays: its inputs, its dimensions, and the regions in which it is played."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import Table
from pool_sim_ros.study.checks import checked_layouts, counted
from pool_sim_ros.study.inputs import LAYOUT, Inputs, coefficients_of, rows_of
from pool_sim_ros.study.ranges import Normal, Range, Uniform, is_random
from pool_sim_ros.study.shot_random import first_normals, single_words, uniforms, words_of
from pool_sim_ros.study.workspace import pieces

Floats = NDArray[np.float64]

SAMPLE = 'sample'
"""The dimension of random numbers that are drawn again and again."""

CHUNK = 100_000
"""Shots of a region, if nobody says more: a tenth of a second, beside which a task is nothing."""

MOST_BYTES = 64 * 2**20
"""Of the outcomes of such a region. A table with many balls has smaller ones."""

KEPT = ('finals', 'durations', 'event_counts', 'pocketed', 'first_hit', 'failed')
"""The arrays of `Outcomes` that a sweep may keep."""


@dataclass(frozen=True)
class Region:
    """Shots that are played together.

    Attributes
    ----------
    number : int
    first, count : int
        The index of its first shot, and how many there are; the last dimension runs fastest.
    slices : tuple of slice
        Where they stand in the dataset.
    """

    number: int
    first: int
    count: int
    slices: tuple[slice, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        """How many shots it has along each dimension."""
        return tuple(each.stop - each.start for each in self.slices)

    def indices(self, part: slice) -> tuple[int, int]:
        """Return the index of the first shot of a part of it, and how many the part has."""
        return self.first + part.start, part.stop - part.start


@dataclass(frozen=True, eq=False)
class Plan:
    """All that decides what comes of a sweep; `checked_plan` makes one.

    Attributes
    ----------
    table : Table
    inputs : dict
        Name -> a number, a row, or random numbers; those of the table come first.
    layouts : ndarray of shape (k, n, 2), or None
        m; a dimension where k is above 1.
    samples : int or None
        Length of the last dimension, along which nothing changes but what is drawn.
    seed : int
    keep : tuple of str
    balls : tuple of int
        Those whose ends are kept.
    chunk : int
        Shots of a region, at most.
    """

    table: Table
    inputs: Inputs
    layouts: Floats | None
    samples: int | None
    seed: int
    keep: tuple[str, ...]
    balls: tuple[int, ...]
    chunk: int

    @cached_property
    def sizes(self) -> dict[str, int]:
        """The dimensions of the shots, and how long each is."""
        rows = rows_of(self.inputs)
        of_table = coefficients_of(self.table)
        sizes = {name: size for name, size in rows.items() if name in of_table}
        if self.layouts is not None and len(self.layouts) > 1:
            sizes[LAYOUT] = len(self.layouts)
        sizes |= rows
        return sizes if self.samples is None else {**sizes, SAMPLE: self.samples}

    @property
    def shape(self) -> tuple[int, ...]:
        """How long each dimension is."""
        return tuple(self.sizes.values())

    @property
    def shots(self) -> int:
        """How many shots there are."""
        return math.prod(self.shape)

    @cached_property
    def block(self) -> tuple[int, ...]:
        """The shape of a region: as many shots as `chunk` allows, one after another."""
        block, room = list(self.shape), self.chunk
        for k in reversed(range(len(block))):
            if block[k] > room:
                block[k] = math.ceil(block[k] / math.ceil(block[k] / room))
                block[:k] = [1] * k
                break
            room //= block[k]
        return tuple(block)

    @cached_property
    def grid(self) -> tuple[int, ...]:
        """How many regions there are along each dimension."""
        return tuple(math.ceil(n / b) for n, b in zip(self.shape, self.block, strict=True))

    @property
    def regions(self) -> int:
        """How many regions there are."""
        return math.prod(self.grid)

    def region(self, number: int) -> Region:
        """Return a region by its number."""
        places = np.unravel_index(number, self.grid)
        starts = [int(p) * b for p, b in zip(places, self.block, strict=True)]
        stops = [min(s + b, n) for s, b, n in zip(starts, self.block, self.shape, strict=True)]
        slices = tuple(slice(*ends) for ends in zip(starts, stops, strict=True))
        first = int(np.ravel_multi_index(starts, self.shape))
        return Region(number, first, math.prod(e.stop - e.start for e in slices), slices)

    @property
    def drawn(self) -> tuple[str, ...]:
        """The inputs that are drawn for each shot."""
        return tuple(name for name, given in self.inputs.items() if is_random(given))

    def values(self, name: str, region: Region, out: Floats | None = None) -> Floats:
        """Return an input of the shots of a region, (count,), in `out` where it is given."""
        out = np.empty(region.count) if out is None else out
        given = self.inputs[name]
        if isinstance(given, Uniform):
            for part in pieces(region.count):
                words = single_words(self.seed, name, *region.indices(part))
                np.multiply(given.high - given.low, uniforms(words), out=out[part])
            out += given.low
            return out
        shaped = out.reshape(region.shape)
        middle = given.mean if isinstance(given, Normal) else given
        if isinstance(middle, np.ndarray):
            middle = self.spread(name, middle, region)
        if isinstance(given, Normal):
            for part in pieces(region.count):
                words = words_of(self.seed, name, *region.indices(part))
                numbers = first_normals(words)
                np.multiply(given.deviation, numbers, out=out[part])
            shaped += middle
        else:
            shaped[...] = middle
        return out

    def spread(self, dimension: str, row: Floats, region: Region) -> Floats:
        """Return what stands along a dimension as numpy broadcasts it to the shape of a region.

        Parameters
        ----------
        dimension : str
        row : ndarray of shape (k, ...)
            As long as the dimension.
        region : Region

        Returns
        -------
        ndarray of shape (1, ..., j, ..., 1, ...)
            The j of them that the region has.
        """
        k = list(self.sizes).index(dimension)
        shape = [1] * len(self.shape)
        shape[k] = -1
        return row[region.slices[k]].reshape(*shape, *row.shape[1:])


def checked_plan(
    table: Table,
    inputs: Inputs,
    positions: Any,
    samples: int | None,
    seed: int,
    keep: Sequence[str] | None,
    balls: Sequence[str] | None,
    chunk: int | None,
) -> Plan:
    """Return the plan of a sweep; raise ValueError, naming what is wrong."""
    if samples is not None:
        samples = counted('samples', samples, 1)
    if (
        samples is None
        and any(is_random(given) for given in inputs.values())
        and not rows_of(inputs)
    ):
        raise ValueError('samples: it is missing; how many shots are to be drawn?')
    for name in coefficients_of(table):
        if name in inputs:
            _check_coefficient(table, name, inputs[name])
    chosen = table.labels if balls is None else tuple(balls)
    layouts = None if positions is None else checked_layouts('positions', table, positions)
    kept = _kept(table, keep)
    row = sum(16 * len(chosen) * (name == 'finals') + 8 for name in kept)
    most = max(MOST_BYTES // row, 1)
    plan = Plan(
        table,
        inputs,
        layouts,
        samples,
        counted('seed', seed, 0),
        kept,
        tuple(table.index(label) for label in chosen),
        min(CHUNK, most) if chunk is None else counted('chunk', chunk, 1),
    )
    if not plan.shape:
        raise ValueError('velocity: nothing varies; give a row of values, as np.linspace makes')
    return plan


def _check_coefficient(table: Table, name: str, given: Range) -> None:
    """Raise ValueError where a value cannot be; one that is drawn fails alone."""
    if isinstance(given, (Uniform, Normal)):
        return
    for value in (np.min(given), np.max(given)):
        changes: dict[str, Any] = {name: float(value)}
        dataclasses.replace(table, **changes)


def _kept(table: Table, keep: Sequence[str] | None) -> tuple[str, ...]:
    if keep is None:
        return tuple(name for name in KEPT if name != 'pocketed' or len(table.pockets))
    names = (keep,) if isinstance(keep, str) else tuple(keep)
    for name in names:
        if name not in KEPT:
            raise ValueError(f'keep: {name!r} is no outcome; there are {", ".join(KEPT)}')
    if not names:
        raise ValueError(f'keep: name at least one of {", ".join(KEPT)}')
    return tuple(name for name in KEPT if name in names)
