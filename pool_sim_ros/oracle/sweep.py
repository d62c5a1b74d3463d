"""The chance of every aim at once, from shots that their neighbours share.

Executed strokes are spread evenly over speed and azimuth. How often they succeed, smoothed by the
noise, is the chance of each aim.
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

SHARED = 10.0
"""Shots that an aim's chance must come from, at least; otherwise the map is smoothed more."""

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

    def _shared(self, shots: int) -> list[int]:
        """Share shots out to the tips: the middle gets half of them where there are others."""
        others = len(self.tips) - 1
        each = shots // 2 // others if others else 0
        return [shots - others * each] + [each] * others

    def _play(self, stratum: int, count: int) -> None:
        chart, trials = self.maps[stratum], self.trials
        start = np.random.default_rng([self.seed, 1, stratum]).random(2)
        rng = np.random.default_rng([self.seed, 2, stratum, self.passes])
        places = r2(chart.count, count, start)
        aims = np.zeros((count, 5))
        aims[:, 3:] = self.tips[stratum]
        normals = rng.standard_normal((count, 5)) if trials.spread[2:].any() else np.zeros(5)
        strokes = trials.executed(aims, normals)
        strokes[:, 0] = chart.low + places[:, 0] * (chart.high - chart.low)
        strokes[:, 1] = 360.0 * places[:, 1]
        met = trials.play(strokes, trials.layouts.draw(count, rng)).met
        chart.add(strokes[:, :2], met)
        self.met += int(met.sum())

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
        rows = int(np.ceil((self.high - self.low) / spread[0] * CELLS))
        columns = int(np.ceil(360.0 / spread[1] * CELLS))
        self.cell = np.array([(self.high - self.low) / rows, 360.0 / columns])
        self.successes = np.zeros((rows, columns))
        self.count = 0

    def add(self, strokes: NDArray[np.float64], met: NDArray[np.bool_]) -> None:
        """Add shots, (m, 2), of which some met the goal."""
        self.count += len(strokes)
        cells = ((strokes[met] - (self.low, 0.0)) / self.cell).astype(np.int64)
        row, column = np.minimum(cells, np.array(self.successes.shape) - 1).T
        np.add.at(self.successes, (row, column), 1.0)

    def chances(self) -> NDArray[np.float64]:
        """Return the chance of each cell's middle as an aim; azimuths go round, speeds end."""
        density = self.count / self.successes.size
        return along(along(self.successes, 0, self._weights(0)), 1, self._weights(1)) / density

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
