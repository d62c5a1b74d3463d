"""The chance of every aim at once, from shots that their neighbours share.

Executed strokes are spread evenly over speed and azimuth, then more of them where the first ones
succeeded, or nearly so. How often they succeed, smoothed by the noise, is the chance of each aim.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import reduce

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.oracle.sequences import r2
from pool_sim_ros.oracle.space import FINEST, Space
from pool_sim_ros.oracle.trials import Trials

PASS = 32_768
"""Shots between two looks at the clock, at most."""

CELLS = 2.0
"""Cells of the map in a standard deviation."""

REACH = 3.0
"""Standard deviations beyond which the smoothing is cut off, and that the sweep goes beyond the
greatest speed."""

SHARED = 5.0
"""Shots spread evenly that an aim's chance must come from, at least; otherwise the map is smoothed
more."""

BLOCK = 4
"""Cells in a row and in a column of a block, in which strokes are spread evenly: two standard
deviations."""

MISSES = (1.0, 2.0, 4.0, 8.0)
"""How far shots may miss, in the goal's own size, to tell where to look: the first for which
`ENOUGH` do."""

ENOUGH = 2000

APART = 2
"""Cells around a peak in which there is no other: a standard deviation."""


class Sweep:
    """A sweep over speed and azimuth, for some offsets of the tip.

    Parameters
    ----------
    trials : Trials
    space : Space
    shots : int
        That will be played if nobody stops it.
    seed : int
    """

    def __init__(self, trials: Trials, space: Space, shots: int, seed: int) -> None:
        self.trials, self.space, self.seed = trials, space, seed
        self.tips = space.tips
        low, high = space.speeds
        noise = np.maximum(trials.spread, FINEST)[:2]
        self.maps = []
        for count in self._shared(shots):
            share = count * 4.0 * np.pi * noise.prod() / ((high - low) * 360.0)
            sd = noise * max(np.sqrt(SHARED / share), 1.0)
            self.maps.append(Map((low, high), np.minimum(sd, ((high - low) / 4.0, 15.0))))
        self.passes = self.met = 0

    def go_on(self, until: int, late: Callable[[], bool]) -> None:
        """Play pass after pass until so many shots are played, or it is late."""
        while (left := until - sum(chart.count for chart in self.maps)) >= len(self.tips):
            for stratum, count in enumerate(self._shared(min(PASS, left))):
                self._play(stratum, count)
            self.passes += 1
            if late():
                return

    def focus(self, shots: int, power: float, late: Callable[[], bool]) -> None:
        """Play so many shots where the former ones succeeded, or missed by little.

        The more surely they did, the more, to this power.
        """
        for chart in self.maps:
            chart.look_where(self._farthest_miss(), power)
        weights = np.array([chart.total for chart in self.maps])
        while shots > 0 and weights.any():
            count = min(PASS, shots)
            for stratum, part in enumerate(weights / weights.sum()):
                if int(part * count) > 0:
                    self._play(stratum, int(part * count), focused=True)
            self.passes += 1
            shots -= count
            if late():
                return

    def _farthest_miss(self) -> float:
        misses = np.concatenate([miss for chart in self.maps for _, miss in chart.near])
        counts = np.array([(misses <= most).sum() for most in MISSES])
        return MISSES[int(np.argmax(counts >= ENOUGH)) if counts[-1] >= ENOUGH else -1]

    def _shared(self, shots: int) -> list[int]:
        """Share shots out to the tips: the middle gets half of them where there are others."""
        others = len(self.tips) - 1
        each = shots // 2 // others if others else 0
        return [shots - others * each] + [each] * others

    def _play(self, stratum: int, count: int, focused: bool = False) -> None:
        chart, trials = self.maps[stratum], self.trials
        start = np.random.default_rng([self.seed, 1, stratum]).random(2)
        rng = np.random.default_rng([self.seed, 2, stratum, self.passes])
        aims = np.zeros((count, 5))
        aims[:, 3:] = self.tips[stratum]
        normals = rng.standard_normal((count, 5)) if trials.spread[2:].any() else np.zeros(5)
        strokes = trials.executed(aims, normals)
        if focused:
            strokes[:, :2] = chart.focused(count, rng)
        else:
            places = r2(chart.count, count, start)
            strokes[:, 0] = chart.low + places[:, 0] * (chart.high - chart.low)
            strokes[:, 1] = 360.0 * places[:, 1]
            chart.spread_evenly(count)
        played = trials.play(strokes, trials.layouts.draw(count, rng))
        chart.add(strokes[:, :2], played.met, trials.judge.misses(played.outcomes, played.met))
        self.met += int(played.met.sum())

    def peaks(self, most: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the best aims, (k, 5), best first, and how widely each was smoothed, (k, 2)."""
        aims, chances, spreads = [], [], []
        for chart, tip in zip(self.maps, self.tips, strict=True):
            places, chance = chart.peaks(most)
            here = np.zeros((len(places), 5))
            here[:, :2], here[:, 3:] = places, tip
            aims.append(here)
            chances.append(chance)
            spreads.append(np.tile(chart.spread, (len(places), 1)))
        order = np.argsort(-np.concatenate(chances), kind='stable')[:most]
        return np.concatenate(aims)[order], np.concatenate(spreads)[order]


