"""What an integrator returns: the whole of a shot, to be looked up at any time."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pool_sim_ros.physics.jit import for_kernels, inlined, kernel
from pool_sim_ros.physics.orientation import look_up_orientations
from pool_sim_ros.physics.table import Table
from pool_sim_ros.physics.tolerances import PATH_SAG, STRAIGHT, UNIT_QUATERNION
from pool_sim_ros.physics.validation import array


@dataclass(frozen=True, eq=False)
class Trajectory:
    """The motion of all balls from the strike to rest, or to where the clock was stopped.

    Attributes
    ----------
    table : Table
        The table that was played on.
    final_positions, final_velocities : ndarray of shape (n, 2)
        At the end, m and m/s. The velocities are zero unless `until` cut the shot.
    duration : float
        Time from the strike until the last ball rests, or `until`, s.
    events : structured ndarray
        In order of time: ``t`` (s); ``kind``: 0 ball-ball (a < b), 1 cushion (b: 0 is x = 0,
        1 is x = length, 2 is y = 0, 3 is y = width), 2 stop (b = -1); ``a``, ``b``; ``x``, ``y``:
        the point of contact, or the centre of a ball that stops (m); ``nx``, ``ny``: the unit
        vector from a to b or into the cushion, zero for a stop; ``speed``: closing speed before
        the contact (m/s).
    segments : structured ndarray
        What each ball does from ``t`` on, in order of time: ``ball``, ``t`` (s), ``x``, ``y`` (m),
        ``vx``, ``vy`` (m/s) and the constant acceleration ``ax``, ``ay`` (m/s^2), until its next
        segment. At rest all four are zero.
    complete : bool
        Whether all balls are at rest at the end.
    """

    table: Table
    final_positions: NDArray[np.float64]
    final_velocities: NDArray[np.float64]
    duration: float
    events: NDArray[np.void]
    segments: NDArray[np.void]
    complete: bool
    _pocketed: NDArray[np.int64] | None = None

    @cached_property
    def pocketed(self) -> NDArray[np.int64]:
        """Number of the pocket in which each ball is at the end, (n,); -1 for none."""
        if self._pocketed is not None and self._pocketed.size:
            return self._pocketed
        return np.full(len(self.final_positions), -1)

    def positions(self, times: ArrayLike) -> NDArray[np.float64]:
        """Return where the balls are.

        Parameters
        ----------
        times : array_like of shape (k,) or float
            Times since the strike, s, in any order; after the end the balls rest.

        Returns
        -------
        ndarray of shape (k, n, 2), or (n, 2) for a single time
            m.

        Raises
        ------
        ValueError
            Where a time is negative, not a number, or after a cut by `until`.
        """
        return self._look_up(times, 0)

    def velocities(self, times: ArrayLike) -> NDArray[np.float64]:
        """Return how fast the balls move, in m/s; as `positions`. At an event: just after it."""
        return self._look_up(times, 1)

    def spins(self, times: ArrayLike) -> NDArray[np.float64]:
        """Return the angular velocities, (k, n, 3) or (n, 3) in rad/s; as `positions`.

        Zero on a table of discs.
        """
        asked, flat = self._times(times)
        found = np.zeros((len(flat), len(self.final_positions), 3))
        if self.table.motion == 'ball':
            first, order = self._by_ball
            fades = self.table.for_kernels.spin
            look_up_spins(self.segments, first, order, flat, fades, found)
        return found if asked.ndim else found[0]

    def orientations(
        self, times: ArrayLike, orientations0: ArrayLike | None = None
    ) -> NDArray[np.float64]:
        """Return how the balls are turned.

        Parameters
        ----------
        times : array_like of shape (k,) or float
            As of `positions`.
        orientations0 : array_like of shape (n, 4), optional
            Unit quaternions x, y, z, w at the strike; by default nothing is turned.

        Returns
        -------
        ndarray of shape (k, n, 4), or (n, 4) for a single time
            Unit quaternions x, y, z, w, within 1e-6 rad. In order of time no sign jumps. A disc
            stays as it was.

        Raises
        ------
        ValueError
            As `positions`; and for orientations that are no unit quaternions.
        """
        asked, flat = self._times(times)
        n = len(self.final_positions)
        start = _unit_quaternions(orientations0, n)
        found = np.empty((len(flat) + 1, n, 4))
        found[:] = start
        if self.table.motion == 'ball':
            first, order = self._by_ball
            in_time = np.argsort(flat, kind='stable')
            fades = self.table.for_kernels.spin
            look_up_orientations(self.segments, first, order, flat[in_time], fades, found)
            found[1:][in_time] = found[1:].copy()
        return found[1:] if asked.ndim else found[1]

    def path(self, ball: int) -> NDArray[np.float64]:
        """Return the path of one ball, from its start to its end.

        Parameters
        ----------
        ball : int
            Its index.

        Returns
        -------
        ndarray of shape (k, 2)
            m; straight from each to the next, within 1e-5 m. No point is twice in a row, so that
            a ball that never moves has one.
        """
        segments = self.segments[self.segments['ball'] == ball]
        ends = np.append(segments['t'][1:], self.duration)
        points = [
            _curve(segment, end - segment['t']) for segment, end in zip(segments, ends, strict=True)
        ]
        points.append(self.final_positions[np.newaxis, ball])
        joined = np.concatenate(points)
        new = np.any(np.diff(joined, axis=0) != 0.0, axis=1)
        return joined[np.concatenate([[True], new])]

    def _look_up(self, times: ArrayLike, what: int) -> NDArray[np.float64]:
        asked, flat = self._times(times)
        n = len(self.final_positions)
        found = np.empty((len(flat), n, 2))
        first, order = self._by_ball
        look_up(self.segments, first, order, flat, what, found)
        return found if asked.ndim else found[0]

    def _times(self, times: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        asked = np.asarray(times, dtype=float)
        if asked.ndim > 1:
            raise ValueError(f'times: shape {asked.shape} must be one-dimensional')
        flat = for_kernels(np.atleast_1d(asked))
        self._check(flat)
        return asked, flat

    def _check(self, times: NDArray[np.float64]) -> None:
        bad = ~(times >= 0.0)
        if bad.any():
            raise ValueError(f'times: {times[bad][0]} must be a time since the strike, 0 or more')
        if not self.complete and (times > self.duration).any():
            late = times[times > self.duration][0]
            raise ValueError(f'times: {late} is after the shot was cut, at {self.duration} s')

    @cached_property
    def _by_ball(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Where each ball's segments begin in an order that sorts them by ball, and that order."""
        order = np.argsort(self.segments['ball'], kind='stable')
        counts = np.bincount(self.segments['ball'], minlength=len(self.final_positions))
        return np.concatenate([[0], np.cumsum(counts)]), order


