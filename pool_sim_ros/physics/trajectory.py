"""What an integrator returns: the whole of a shot, to be looked up at any time."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pool_sim_ros.extras import needs
from pool_sim_ros.physics.jit import for_kernels
from pool_sim_ros.physics.look_up import look_up, look_up_spins
from pool_sim_ros.physics.motion import BallTable
from pool_sim_ros.physics.orientation import look_up_orientations, unit_quaternions
from pool_sim_ros.physics.table import Table
from pool_sim_ros.physics.tolerances import PATH_SAG, STRAIGHT
from pool_sim_ros.physics.validation import array, whole_number

if TYPE_CHECKING:
    import pandas
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes


@dataclass(frozen=True, eq=False, repr=False)
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
    events : structured ndarray of shape (k,)
        In order of time: ``t`` (s); ``kind``: 0 ball-ball (a < b), 1 cushion (b: 0 is x = 0,
        1 is x = length, 2 is y = 0, 3 is y = width; with `Table.cushions` the row, segments first,
        then noses), 2 stop (b = -1), 3 pocketed (b: the pocket), 4 a slide becomes a roll (b = -1);
        ``a``, ``b``; ``x``, ``y``: the point of contact, or the centre of the ball (m); ``nx``,
        ``ny``: the unit vector from a to b, into the cushion or to the pocket's centre, otherwise
        zero; ``speed``: closing speed before a contact, that of a ball that is caught, otherwise 0
        (m/s).
    segments : structured ndarray of shape (k,)
        What each ball does from ``t`` on, in order of time: ``ball``, ``t`` (s), ``x``, ``y`` (m),
        ``vx``, ``vy`` (m/s) and the constant acceleration ``ax``, ``ay`` (m/s^2), until its next
        segment. At rest all four are zero. Where balls spin, also ``wx``, ``wy``, ``wz`` (rad/s)
        and what wx and wy change by, ``turn_x``, ``turn_y`` (rad/s^2).
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

    def __repr__(self) -> str:
        counts = f'{len(self.final_positions)} balls, {len(self.events)} events'
        return f'<Trajectory {self.duration:.4g} s, {counts}{"" if self.complete else ", cut"}>'

    def _repr_html_(self) -> str:
        from pool_sim_ros.physics.svg import shot_html

        return shot_html(self)

    @cached_property
    def pocketed(self) -> NDArray[np.int64]:
        """Number of the pocket in which each ball is at the end, (n,); -1 for none."""
        if self._pocketed is not None and self._pocketed.size:
            return self._pocketed
        return np.full(len(self.final_positions), -1)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the trajectory, with its table, to `path`, a file of NumPy's npz format."""
        from pool_sim_ros.physics.trajectory_file import save_trajectory

        save_trajectory(self, path)

    @staticmethod
    def load(path: str | os.PathLike[str]) -> Trajectory:
        """Return the trajectory in `path`; raise ValueError, naming file and field, and OSError."""
        from pool_sim_ros.physics.trajectory_file import load_trajectory

        return load_trajectory(path)

    def plot(self, axes: Axes | None = None) -> Axes:
        """Return `axes` of matplotlib, or new ones, with the balls' paths in m (extra `plot`).

        Raises ModuleNotFoundError where matplotlib is not installed.
        """
        with needs('plot()', 'plot'):
            from pool_sim_ros.physics.pictures import plot
        return plot(self, axes)

    def animate(
        self, speed: float = 1.0, fps: float = 30.0, axes: Axes | None = None
    ) -> FuncAnimation:
        """Return a film of the shot, which a notebook shows (extra `plot`).

        `speed` is how many times as fast as the balls it runs, `fps` its frames a second; `axes` as
        in `plot`. Raises ValueError for more than 2000 frames, ModuleNotFoundError without
        matplotlib.
        """
        with needs('animate()', 'plot'):
            from pool_sim_ros.physics.pictures import Film
        return Film(self, speed, fps, axes)

    def events_frame(self) -> pandas.DataFrame:
        """Return `events` as a frame of pandas (extra `frames`).

        `kind` is in words, `ball` and `other` are the labels of the balls. Raises
        ModuleNotFoundError where pandas is not installed.
        """
        from pool_sim_ros.physics.frames import events_frame

        return events_frame(self.events, self.table.labels)

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
        """Return how fast the balls move at `times`, (k, n, 2) or (n, 2) in m/s; as `positions`.

        At an event: just after it.
        """
        return self._look_up(times, 1)

    def spins(self, times: ArrayLike) -> NDArray[np.float64]:
        """Return the angular velocities at `times`, (k, n, 3) or (n, 3) in rad/s; as `positions`.

        About x, y and z, which points up. Zero on a table of discs, and of balls in a pocket.
        """
        asked, flat = self._times(times)
        found = np.zeros((len(flat), len(self.final_positions), 3))
        kernels = self.table.for_kernels
        if isinstance(kernels, BallTable):
            look_up_spins(self.segments, *self._by_ball, flat, kernels.spin, found)
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
        start = unit_quaternions(orientations0, n)
        found = np.empty((len(flat) + 1, n, 4))
        found[:] = start
        kernels = self.table.for_kernels
        if isinstance(kernels, BallTable):
            in_time = np.argsort(flat, kind='stable')
            in_order = flat[in_time]
            look_up_orientations(self.segments, *self._by_ball, in_order, kernels.spin, found)
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

        Raises
        ------
        ValueError
            Where there is no such ball.
        """
        n = len(self.final_positions)
        ball = whole_number('ball', ball, least=0)
        if ball >= n:
            raise ValueError(f'ball: {ball} must be below {n}, the number of balls')
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
        asked = array('times', times)
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


def _curve(segment: np.void, lasts: float) -> NDArray[np.float64]:
    """Return points on a segment, (k, 2) in m, the first at its start and none at its end."""
    v = np.array([segment['vx'], segment['vy']])
    a = np.array([segment['ax'], segment['ay']])
    sag = _most_across(v, a, lasts) * lasts * lasts / 8.0
    count = max(math.ceil(math.sqrt(sag / PATH_SAG)), 1)
    t = np.linspace(0.0, lasts, count, endpoint=False)
    if sag == 0.0 and 0.0 < -float(v @ a) < lasts * float(a @ a):
        # A ball that comes back on its own line.
        t = np.append(t, -float(v @ a) / float(a @ a))
    t = t[:, np.newaxis]
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
