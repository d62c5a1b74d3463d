"""How badly somebody shoots and sees: standard deviations, all Gaussian."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import Table

STROKE = ('speed', 'azimuth', 'elevation', 'side', 'above')
"""The five numbers of a stroke, in the order of `cue_strikes`."""

NoiseName = Literal['fastfiz', 'sjtu']

MOST = 1e3
"""In the unit of each: beyond it nobody aims at anything."""


def checked(name: str, value: object) -> float:
    """Return a number from 0 to `MOST`; raise ValueError, naming it, where it is none."""
    try:
        number = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f'{name}: {value!r} is not a number') from None
    if not 0.0 <= number <= MOST:
        raise ValueError(f'{name}: {number} must be at least 0 and at most {MOST:g}')
    return number


@dataclass(frozen=True)
class Noise:
    """Standard deviations of what is executed and of what is seen.

    Parameters
    ----------
    speed : float, optional
        m/s: of the cue where balls spin, of the cue ball on a table of discs.
    azimuth, elevation : float, optional
        Degrees.
    side, above : float, optional
        Where the tip hits, in radii of the ball. Discs know neither these nor an elevation, and
        leave them out.
    camera : float, optional
        Of each coordinate of each ball that is seen, m.

    Raises
    ------
    ValueError
        Where one is negative, not finite or no number; names it.

    Examples
    --------
    >>> 0.5 * Noise(speed=0.1, azimuth=0.2)
    Noise(speed=0.05, azimuth=0.1, elevation=0.0, side=0.0, above=0.0, camera=0.0)
    """

    speed: float = 0.0
    azimuth: float = 0.0
    elevation: float = 0.0
    side: float = 0.0
    above: float = 0.0
    camera: float = 0.0

    def __post_init__(self) -> None:
        for field in fields(self):
            value = checked(f'noise: {field.name}', getattr(self, field.name))
            object.__setattr__(self, field.name, value)

    @staticmethod
    def preset(name: NoiseName) -> Noise:
        """Return the noise of a name.

        Parameters
        ----------
        name : {'fastfiz', 'sjtu'}

        Raises
        ------
        ValueError
            For another name.
        """
        if not isinstance(name, str) or name not in PRESETS:
            raise ValueError(f'noise: {name!r} is none; there are {", ".join(PRESETS)}')
        return PRESETS[name]

    def __mul__(self, factor: float) -> Noise:
        factor = checked('noise: the factor', factor)
        return replace(self, **{f.name: factor * getattr(self, f.name) for f in fields(self)})

    __rmul__ = __mul__

    def of_stroke(self, table: Table) -> NDArray[np.float64]:
        """Return the standard deviations of a stroke.

        Parameters
        ----------
        table : Table
            Discs know neither an elevation nor an offset of the tip.

        Returns
        -------
        ndarray of shape (5,)
            Of speed, azimuth, elevation, side and above: m/s, degrees twice, radii twice.
        """
        given = np.array([getattr(self, name) for name in STROKE])
        return given if table.motion == 'ball' else np.where(np.arange(5) < 2, given, 0.0)


PRESETS = {
    'fastfiz': Noise(
        speed=0.075, azimuth=0.125, elevation=0.1, side=0.5 / 28.575, above=0.5 / 28.575
    ),
    'sjtu': Noise(speed=0.1, azimuth=0.1, elevation=0.1, side=0.003, above=0.003),
}
"""FastFiz, the simulator of the computer olympiads: 0.5 mm on a ball of 28.575 mm. And a course on
agents for pool at Shanghai Jiao Tong University."""


def noise_of(given: Any) -> Noise:
    """Return a noise from itself, its name or its fields; raise ValueError for something else."""
    if isinstance(given, Noise):
        return given
    if isinstance(given, str):
        return Noise.preset(given)  # type: ignore[arg-type]
    if isinstance(given, dict):
        known = [field.name for field in fields(Noise)]
        for name in given:
            if name not in known:
                raise ValueError(f'noise: {name!r} is none of {", ".join(known)}')
        return Noise(**given)
    raise ValueError(
        f'noise: {given!r} must be a Noise, its fields, or one of {", ".join(get_args(NoiseName))}'
    )
