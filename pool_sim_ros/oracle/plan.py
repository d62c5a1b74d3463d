"""What a search answers: shots, ranked, with their chances."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple, overload

import numpy as np
from numpy.typing import NDArray


class Failure(NamedTuple):
    """What comes instead of the goal.

    Attributes
    ----------
    outcome : str
        In words.
    share : float
        In which share of all shots.
    """

    outcome: str
    share: float


class RankedShot(NamedTuple):
    """A shot and what it is worth.

    Attributes
    ----------
    velocity : ndarray of shape (2,)
        Of the cue ball, m/s.
    spin : ndarray of shape (3,), or None
        rad/s, z up; None on a table of discs.
    cue : dict, or None
        The stroke that gives both, as `cue_strike` takes it; None on a table of discs.
    speed, azimuth : float
        The aim: of the cue, or of the cue ball on a table of discs, m/s; degrees.
    chance, low, high : float
        Chance of the goal, and its 95 % interval (Wilson), from shots that the search did not use.
    mean, spread : ndarray of shape (n, 2)
        Mean and standard deviation of where each ball ends while it stays on the cloth, m; NaN
        where it never does.
    caught : ndarray of shape (n,)
        The share of the shots in which a pocket catches each ball.
    failures : tuple of Failure
        The three most frequent outcomes where the goal is missed, most frequent first.
    shots : int
        From which all this is counted.
    """

    velocity: NDArray[np.float64]
    spin: NDArray[np.float64] | None
    cue: dict[str, float] | None
    speed: float
    azimuth: float
    chance: float
    low: float
    high: float
    mean: NDArray[np.float64]
    spread: NDArray[np.float64]
    caught: NDArray[np.float64]
    failures: tuple[Failure, ...]
    shots: int


class Plan(Sequence[RankedShot]):
    """Shots, best first, as the search ranked them; none where none was found.

    Their chances are counted afterwards, so that of a lower rank may be a little higher.

    Attributes
    ----------
    shots : tuple of RankedShot
    played : int
        Shots that the search played in all.
    cut : bool
        Whether `seconds` ended the search before `shots` did.
    """

    def __init__(self, shots: Sequence[RankedShot], played: int, cut: bool) -> None:
        self.shots, self.played, self.cut = tuple(shots), played, cut

    @overload
    def __getitem__(self, index: int) -> RankedShot: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[RankedShot, ...]: ...
    def __getitem__(self, index: int | slice) -> RankedShot | tuple[RankedShot, ...]:
        return self.shots[index]

    def __len__(self) -> int:
        return len(self.shots)

    def __iter__(self) -> Iterator[RankedShot]:
        return iter(self.shots)

    def __str__(self) -> str:
        searched = f'{self.played:,} shots played' + (', cut by time' if self.cut else '')
        if not self.shots:
            return f'None found: {searched}.'
        lines = [' #  speed  azimuth  side above  chance     95 %      otherwise']
        for rank, shot in enumerate(self.shots, 1):
            cue = shot.cue or {}
            otherwise = '; '.join(f'{f.outcome} {100 * f.share:.0f} %' for f in shot.failures)
            lines.append(
                f'{rank:2d}  {shot.speed:5.2f}  {shot.azimuth:7.2f} {cue.get("side", 0.0):5.2f} '
                f'{cue.get("above", 0.0):5.2f}  {100 * shot.chance:5.1f} %  '
                f'{100 * shot.low:.1f} to {100 * shot.high:.1f}  {otherwise}'
            )
        return '\n'.join([*lines, f'{searched}.'])

    def __repr__(self) -> str:
        best = f', best chance {self.shots[0].chance:.3f}' if self.shots else ''
        return f'<Plan: {len(self.shots)} shots of {self.played:,} played{best}>'
