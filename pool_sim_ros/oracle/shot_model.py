"""One tracked shot: what the unknowns of a fit say about what was seen."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.oracle.tracks import Track
from pool_sim_ros.physics import Table, separated, simulate

START = 0.12
"""s after the strike whose frames give a first guess of the velocity."""

MOVES = 6.0
"""Noises that a ball which never moves does not get away from its mean."""


class ShotModel:
    """The unknowns of one track: velocity, spin where balls spin, and places of what moves.

    Parameters
    ----------
    table : Table
    track : Track
    noise : float
        Standard deviation of each coordinate, m.

    Raises
    ------
    ValueError
        Where the track has another number of balls, or too few frames after the strike.
    """

    def __init__(self, table: Table, track: Track, noise: float) -> None:
        n = len(table.balls)
        if track.positions.shape[1] != n:
            raise ValueError(f'track: {track.positions.shape[1]} balls must be {n}')
        self.track, self.noise = track, noise
        self.spins = 3 if table.motion == 'ball' else 0
        after = track.times >= 0.0
        self.before = int((~after).sum())
        if after.sum() < 5:
            raise ValueError(f'track: {after.sum()} frames after the strike must be at least 5')
        seen = track.positions
        self.seen = np.asarray(np.isfinite(seen).all(axis=2))
        if not self.seen.any(axis=0).all():
            hidden = table.labels[int(np.flatnonzero(~self.seen.any(axis=0))[0])]
            raise ValueError(f'track: ball {hidden!r} is in no frame')
        rest = np.empty((n, 2))
        moves = np.zeros(n, bool)
        for ball in range(n):
            there = np.flatnonzero(self.seen[:, ball])
            away = np.hypot(*(seen[there, ball] - seen[there[0], ball]).T)
            gone = np.flatnonzero(away > MOVES * noise)
            moves[ball] = ball == 0 or len(gone) > 2
            still = there[: max(gone[0] - 1, 1)] if moves[ball] and len(gone) else there
            rest[ball] = seen[still, ball].mean(axis=0)
        self.moves = np.flatnonzero(moves)
        self.rest = separated(table, rest)
        if self.rest is None:
            raise ValueError('track: its balls lie in one another before the strike')
        velocity = self._first_velocity(rest[0])
        spin = np.array([-velocity[1], velocity[0], 0.0]) / table.radii[0]
        if track.spin is not None:
            spin = track.spin
        self.guess = np.concatenate([velocity, spin[: self.spins], self.rest[self.moves].ravel()])

    def residuals(
        self, table: Table, unknowns: NDArray[np.float64], share: float
    ) -> NDArray[np.float64]:
        """Return how far what was seen is from what the unknowns say, in noises.

        Only a share of the track after the strike, from its beginning. A ball that was not seen
        differs by 0.
        """
        frames = self.before + max(int(np.ceil(share * (len(self.track.times) - self.before))), 5)
        places = np.array(self.rest)
        velocity, spin = unknowns[:2], unknowns[2 : 2 + self.spins]
        places[self.moves] = unknowns[2 + self.spins :].reshape(-1, 2)
        there = separated(table, places)
        if there is None:
            return np.full(2 * frames * len(places), 1e3)
        shot = simulate(table, velocity, spins=spin if self.spins else None, positions=there)
        expected = shot.positions(np.maximum(self.track.times[:frames], 0.0))
        left = (self.track.positions[:frames] - expected) / self.noise
        return np.where(self.seen[:frames, :, np.newaxis], left, 0.0).ravel()

    def _first_velocity(self, rest: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the velocity that goes with the first frames after the strike, m/s."""
        times = self.track.times
        early = np.flatnonzero((times > 0.0) & self.seen[:, 0])
        early = early[: max(int((times[early] <= START).sum()), 2)]
        t = times[early]
        way = self.track.positions[early, 0] - rest
        return np.asarray((t @ way) / (t @ t))


def with_values(table: Table, values: dict[str, float]) -> Table:
    """Return a table with other coefficients."""
    return replace(table, **values)  # type: ignore[arg-type]
