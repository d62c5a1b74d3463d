"""`error_budget`: how accurate somebody must be, error by error."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pool_sim_ros.oracle.checks import checked_positions, whole
from pool_sim_ros.oracle.goal import Goal, goal_of
from pool_sim_ros.oracle.intervals import wilson
from pool_sim_ros.oracle.noise import STROKE, Noise, NoiseName, noise_of
from pool_sim_ros.oracle.plan import RankedShot
from pool_sim_ros.oracle.race import common
from pool_sim_ros.oracle.trials import Trials
from pool_sim_ros.physics import Table, cue_strike

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LEVELS = {
    'speed': (0.01, 0.02, 0.05, 0.1, 0.2, 0.5),
    'azimuth': (0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0),
    'elevation': (0.5, 1.0, 2.0, 5.0, 10.0),
    'side': (0.005, 0.01, 0.02, 0.05, 0.1),
    'above': (0.005, 0.01, 0.02, 0.05, 0.1),
    'camera': (1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3),
}
"""Standard deviations that are tried: from what a good robot reaches to what a child does."""

UNITS = {
    'speed': 'm/s',
    'azimuth': 'degrees',
    'elevation': 'degrees',
    'side': 'radii',
    'above': 'radii',
    'camera': 'm',
}


@dataclass(frozen=True)
class ErrorBudget:
    """How the chance of a shot falls with each error, while all others are as given.

    Attributes
    ----------
    chance : float
        Chance with the errors as given.
    levels : dict of ndarray of shape (k,)
        Standard deviations that were tried, in the units of `Noise`, rising; by name of the error.
    chances, low, high : dict of ndarray of shape (k,)
        Chance at each level, and its 95 % interval.
    """

    chance: float
    levels: dict[str, NDArray[np.float64]]
    chances: dict[str, NDArray[np.float64]]
    low: dict[str, NDArray[np.float64]]
    high: dict[str, NDArray[np.float64]]

    def tolerance(self, chance: float) -> dict[str, float]:
        """Return how large each error may be for a chance to remain.

        Parameters
        ----------
        chance : float
            The chance that is to remain, 0 to 1.

        Returns
        -------
        dict of float
            By name of the error, in the units of `Noise`: the level, interpolated, at which the
            chance first falls below. Infinite where it does so at no level, 0 where it is below
            without the error already.
        """
        allowed = {}
        for name, levels in self.levels.items():
            below = np.flatnonzero(self.chances[name] < chance)
            if len(below) == 0:
                allowed[name] = float('inf')
            elif below[0] == 0:
                allowed[name] = 0.0
            else:
                first = below[0]
                x0, x1 = levels[first - 1 : first + 1]
                y0, y1 = self.chances[name][first - 1 : first + 1]
                allowed[name] = float(x0 + (y0 - chance) / (y0 - y1) * (x1 - x0))
        return allowed

    def __str__(self) -> str:
        lines = []
        for name, levels in self.levels.items():
            steps = '  '.join(
                f'{level:g}: {100 * chance:.0f} %'
                for level, chance in zip(levels, self.chances[name], strict=True)
            )
            lines.append(f'{name:9s} ({UNITS[name]})  {steps}')
        return '\n'.join(lines)

    def plot(self) -> Figure:
        """Return a matplotlib figure: the chance over each error, with its intervals."""
        from matplotlib.figure import Figure

        figure = Figure(figsize=(3.0 * len(self.levels), 3.0), layout='constrained')
        axes = figure.subplots(1, len(self.levels), sharey=True, squeeze=False)[0]
        for axis, (name, levels) in zip(axes, self.levels.items(), strict=True):
            axis.fill_between(levels, self.low[name], self.high[name], alpha=0.25)
            axis.plot(levels, self.chances[name], marker='.')
            axis.set_xlabel(f'{name} ({UNITS[name]})')
            axis.set_ylim(0.0, 1.0)
        axes[0].set_ylabel('chance')
        return figure


def error_budget(
    table: Table,
    goal: Goal | dict[str, Any],
    shot: RankedShot | dict[str, float],
    *,
    noise: Noise | NoiseName | None = None,
    shots: int = 4096,
    seed: int = 0,
    positions: ArrayLike | None = None,
    threads: int | None = None,
) -> ErrorBudget:
    """Say how the chance of a shot falls as each error grows: what accuracy a robot must have.

    Parameters
    ----------
    table : Table
    goal : Goal, or its fields
    shot : RankedShot, or dict
        A shot of `find_shots`, or an aim: `speed` (m/s) and `azimuth` (degrees); where balls spin
        also `elevation`, `side` and `above`, as `cue_strike` takes them.
    noise : Noise, its fields, or the name of a preset, optional
        The other errors while one grows; by default none.
    shots : int, optional
        Of each level; at least 100.
    seed : int, optional
        All levels have the same luck.
    positions : array_like of shape (n, 2), optional
        Where the balls were seen instead of their own places, m.
    threads : int, optional
        At most so many; by default one for each core.

    Returns
    -------
    ErrorBudget
        Elevation, side and above only where balls spin.

    Raises
    ------
    ValueError
        As `find_shots`, and for an aim that is none.
    """
    given = Noise() if noise is None else noise_of(noise)
    shots, seed = whole('shots', shots, 100), whole('seed', seed)
    aim = aim_of(table, shot)[np.newaxis]
    goal, seen = goal_of(goal), checked_positions(table, positions)

    def chance_with(errors: Noise) -> tuple[float, float, float]:
        trials = Trials(table, goal, errors, seen, threads)
        successes = int(common(trials, aim, shots, [seed, 7])[0].sum())
        return successes / shots, *wilson(successes, shots)

    spins = table.motion == 'ball'
    names = [n for n in LEVELS if spins or n in ('speed', 'azimuth', 'camera')]
    levels = {name: np.array([0.0, *LEVELS[name]]) for name in names}
    counted = {
        name: np.array([chance_with(replace(given, **{name: level})) for level in levels[name]]).T
        for name in names
    }
    chances, low, high = ({name: counted[name][k] for name in names} for k in range(3))
    return ErrorBudget(chance_with(given)[0], levels, chances, low, high)


def aim_of(table: Table, shot: Any) -> NDArray[np.float64]:
    """Return the aim of a shot, (5,), in the order of `STROKE`; raise ValueError for none."""
    if isinstance(shot, RankedShot):
        shot = shot.cue or {'speed': shot.speed, 'azimuth': shot.azimuth}
    known = STROKE if table.motion == 'ball' else STROKE[:2]
    if not isinstance(shot, dict) or not set(shot) <= set(known) or not {*STROKE[:2]} <= set(shot):
        raise ValueError(f'shot: {shot!r} must be a RankedShot, or have {", ".join(known)}')
    cue_strike(table, **shot)  # which says what is wrong with a value
    return np.array([float(shot.get(name, 0.0)) for name in STROKE])
