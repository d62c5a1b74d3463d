"""The report's log (Listing 1), character for character, and the positions that it printed."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable, Sequence
from importlib import resources

from pool_sim_ros.physics import INCH


def format_aim(label: str, attitude: float) -> str:
    """Return the head of the log: the ball at which shot 4 is aimed.

    Parameters
    ----------
    label : str
        Of that ball.
    attitude : float
        Direction from the cue ball to it, rad.
    """
    return (
        f'Closest ball to Cue ball: Ball {label:>2}\n'
        f'Attitude to closest ball: {math.degrees(attitude):7.3f} deg\n'
    )


def format_shot_head(shot: int | None, velocity: Sequence[float]) -> str:
    """Return the two lines above the final positions of a shot.

    Parameters
    ----------
    shot : int or None
        Its number in the report; None for any other strike.
    velocity : sequence of 2 floats
        Of the cue ball, m/s.
    """
    name = 'Simulation' if shot is None else f'Simulation {shot}'
    return (
        f'{name}: Cue velocity = [{velocity[0]:6.3f}, {velocity[1]:6.3f}] (m/s)\n'
        '    Final Ball positions [X,Y]:\n'
    )


def format_position(label: str, position: Sequence[float]) -> str:
    """Return the line of one ball, without a newline.

    Parameters
    ----------
    label : str
        Of the ball.
    position : sequence of 2 floats
        x and y, m.
    """
    x, y = (coordinate / INCH for coordinate in position)
    return f'        Ball {label:>2}: [{x:5.2f}, {y:5.2f}] (in)'


def format_shot(
    shot: int | None,
    velocity: Sequence[float],
    positions: Iterable[tuple[str, Sequence[float]]],
) -> str:
    """Return the lines of one shot.

    Parameters
    ----------
    shot, velocity
        As in `format_shot_head`.
    positions : iterable of (label, (x, y))
        Final position of each ball, m.
    """
    lines = [format_position(label, position) + '\n' for label, position in positions]
    return format_shot_head(shot, velocity) + ''.join(lines)


def format_log(
    shots: Iterable[tuple[int, Sequence[float], Iterable[tuple[str, Sequence[float]]]]],
    aim: tuple[str, float] | None,
    remark: str | None = None,
) -> str:
    """Return the whole log.

    Parameters
    ----------
    shots : iterable of (shot, velocity, positions)
        Each as in `format_shot`.
    aim : (str, float) or None
        As in `format_aim`; None where the cue ball is alone.
    remark : str, optional
        A line at the top; the report's log has none.
    """
    parts = [remark + '\n'] if remark else []
    if aim:
        parts.append(format_aim(*aim))
    return ''.join(part + '\n' for part in (*parts, *(format_shot(*shot) for shot in shots)))


def inches(coordinate: float) -> float:
    """Return a length in inches with two decimals, rounded as in the log.

    Parameters
    ----------
    coordinate : float
        m.
    """
    return float(f'{coordinate / INCH:.2f}')


def published_final_positions() -> dict[int, dict[str, tuple[float, float]]]:
    """Return the final positions that the report printed.

    Returns
    -------
    dict
        Shot -> label -> (x, y), inches to two decimals.
    """
    text = resources.files(__package__).joinpath('published_final_positions.csv').read_text('utf-8')
    shots: dict[int, dict[str, tuple[float, float]]] = {}
    for row in csv.DictReader(text.splitlines()):
        position = float(row['x_in']), float(row['y_in'])
        shots.setdefault(int(row['shot']), {})[row['ball']] = position
    return shots
