"""The report's shots as played on a table, beside the results that the report printed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from pool_sim_ros.me212 import (
    attitude_to_nearest,
    cue_velocity,
    format_log,
    inches,
    is_report_table,
    nearest_ball,
    published_final_positions,
)
from pool_sim_ros.physics import Table, Trajectory, simulate
from pool_sim_ros.report.errors import ReportError
from pool_sim_ros.simulator import Settings


class ShotError(ReportError):
    """This table cannot play the shot."""


@dataclass(frozen=True, eq=False)
class PlayedShot:
    """One of the report's shots and its outcome.

    Attributes
    ----------
    number : int
        In the report, 1 to 4.
    velocity : tuple of float
        Of the cue ball, m/s.
    trajectory : Trajectory
    printed : dict or None
        The final positions that the report printed, label -> (x, y) in inches; None on any table
        but the report's.
    """

    number: int
    velocity: tuple[float, float]
    trajectory: Trajectory
    printed: dict[str, tuple[float, float]] | None

    @property
    def table(self) -> Table:
        """The table that was played on."""
        return self.trajectory.table

    @property
    def final_positions(self) -> dict[str, tuple[float, float]]:
        """Where each ball stopped, label -> (x, y) in m."""
        places = self.trajectory.final_positions.tolist()
        return {label: tuple(xy) for label, xy in zip(self.table.labels, places, strict=True)}

    @property
    def equal_to_print(self) -> int:
        """The number of balls whose final positions equal the printed ones to the last digit."""
        places = self.final_positions
        return sum(
            (inches(places[label][0]), inches(places[label][1])) == xy
            for label, xy in (self.printed or {}).items()
        )


def play_shots(settings: Settings, numbers: Iterable[int]) -> Iterator[PlayedShot]:
    """Play shots of the report, one after the other.

    Parameters
    ----------
    settings : Settings
        The table, and the integrator and slice for the report's shots.
    numbers : iterable of int
        1 to 4.

    Yields
    ------
    PlayedShot

    Raises
    ------
    ShotError
        If shot 4 has nothing to aim at, if the balls move for longer than
        ``max_shot_duration``, or if the law of friction gives them energy without end.
    """
    table = settings.table
    published = published_final_positions() if is_report_table(table) else {}
    for number in numbers:
        try:
            velocity = cue_velocity(number, table)
            trajectory = simulate(
                table,
                velocity,
                integrator=settings.report_integrator,
                time_slice=settings.time_slice,
                until=settings.max_shot_duration,
            )
        except ValueError as error:
            raise ShotError(f'shot {number}: {error}') from error
        if not trajectory.complete:
            limit = f'max_shot_duration, {settings.max_shot_duration:g} s'
            raise ShotError(f'shot {number}: the balls move for longer than {limit}')
        yield PlayedShot(number, velocity, trajectory, published.get(number))


def verdict(settings: Settings, shots: Sequence[PlayedShot]) -> str:
    """Return one sentence that compares the end positions with the print."""
    printed = sum(len(shot.printed or {}) for shot in shots)
    if not printed:
        return 'The report printed nothing for this table, so there is nothing to compare with.'
    equal = sum(shot.equal_to_print for shot in shots)
    differing = settings.deviations
    why = f'; the print is not of this run ({", ".join(differing)})' if differing else ''
    return f'{equal} of {printed} end positions equal the printed ones to the last digit{why}.'


def log_of(settings: Settings, shots: Iterable[PlayedShot]) -> str:
    """Return the log of a run, in the form of Listing 1."""
    entries = ((shot.number, shot.velocity, shot.final_positions.items()) for shot in shots)
    return format_log(entries, aim(settings.table), log_remark(settings))


def log_remark(settings: Settings) -> str | None:
    """Return the remark in the log of a run that the report did not print; None for its own."""
    differing = settings.deviations
    return f'Not the run that the report printed: {", ".join(differing)}' if differing else None


def aim(table: Table) -> tuple[str, float] | None:
    """Return the target of shot 4 and its direction in rad; None if there is no other ball."""
    if len(table.balls) < 2:
        return None
    return table.labels[nearest_ball(table)], attitude_to_nearest(table)


def moved_balls(trajectory: Trajectory) -> np.ndarray:
    """Return the indices of the balls that moved in a shot, (k,), in order."""
    count = len(trajectory.final_positions)
    return np.flatnonzero([len(trajectory.path(index)) > 1 for index in range(count)])
