"""How balls are turned, row by row of ticks: each row goes on from the one before."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import Trajectory


class Turning:
    """Turns the balls of a shot.

    To integrate the spins from the strike on for each row would take longer and longer.

    Parameters
    ----------
    shot : Trajectory
    start : ndarray of shape (n, 4)
        Unit quaternions x, y, z, w at the strike.
    """

    def __init__(self, shot: Trajectory, start: NDArray[np.float64]) -> None:
        self._shot = shot
        self._since = 0.0
        self._turned = start

    def at(self, times: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return orientations, (k, n, 4), at (k,) times since the strike, s.

        The times are in order, and none is before those of an earlier call. Of the two signs of a
        quaternion each has the one that is nearer to the orientation before it.
        """
        rest = _rest_of(self._shot, self._since) if self._since else self._shot
        turned = rest.orientations(times - self._since, self._turned)
        each = np.concatenate([self._turned[np.newaxis], turned])
        dots = np.sum(each[1:] * each[:-1], axis=2, keepdims=True)
        turned = turned * np.cumprod(np.where(dots < 0.0, -1.0, 1.0), axis=0)
        if len(times):
            self._since, self._turned = float(times[-1]), turned[-1]
        return turned


def _rest_of(shot: Trajectory, since: float) -> Trajectory:
    """Return a shot whose balls spin as those of another one do from `since`, s, on."""
    segments = shot.segments
    count = int(np.searchsorted(segments['t'], since, 'right'))
    latest = np.zeros(len(shot.final_positions), dtype=np.int64)
    np.maximum.at(latest, segments['ball'][:count], np.arange(count))
    now, later = segments[latest], segments[count:].copy()
    elapsed = since - now['t']
    now['wx'] += now['turn_x'] * elapsed
    now['wy'] += now['turn_y'] * elapsed
    now['wz'] = shot.spins(since)[:, 2]
    now['t'] = 0.0
    later['t'] -= since
    return replace(
        shot, segments=np.concatenate([now, later]), duration=max(shot.duration - since, 0.0)
    )
