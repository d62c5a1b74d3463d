"""`fit`: the coefficients of a table from tracks of its balls, with their uncertainty.

Each track has unknowns of its own: where its balls lay, and velocity and spin of the cue ball. They
and the coefficients, which all tracks share, are fitted together by least squares.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.oracle.shot_model import ShotModel, with_values
from pool_sim_ros.oracle.tracks import Track
from pool_sim_ros.physics import Table

COEFFICIENTS = {
    'disc': ('mu_ball_surface', 'e_cue_ball', 'e_ball_ball', 'e_ball_cushion')
    + ('mu_ball_ball', 'mu_ball_cushion'),
    'ball': ('mu_slide', 'mu_roll', 'mu_spin', 'e_cue_ball', 'e_ball_ball', 'e_ball_cushion')
    + ('mu_ball_ball', 'mu_ball_cushion'),
}
"""What is fitted, by the motion of the table."""

UNSURE = 0.25
"""Standard error, as a part of the value, from which on a coefficient is not told: positions alone
do not tell it."""

STAGES = (0.1, 0.2, 0.3, 0.4, 0.55, 0.7, 0.85, 1.0, 1.0)
"""Parts of the tracks that are fitted one after another: a first guess is good for a short time."""

POLISH = 15
"""Gauss-Newton steps at the end, at most."""

PRIOR = 0.3
"""How far a coefficient is expected from the first guess, as a part of it. What the tracks tell is
hundreds of times as sharp; what they do not tell yet stays where it is."""

ROUGH = 20.0
"""Noises from which on what differs counts for less, until the whole track is fitted."""

MISFIT = 4.0
"""Standard deviations of chi-square from which on a track fits worse than the others."""

STEP, FINE_STEP = 5e-4, 1e-6
"""Of each unknown in the differences that make the Jacobian, in the unit of each. The first steps
over what is no more than a ripple; the second serves at the end, for exact errors."""

EVALUATIONS = 25
"""Steps of a stage, at most."""


@dataclass(frozen=True)
class Fit:
    """Coefficients that were found.

    Attributes
    ----------
    table : Table
        The table with the coefficients that were found.
    values, errors : dict of float
        Each coefficient and its standard error.
    unknown : tuple of str
        Coefficients that the tracks do not tell; those of the given table stay.
    noise : float
        Standard deviation of what the tracks differ by from the fit, m.
    chi_square : float
        Sum of the squares of these differences over that of the given noise; near `freedom` where
        the model is right.
    freedom : int
        Values that were seen, less unknowns.
    left_out : tuple of int
        Tracks that fit much worse than the others: a wrong order of contacts, a wrong first guess.
    """

    table: Table
    values: dict[str, float]
    errors: dict[str, float]
    unknown: tuple[str, ...]
    noise: float
    chi_square: float
    freedom: int
    left_out: tuple[int, ...] = ()

    def __str__(self) -> str:
        lines = [
            f'{name:16s} {v:.5f} +- {self.errors[name]:.5f}' for name, v in self.values.items()
        ]
        if self.unknown:
            lines.append(f'not to be told from these tracks: {", ".join(self.unknown)}')
        if self.left_out:
            lines.append(f'tracks left out: {", ".join(map(str, self.left_out))}')
        lines.append(
            f'noise {1e3 * self.noise:.3f} mm; chi^2 {self.chi_square:.0f} of {self.freedom}'
        )
        return '\n'.join(lines)


def fit(table: Table, tracks: Sequence[Track], *, noise: float = 5e-4) -> Fit:
    """Find the coefficients of a table from tracked positions.

    Parameters
    ----------
    table : Table
        With a first guess of its coefficients. Its balls, size and laws are taken as they are.
    tracks : sequence of Track
        One for each shot. Those of low sensitivity tell most: short ones, with few contacts.
    noise : float, optional
        Standard deviation of each coordinate that was seen, m.

    Returns
    -------
    Fit

    Raises
    ------
    ValueError
        For tracks of another number of balls, or without frames after the strike.
    ModuleNotFoundError
        Where scipy is not installed.
    """
    from scipy.optimize import least_squares

    if not 0.0 < noise < np.inf:
        raise ValueError(f'noise: {noise} must be above 0')
    names = list(COEFFICIENTS[table.motion])
    if table.ball_friction == 'alciatore':
        names.remove('mu_ball_ball')
    models = [ShotModel(table, track, noise) for track in tracks]
    if not models:
        raise ValueError('tracks: there are none')
    problem = Problem(table, names, models)
    kept, unknowns = np.arange(len(models)), problem.first_guess()
    for stage in STAGES:
        problem.share = stage
        found = least_squares(
            problem.residuals,
            unknowns,
            problem.jacobian,
            bounds=problem.bounds(),
            x_scale='jac',
            tr_solver='lsmr',
            loss='soft_l1' if stage < 1.0 else 'linear',
            f_scale=ROUGH,
            max_nfev=EVALUATIONS,
        )
        unknowns = found.x
    problem.step = FINE_STEP
    for _ in range(len(models)):
        unknowns = polished(problem, unknowns)
        good = problem.explained(unknowns)
        if good.all():
            break
        kept = kept[good]
        problem, unknowns = problem.only(good, unknowns)
    left_out = np.setdiff1d(np.arange(len(models)), kept)
    return replace(problem.result(unknowns, noise), left_out=tuple(left_out.tolist()))


def polished(problem: Problem, unknowns: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return unknowns to which Gauss-Newton steps add nothing: lsmr alone ends a little early."""
    low, high = problem.bounds()
    left = problem.residuals(unknowns)
    for _ in range(POLISH):
        slope = problem.jacobian(unknowns)
        curvature = (slope.T @ slope).toarray()
        step = np.linalg.lstsq(curvature, slope.T @ left, rcond=1e-12)[0]
        for part in (1.0, 0.3, 0.1, 0.03):
            there = np.clip(unknowns - part * step, low, high)
            better = problem.residuals(there)
            if better @ better < left @ left:
                break
        else:
            return unknowns
        gain = left @ left - better @ better
        unknowns, left = there, better
        if gain < 1e-3:
            break
    return unknowns


