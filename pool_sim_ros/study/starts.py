"""Where the balls lie when an episode begins: layouts that are drawn once, for all environments."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pool_sim_ros.physics import Table, simulate_many
from pool_sim_ros.study.checks import checked_layouts

COUNT = 16384
"""Layouts that are drawn: too many to learn by heart, and drawn in a tenth of a second."""

SEED = 0
"""Of the layouts. They are the same everywhere; the seed of an environment chooses among them."""

GAP = 1e-6
"""Between two balls at least, m: far more than rounding, and nothing beside a ball."""

TRIES = 1000
"""Places that a ball is tried at before the table counts as too full."""

ROUNDS = 20
"""How often layouts that cannot be are drawn anew."""


def starts_of(table: Table, starts: int | ArrayLike) -> NDArray[np.float64]:
    """Return layouts, (k, n, 2) in m: so many drawn ones, or those that are given.

    Raises
    ------
    ValueError
        Where a given one cannot be, or where the table is too full to draw any.
    """
    if isinstance(starts, (int, np.integer)) and not isinstance(starts, bool):
        if not 1 <= starts <= 10_000_000:
            raise ValueError(f'starts: {starts} must be 1 to 10,000,000 layouts, or an array')
        return drawn_starts(table, int(starts))
    layouts = checked_layouts('starts', table, starts, 'a whole number, or ')
    caught = _at_rest(table, layouts).pocketed[:, 0] >= 0
    if caught.any():
        raise ValueError(f'starts[{int(caught.argmax())}]: the cue ball lies in a pocket')
    return layouts


@lru_cache(maxsize=8)
def drawn_starts(table: Table, count: int) -> NDArray[np.float64]:
    """Return layouts, (count, n, 2) in m, read-only: balls anywhere on the cloth, none caught."""
    rng = np.random.default_rng(SEED)
    found = np.empty((0, len(table.balls), 2))
    for _ in range(ROUNDS):
        layouts = _scattered(table, count, rng)
        ends = _at_rest(table, layouts)
        right = (ends.failed == 0) & ~(ends.pocketed >= 0).any(axis=1)
        found = np.concatenate([found, layouts[right]])[:count]
        if len(found) == count:
            found.flags.writeable = False
            return found
    raise ValueError('table: hardly any layout at random can be; give `starts` of your own')


def _at_rest(table: Table, layouts: NDArray[np.float64]) -> Any:
    still = np.zeros((len(layouts), 2))
    return simulate_many(table, still, positions=layouts, errors='mark')


def _scattered(table: Table, count: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """Return layouts in which no two balls overlap: each ball in turn, until it has room."""
    radii, size = table.radii, np.array([table.length, table.width])
    layouts = np.empty((count, len(radii), 2))
    for ball, radius in enumerate(radii):
        if 2.0 * radius > size.min():
            raise ValueError(f'table: ball {table.labels[ball]!r} is wider than the table')
        rows, least = np.arange(count), radii[:ball] + radius + GAP
        for _ in range(TRIES):
            places = rng.uniform(radius, size - radius, (len(rows), 2))
            layouts[rows, ball] = places
            apart = layouts[rows, :ball] - places[:, np.newaxis]
            rows = rows[((apart**2).sum(axis=2) < least**2).any(axis=1)]
            if not len(rows):
                break
        else:
            raise ValueError(
                f'table: no room at random for ball {table.labels[ball]!r}; give `starts` of your '
                'own, or fewer balls'
            )
    return layouts
