"""Plays strokes as they are executed, each on a layout of its own, and judges them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.oracle.cluster import Cluster
from pool_sim_ros.oracle.goal import Goal
from pool_sim_ros.oracle.judge import Judge
from pool_sim_ros.oracle.layouts import Layouts
from pool_sim_ros.oracle.noise import Noise
from pool_sim_ros.physics import Outcomes, Table, cue_strikes, simulate_many

MISCUE = 'the tip slips off the cue ball'
"""What comes instead where it does."""


class Played(NamedTuple):
    """What came of m shots: their outcomes, whether the tip held, whether they met the goal."""

    outcomes: Outcomes
    held: NDArray[np.bool_]
    met: NDArray[np.bool_]


class Trials:
    """A goal on a table, and how badly somebody shoots and sees.

    Parameters
    ----------
    table : Table
    goal : Goal
    noise : Noise
    positions : ndarray of shape (n, 2)
        Where the balls were seen, m.
    threads : int or None
        At most so many play.
    cluster : Cluster, optional
        Where to play instead.

    Raises
    ------
    ValueError
        As `Judge` and `simulate_many`.
    """

    def __init__(
        self,
        table: Table,
        goal: Goal,
        noise: Noise,
        positions: NDArray[np.float64],
        threads: int | None,
        cluster: Cluster | None = None,
    ) -> None:
        self._play = simulate_many if cluster is None else cluster.simulate_many
        self.table, self.positions, self.threads = table, positions, threads
        self.judge = Judge(table, goal, positions)
        self.layouts = Layouts(table, positions, noise.camera)
        self.spread = noise.of_stroke(table)
        self.played = 0

    def play(
        self, strokes: NDArray[np.float64], layouts: NDArray[np.float64] | None = None
    ) -> Played:
        """Play strokes as executed.

        Parameters
        ----------
        strokes : ndarray of shape (m, 5)
            As `executed` returns them.
        layouts : ndarray of shape (m, n, 2), optional
            Where the balls really lie, m.
        """
        velocities, spins, held = self.struck(strokes)
        outcomes = self._play(
            self.table,
            velocities,
            spins=spins,
            positions=self.positions if layouts is None else layouts,
            events=self.judge.needs_events,
            errors='mark',
            threads=self.threads,
        )
        self.played += len(strokes)
        return Played(outcomes, held, self.judge.met(outcomes) & held)

    def struck(
        self, strokes: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64] | None, NDArray[np.bool_]]:
        """Return velocities, spins (None for discs), and whether the tip held."""
        if self.table.motion == 'ball':
            velocities, spins = cue_strikes(self.table, *strokes.T)
            held = np.isfinite(velocities[:, 0])
            velocities[~held] = spins[~held] = 0.0
            return velocities, spins, held
        speed, angle = strokes[:, 0], np.radians(strokes[:, 1])
        velocities = np.stack([speed * np.cos(angle), speed * np.sin(angle)], axis=-1)
        return velocities, None, np.ones(len(strokes), bool)

    def executed(
        self,
        aims: NDArray[np.float64],
        normals: NDArray[np.float64],
        spread: NDArray[np.float64] | None = None,
    ) -> NDArray[np.float64]:
        """Return what comes of aims, (..., 5), with the noise of standard normals, (..., 5).

        A cue does not go backwards, nor does it point up: speeds and elevations end at 0.
        """
        strokes: NDArray[np.float64] = aims + (self.spread if spread is None else spread) * normals
        strokes[..., 0] = np.maximum(strokes[..., 0], 0.0)
        strokes[..., 2] = np.clip(strokes[..., 2], 0.0, 90.0)
        return strokes

    def instead(self, played: Played, layouts: NDArray[np.float64] | None) -> NDArray[np.object_]:
        """Say what came instead of the goal, shot by shot, (m,); '' where it was met."""
        start = self.positions if layouts is None else layouts
        words = self.judge.instead(played.outcomes, start)
        words[~played.held] = MISCUE
        return words