class Problem:
    """The least squares: unknowns are the coefficients, then those of each track."""

    def __init__(self, table: Table, names: list[str], models: list[ShotModel]) -> None:
        self.table, self.names, self.models = table, names, models
        self.share, self.step = 1.0, STEP
        self.given = np.array([float(getattr(table, name)) for name in names])
        self.prior = PRIOR * np.maximum(self.given, 0.02)
        sizes = [len(model.guess) for model in models]
        self.begins = len(names) + np.cumsum([0, *sizes])

    def first_guess(self) -> NDArray[np.float64]:
        """Return the coefficients of the table, and each track's own guess."""
        low, high = self.bounds()
        guess = np.concatenate([self.given, *(model.guess for model in self.models)])
        return np.asarray(np.clip(guess, low + 1e-4, high - 1e-4))

    def bounds(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the least and the greatest value of each unknown."""
        low, high = np.full(self.begins[-1], -np.inf), np.full(self.begins[-1], np.inf)
        count = len(self.names)
        low[:count] = 1e-5
        high[:count] = [1.0 if name.startswith('e_') else 10.0 for name in self.names]
        return low, high

    def residuals(self, unknowns: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return how far each value that was seen is from what the unknowns say, in noises."""
        table = self._table(unknowns)
        parts = [
            model.residuals(table, self._own(unknowns, k), self.share)
            for k, model in enumerate(self.models)
        ]
        prior = (unknowns[: len(self.names)] - self.given) / self.prior
        return np.concatenate([*parts, prior])

    def jacobian(self, unknowns: NDArray[np.float64]) -> Any:
        """Return the derivatives, a sparse matrix: a track knows no other's unknowns."""
        from scipy.sparse import block_diag, csr_matrix, diags, hstack, vstack

        table, count = self._table(unknowns), len(self.names)
        moved = []
        for k in range(count):
            other = unknowns.copy()
            other[k] += self.step if unknowns[k] + self.step < 1.0 else -self.step
            moved.append((self._table(other), other[k] - unknowns[k]))
        shared, blocks = [], []
        for k, model in enumerate(self.models):
            own = self._own(unknowns, k)
            here = model.residuals(table, own, self.share)
            shared.append(
                np.stack(
                    [(model.residuals(t, own, self.share) - here) / step for t, step in moved], 1
                )
            )
            block = np.empty((len(here), len(own)))
            for j in range(len(own)):
                other = own.copy()
                other[j] += self.step
                block[:, j] = (model.residuals(table, other, self.share) - here) / self.step
            blocks.append(block)
        seen = hstack([csr_matrix(np.concatenate(shared)), block_diag(blocks)])
        prior = diags([1.0 / self.prior], [0], shape=(count, len(unknowns)))
        return vstack([seen, prior]).tocsr()

    def explained(self, unknowns: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Return which tracks fit as well as most, (k,)."""
        table = self._table(unknowns)
        counts = np.array([model.seen.sum() * 2 for model in self.models])
        squares = np.array(
            [
                (model.residuals(table, self._own(unknowns, k), 1.0) ** 2).sum()
                for k, model in enumerate(self.models)
            ]
        )
        usual = np.median(squares / counts)
        return np.asarray(squares / counts <= usual * (1.0 + MISFIT * np.sqrt(2.0 / counts)))

    def only(
        self, good: NDArray[np.bool_], unknowns: NDArray[np.float64]
    ) -> tuple[Problem, NDArray[np.float64]]:
        """Return the problem of some tracks, and its unknowns."""
        chosen = [k for k, kept in enumerate(good) if kept]
        problem = Problem(self.table, self.names, [self.models[k] for k in chosen])
        problem.step = self.step
        own = [self._own(unknowns, k) for k in chosen]
        return problem, np.concatenate([unknowns[: len(self.names)], *own])

    def result(self, unknowns: NDArray[np.float64], noise: float) -> Fit:
        """Return what was found, with errors from the curvature."""
        count = len(self.names)
        left, slope = self.residuals(unknowns), self.jacobian(unknowns)
        curvature = (slope.T @ slope).toarray()
        scale = np.sqrt(np.maximum(np.diag(curvature), 1e-12))
        covariance = np.linalg.pinv(curvature / np.outer(scale, scale), 1e-10, hermitian=True)
        errors = np.sqrt(np.maximum(np.diag(covariance), 0.0)) / scale
        known = (scale[:count] > 1e-3) & (errors[:count] < UNSURE * np.abs(unknowns[:count]))
        found = {n: float(v) for n, v, k in zip(self.names, unknowns, known, strict=False) if k}
        freedom = len(left) - len(unknowns)
        chi_square = float(left @ left)
        return Fit(
            with_values(self.table, found),
            found,
            {n: float(e) for n, e, k in zip(self.names, errors, known, strict=False) if k},
            tuple(n for n, k in zip(self.names, known, strict=True) if not k),
            noise * float(np.sqrt(chi_square / max(freedom, 1))),
            chi_square,
            freedom,
        )

    def _table(self, unknowns: NDArray[np.float64]) -> Table:
        return replace(self.table, **dict(zip(self.names, unknowns.tolist(), strict=False)))

    def _own(self, unknowns: NDArray[np.float64], k: int) -> NDArray[np.float64]:
        return unknowns[self.begins[k] : self.begins[k + 1]]
