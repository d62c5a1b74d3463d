"""Where the balls start and stop, as comma-separated values."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable

from pool_sim_ros.physics import INCH
from pool_sim_ros.report.played import PlayedShot

COLUMNS = (
    'shot',
    'ball',
    'start_x_in',
    'start_y_in',
    'end_x_in',
    'end_y_in',
    'start_x_m',
    'start_y_m',
    'end_x_m',
    'end_y_m',
)


def format_positions(shots: Iterable[PlayedShot]) -> str:
    """Return one row for each ball of each shot: inches as in the log, metres with all digits."""
    file = io.StringIO()
    writer = csv.writer(file, lineterminator='\n')
    writer.writerow(COLUMNS)
    for shot in shots:
        for ball in shot.table.balls:
            places = (*ball.position, *shot.final_positions[ball.label])
            in_inches = [f'{place / INCH:.2f}' for place in places]
            writer.writerow([shot.number, ball.label, *in_inches, *map(repr, places)])
    return file.getvalue()
