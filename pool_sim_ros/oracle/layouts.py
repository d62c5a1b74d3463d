"""Where the balls may really lie, given where a camera saw them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.oracle.judge import pocketed_at
from pool_sim_ros.physics import Table, simulate_many

FAR = 12.0
"""Standard deviations that no noise reaches: what lies farther apart cannot meet."""

ROUNDS = 30
"""In which balls that overlap are moved apart."""

DRAWS = 4
"""Times that a layout is drawn before the one that was seen takes its place."""

SPARE = 0.2
"""Standard deviations by which two balls are moved too far, so that a rack comes to an end soon."""


class Layouts:
    """Draws layouts round one that was seen.

    The rule for a layout that cannot be: a ball that was seen between the rails is put back between
    them. Two balls that overlap move apart along the line of their centres, each half the way, and
    a little farther; a ball in several pairs by the mean of these; all pairs at once, in up to
    `ROUNDS` rounds. What still cannot be, and where a ball would lie in a pocket, is drawn again.
    After `DRAWS` draws the layout is the one that was seen. Balls in a pocket stay there.

    Parameters
    ----------
    table : Table
    seen : ndarray of shape (n, 2)
        m.
    camera : float
        Standard deviation of each coordinate, m.
    """

    def __init__(self, table: Table, seen: NDArray[np.float64], camera: float) -> None:
        self.table, self.seen, self.camera = table, seen, camera
        self.caught = pocketed_at(table, seen)
        self.free = self.caught < 0
        radii = table.radii
        first, second = np.triu_indices(len(seen), 1)
        touch = radii[first] + radii[second]
        gap = np.hypot(*(seen[first] - seen[second]).T) - touch
        near = (gap < 2.0 * FAR * camera) & self.free[first] & self.free[second]
        self.pairs = first[near], second[near], touch[near]
        size = np.array([table.length, table.width])
        self.low, self.high = radii[:, None] + np.zeros(2), size - radii[:, None]
        reach = FAR * camera
        clear = np.all((seen - self.low > reach) & (self.high - seen > reach), axis=1)
        between = np.all((seen >= self.low - 1e-9) & (seen <= self.high + 1e-9), axis=1)
        # A ball in a mouth of a pocket, beyond the rails, is kept by its jaws alone.
        kept = between & self.free
        self.low[~kept], self.high[~kept] = -np.inf, np.inf
        self.plain = table.cushions is None and len(table.pockets) == 0
        self.at_rails = np.flatnonzero(~clear & self.free)
        self.any_close = bool(near.any() or len(self.at_rails) > 0)

    def draw(self, count: int, rng: np.random.Generator) -> NDArray[np.float64] | None:
        """Return so many layouts, (count, n, 2) in m; None where the camera makes no mistake."""
        if self.camera == 0.0:
            return None
        places = self._noisy(count, rng)
        if not self.any_close:
            return places
        places = self._apart(places)
        bad = np.flatnonzero(self._impossible(places))
        for _ in range(DRAWS - 1):
            if len(bad) == 0:
                return places
            places[bad] = self._apart(self._noisy(len(bad), rng))
            bad = bad[self._impossible(places[bad])]
        places[bad] = self.seen
        return places

    def _noisy(self, count: int, rng: np.random.Generator) -> NDArray[np.float64]:
        noise = self.camera * rng.standard_normal((count, *self.seen.shape))
        noise[:, ~self.free] = 0.0
        return self.seen + noise

    def _impossible(self, places: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Return which layouts cannot be, (m,): the engine says so, where there are pockets."""
        if self.plain:
            first, second, touch = self.pairs
            apart = places[:, second] - places[:, first]
            return np.asarray(((apart**2).sum(axis=2) < touch**2).any(axis=1))
        nothing = np.zeros((len(places), len(self.seen), 2))
        played = simulate_many(
            self.table, nothing, positions=places, until=0.0, errors='mark', threads=1
        )
        return np.asarray((played.failed != 0) | (played.pocketed != self.caught).any(axis=1))

    def _apart(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return layouts, (m, n, 2), with their balls between the rails and apart."""
        rails = self.at_rails
        places[:, rails] = np.clip(places[:, rails], self.low[rails], self.high[rails])
        first, second, touch = self.pairs
        left = np.arange(len(places)) if len(first) else np.arange(0)
        for _ in range(ROUNDS):
            apart = places[left[:, None], second] - places[left[:, None], first]
            distance = np.hypot(apart[..., 0], apart[..., 1])
            depth = touch - distance
            some = (depth > 0.0).any(axis=1)
            left, apart, distance, depth = left[some], apart[some], distance[some], depth[some]
            if len(left) == 0:
                break
            apart[distance == 0.0] = 1.0, 0.0
            unit = apart / np.where(distance == 0.0, 1.0, distance)[..., None]
            close = depth > 0.0
            moves = np.where(close, 0.5 * (depth + SPARE * self.camera), 0.0)[..., None] * unit
            total, counts = np.zeros_like(places[left]), np.zeros((*places[left].shape[:2], 1))
            for k in range(len(first)):
                total[:, first[k]] -= moves[:, k]
                total[:, second[k]] += moves[:, k]
                counts[:, first[k], 0] += close[:, k]
                counts[:, second[k], 0] += close[:, k]
            moved = places[left] + total / np.maximum(counts, 1.0)
            places[left] = np.clip(moved, self.low, self.high)
        return places
