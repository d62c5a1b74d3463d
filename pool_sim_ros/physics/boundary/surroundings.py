"""What is near rails and pockets, worked out once for a table: so the kernels look at no more.

Arguments are as those of `pocketed_boundary`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.boundary.mouths import crosses
from pool_sim_ros.physics.tolerances import TOUCHING

Array = NDArray[np.float64]
Size = tuple[float, float]

STRETCH = 6
"""First of the four columns of its stretch in a segment's row of `PocketedBoundary.rows`."""

WITHIN, AROUND = 6, 7
"""Columns of a pocket there: see `surroundings`; the numbers around it are the last ones."""

SIDES = 4
"""Rows after the parts, one for each side of the rectangle: the numbers of its rails, then -1."""

MARGIN = 2.0 * TOUCHING
"""What is farther away than this, m, is not touched whatever rounding does."""


def rows_of(
    size: Size, segments: Array, noses: Array, pockets: Array, radius: float
) -> tuple[Array, bool]:
    """Return `PocketedBoundary.rows`, and whether there is an inner rectangle."""
    rails = sides_of(size, segments)
    free = has_inner_rectangle(size, segments[rails < 0], noses, pockets, radius)
    around, within = surroundings(segments, noses, pockets, radius)
    listed = [np.flatnonzero(rails == side) for side in range(SIDES)]
    columns = max(STRETCH + 4, AROUND + around.shape[1], *(len(each) + 1 for each in listed))
    count = len(segments) + len(noses) + len(pockets)
    rows = np.full((count + SIDES, columns), -1.0)
    rest = rows[len(segments) :]
    rows[: len(segments), :STRETCH] = segments
    stretches = free_stretches(size, segments, rails, noses, radius)
    rows[: len(segments), STRETCH : STRETCH + 4] = stretches
    rest[: len(noses), :3] = noses
    rest[len(noses) : -SIDES, :3] = pockets
    rest[len(noses) : -SIDES, WITHIN] = within
    rest[len(noses) : -SIDES, AROUND : AROUND + around.shape[1]] = around
    for side, rails_there in enumerate(listed):
        rows[count + side, : len(rails_there)] = rails_there
    return rows, free


def sides_of(size: Size, segments: Array) -> NDArray[np.int64]:
    """Return on which side of the rectangle each segment lies, as `Rectangle` has them, or -1."""
    length, width = size
    rails = np.full(len(segments), -1)
    sides = ((0, 0.0, 1.0), (0, length, -1.0), (1, 0.0, 1.0), (1, width, -1.0))
    for side, (axis, at, inward) in enumerate(sides):
        on = (segments[:, axis] == at) & (segments[:, 2 + axis] == at)
        rails[on & (segments[:, 4 + axis] == inward)] = side
    return rails


def has_inner_rectangle(
    size: Size, jaws: Array, noses: Array, pockets: Array, radius: float
) -> bool:
    """Return whether a ball between the lines on which it touches the rails touches nothing else.

    The `jaws` are the segments that are no rails.
    """
    low, high = np.full(2, radius), np.array(size) - radius
    tips = np.concatenate([jaws[:, :2], jaws[:, 2:4]])
    places = np.concatenate([noses[:, :2], pockets[:, :2], tips])
    reach = np.concatenate([noses[:, 2] + radius, pockets[:, 2], np.full(len(tips), radius)])
    away = np.hypot(*(np.clip(places, low, high) - places).T)
    return bool((away >= reach - TOUCHING).all()) and not crosses(jaws, low - radius, high + radius)


def free_stretches(
    size: Size, segments: Array, rails: NDArray[np.int64], noses: Array, radius: float
) -> Array:
    """Return the boxes in which a ball that touches a rail touches nothing else, (k, 4) in m.

    They are x low, x high, y low, y high for each segment. For what is no rail, and for rails that
    something else is near, they hold nothing. They count only where there is an inner rectangle.
    """
    boxes = np.tile((np.inf, -np.inf, np.inf, -np.inf), (len(segments), 1))
    for k in np.flatnonzero(rails >= 0):
        axis, along = int(rails[k]) // 2, 1 - int(rails[k]) // 2
        far = rails[k] % 2 == 1
        low = max(min(segments[k, along], segments[k, 2 + along]), radius) + radius
        high = max(segments[k, along], segments[k, 2 + along])
        high = min(high, size[along] - radius) - radius
        stretch = np.empty((1, 4))
        stretch[0, axis::2] = size[axis] - radius if far else radius
        stretch[0, along::2] = low, high
        others = np.delete(segments, k, axis=0)
        tips = np.concatenate([others[:, :2], others[:, 2:4]])
        clear = (
            (distances(tips, stretch) > radius + MARGIN).all()
            and (distances(stretch.reshape(2, 2), others) > radius + MARGIN).all()
            and (distances(noses[:, :2], stretch)[:, 0] > noses[:, 2] + radius + MARGIN).all()
        )
        if clear and low < high and size[axis] > 4.0 * radius:  # far from the side beyond
            box = np.empty((2, 2))
            box[axis] = sorted((stretch[0, axis], size[axis] / 2.0))
            box[axis] += (0.0, TOUCHING) if far else (-TOUCHING, 0.0)
            box[along] = low, high
            boxes[k] = box.ravel()
    return boxes


def surroundings(
    segments: Array, noses: Array, pockets: Array, radius: float
) -> tuple[NDArray[np.int64], Array]:
    """Return what a ball can touch near each pocket, and within what distance from its centre, m.

    Returns
    -------
    around : ndarray of shape (q, m)
        Numbers of parts; -1 where there are fewer.
    within : ndarray of shape (q,)
        A ball whose centre is not farther than this from that of the pocket touches nothing else.
    """
    centres = pockets[:, :2]
    between = np.hypot(*(centres[:, np.newaxis] - centres).transpose(2, 0, 1))
    np.fill_diagonal(between, np.inf)
    within = 0.5 * between.min(axis=1, initial=np.inf)
    away = np.hstack(
        [
            distances(centres, segments) - radius,
            *(
                np.hypot(*(centres[:, np.newaxis] - circles[:, :2]).transpose(2, 0, 1))
                - (circles[:, 2] + more)
                for circles, more in ((noses, radius), (pockets, 0.0))
            ),
        ]
    )
    near = away <= within[:, np.newaxis] + MARGIN
    around = np.full((len(pockets), int(near.sum(axis=1).max(initial=0))), -1)
    for q, row in enumerate(near):
        found = np.flatnonzero(row)
        around[q, : len(found)] = found
    return around, within


def distances(points: Array, segments: Array) -> Array:
    """Return how far points (p, 2) are from segments (k, 4 or more), m, (p, k)."""
    starts, ways = segments[:, :2], segments[:, 2:4] - segments[:, :2]
    relative = points[:, np.newaxis] - starts
    squared = np.maximum((ways**2).sum(axis=1), np.finfo(float).tiny)
    share = np.clip((relative * ways).sum(axis=2) / squared, 0.0, 1.0)
    return np.hypot(*(relative - share[..., np.newaxis] * ways).transpose(2, 0, 1))