class Map:
    """Successes over speed and azimuth, in cells.

    Parameters
    ----------
    speeds : (float, float)
        Of the aims, m/s.
    spread : ndarray of shape (2,)
        Standard deviations of speed and azimuth, m/s and degrees.
    """

    def __init__(self, speeds: tuple[float, float], spread: NDArray[np.float64]) -> None:
        self.speeds, self.spread = speeds, spread
        self.low = max(speeds[0] - REACH * spread[0], 0.0)
        self.high = speeds[1] + REACH * spread[0]
        size = np.array([self.high - self.low, 360.0])
        blocks = np.ceil(size / spread * CELLS / BLOCK).astype(np.int64)
        self.cell = size / (BLOCK * blocks)
        self.successes = np.zeros(BLOCK * blocks)
        self.played = np.zeros(blocks)
        self.weights = np.zeros(blocks)
        self.near: list[tuple[NDArray[np.int64], NDArray[np.float64]]] = []
        self.count = 0

    def spread_evenly(self, count: int) -> None:
        """Take note of shots that are spread evenly over the whole map."""
        self.count += count
        self.played += count / self.played.size

    def add(
        self,
        strokes: NDArray[np.float64],
        met: NDArray[np.bool_],
        misses: NDArray[np.float64],
    ) -> None:
        """Add shots, (m, 2), of which some met the goal, and others missed it by so much."""
        cells = ((strokes - (self.low, 0.0)) / self.cell).astype(np.int64)
        cells = np.minimum(cells, np.array(self.successes.shape) - 1)
        np.add.at(self.successes, tuple(cells[met].T), 1.0)
        near = misses <= MISSES[-1]
        self.near.append((cells[near] // BLOCK, misses[near]))

    def look_where(self, farthest: float, power: float) -> None:
        """Choose the blocks for `focused`, by what missed by no more than this there and beside."""
        succeeded = np.zeros_like(self.played)
        for blocks, misses in self.near:
            some = misses <= farthest
            np.add.at(succeeded, tuple(blocks[some].T), np.maximum(misses[some], 1.0) ** -2)
        beside = [
            sum(shifts(sum(shifts(values, 0, 1)), 1, 1)) for values in (succeeded, self.played)
        ]
        self.weights = np.asarray(beside[0] / np.maximum(beside[1], 1e-300)) ** power

    @property
    def total(self) -> float:
        """Of the weights."""
        return float(self.weights.sum())

    def focused(self, count: int, rng: np.random.Generator) -> NDArray[np.float64]:
        """Return strokes, (count, 2), more of them in the blocks of greater weight."""
        share = self.weights / self.total
        self.played += count * share
        ends = np.cumsum(share)
        block = np.searchsorted(ends, rng.random(count) * ends[-1], side='right')
        corners = np.stack(np.unravel_index(block, share.shape), axis=-1)
        places = (corners + rng.random((count, 2))) * BLOCK * self.cell
        return np.asarray(places + (self.low, 0.0))

    def chances(self) -> NDArray[np.float64]:
        """Return the chance of each cell's middle as an aim; azimuths go round, speeds end."""
        density = np.repeat(np.repeat(self.played / BLOCK**2, BLOCK, axis=0), BLOCK, axis=1)
        chances = self.successes / density
        return along(along(chances, 0, self._weights(0)), 1, self._weights(1))

    def _weights(self, axis: int) -> NDArray[np.float64]:
        sd = self.spread[axis] / self.cell[axis]
        cells = np.arange(int(np.ceil(REACH * sd)) + 1)
        weights = np.exp(-0.5 * (cells / sd) ** 2)
        weights /= 2.0 * weights.sum() - weights[0]
        return np.asarray(weights)

    def peaks(self, most: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the best aims that are peaks, (k, 2), and their chances, (k,), best first."""
        if self.count == 0 or not self.successes.any():
            return np.empty((0, 2)), np.empty(0)
        chances = self.chances()
        middles = self.low + (np.arange(len(chances)) + 0.5) * self.cell[0]
        chances[(middles < self.speeds[0]) | (middles > self.speeds[1])] = 0.0
        top = chances
        for axis in (0, 1):
            top = reduce(np.maximum, shifts(top, axis, APART))
        # Rounding differs from cell to cell, so a plateau has some peaks, and not all its cells.
        places = np.argwhere((chances >= top) & (chances > 0.0))
        found = chances[places[:, 0], places[:, 1]]
        order = np.argsort(-found, kind='stable')[:most]
        return (self.low, 0.0) + (places[order] + 0.5) * self.cell, found[order]


def along(
    values: NDArray[np.float64], axis: int, weights: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return values smoothed along an axis by symmetric weights, the first that of the middle."""
    reach = len(weights) - 1
    parts = list(shifts(values, axis, reach))
    result = weights[0] * parts[reach]
    for k in range(1, reach + 1):
        result += weights[k] * (parts[reach - k] + parts[reach + k])
    return np.asarray(result)


def shifts(values: NDArray[np.float64], axis: int, reach: int) -> Iterator[NDArray[np.float64]]:
    """Yield values moved by -reach to reach cells along an axis.

    Azimuths, axis 1, go round; beyond the speeds is nothing.
    """
    wide = [(0, 0), (0, 0)]
    wide[axis] = (reach, reach)
    padded = np.pad(values, wide, 'wrap') if axis == 1 else np.pad(values, wide)
    for k in range(2 * reach + 1):
        part = slice(k, k + values.shape[axis])
        yield padded[part] if axis == 0 else padded[:, part]