def _unit_quaternions(given: ArrayLike | None, n: int) -> NDArray[np.float64]:
    """Return (n, 4) unit quaternions; raise ValueError where they are none."""
    if given is None:
        return np.tile((0.0, 0.0, 0.0, 1.0), (n, 1))
    start = array('orientations0', given)
    if start.shape != (n, 4):
        raise ValueError(f'orientations0: shape {start.shape} must be ({n}, 4)')
    lengths = np.linalg.norm(start, axis=1)
    if not np.all(np.abs(lengths - 1.0) <= UNIT_QUATERNION):
        raise ValueError(f'orientations0: {start[0]} must be unit quaternions x, y, z, w')
    return start / lengths[:, np.newaxis]


def _curve(segment: np.void, lasts: float) -> NDArray[np.float64]:
    """Return points on a segment, (k, 2) in m, the first at its start and none at its end."""
    v = np.array([segment['vx'], segment['vy']])
    a = np.array([segment['ax'], segment['ay']])
    sag = _most_across(v, a, lasts) * lasts * lasts / 8.0
    count = max(math.ceil(math.sqrt(sag / PATH_SAG)), 1)
    t = np.linspace(0.0, lasts, count, endpoint=False)[:, np.newaxis]
    return np.array([segment['x'], segment['y']]) + t * (v + 0.5 * t * a)


def _most_across(v: NDArray[np.float64], a: NDArray[np.float64], lasts: float) -> float:
    """Return the most that an acceleration is across its path, m/s^2.

    The cross product of acceleration and velocity is constant. So this is where the speed is
    least: at the point nearest to a turn.
    """
    cross = abs(float(v[0] * a[1] - v[1] * a[0]))
    squared = float(a @ a)
    if cross <= STRAIGHT * math.hypot(*v) * math.sqrt(squared):
        return 0.0
    slowest = min(max(-float(v @ a) / squared, 0.0), lasts)
    return cross / math.hypot(*(v + slowest * a))


@kernel
def look_up(
    segments: NDArray[np.void],
    first: NDArray[np.int64],
    order: NDArray[np.int64],
    times: NDArray[np.float64],
    what: int,
    found: NDArray[np.float64],
) -> None:
    """Fill `found`, (k, n, 2), with positions (`what` 0) or velocities (1) at `times`, (k,).

    Ball i has the segments ``order[first[i]:first[i + 1]]``, in order of time.
    """
    for i in range(len(first) - 1):
        for k in range(len(times)):
            segment = segments[segment_at(segments, first, order, i, times[k])]
            elapsed = times[k] - segment.t
            if what == 1:
                found[k, i, 0] = segment.vx + segment.ax * elapsed
                found[k, i, 1] = segment.vy + segment.ay * elapsed
            elif segment.ax == 0.0 and segment.ay == 0.0 and segment.vx == 0.0 == segment.vy:
                # At rest, for ever: infinity times nothing is no number.
                found[k, i, 0], found[k, i, 1] = segment.x, segment.y
            else:
                found[k, i, 0] = segment.x + elapsed * (segment.vx + 0.5 * segment.ax * elapsed)
                found[k, i, 1] = segment.y + elapsed * (segment.vy + 0.5 * segment.ay * elapsed)


@kernel
def look_up_spins(
    segments: NDArray[np.void],
    first: NDArray[np.int64],
    order: NDArray[np.int64],
    times: NDArray[np.float64],
    fades: float,
    found: NDArray[np.float64],
) -> None:
    """Fill `found`, (k, n, 3), with spins in rad/s; as `look_up`.

    The spin about the vertical axis falls by `fades` rad/s^2.
    """
    for i in range(len(first) - 1):
        for k in range(len(times)):
            segment = segments[segment_at(segments, first, order, i, times[k])]
            elapsed = times[k] - segment.t
            left = max(abs(segment.wz) - fades * elapsed, 0.0)
            found[k, i, 0] = segment.wx + segment.turn_x * elapsed
            found[k, i, 1] = segment.wy + segment.turn_y * elapsed
            found[k, i, 2] = left if segment.wz > 0.0 else -left


@inlined
def segment_at(
    segments: NDArray[np.void],
    first: NDArray[np.int64],
    order: NDArray[np.int64],
    i: int,
    t: float,
) -> int:
    """Return the number of the segment of ball `i` at `t`, s."""
    low, high = first[i], first[i + 1]
    while high - low > 1:
        middle = (low + high) // 2
        if segments[order[middle]].t <= t:
            low = middle
        else:
            high = middle
    return order[low]
