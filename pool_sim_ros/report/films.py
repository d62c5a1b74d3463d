"""Films of shots: the times that they show, and their frames."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from pool_sim_ros.report.drawing import TablePicture, empty_figure
from pool_sim_ros.report.played import PlayedShot

RATE = 60
"""Frames per second (Listing 2, line 17)."""

HOLD = 60
"""Still frames at the end of a film: one second (Listing 2, line 113)."""

FILM_SIZE = (1280, 720)
"""Pixels; both even, as yuv420p needs."""


def moving_frames(duration: float) -> int:
    """Return the number of frames from t = 0 to the first one in which all balls rest.

    Frame k shows t = k / `RATE` s.

    Parameters
    ----------
    duration : float
        Time until the last ball rests, s.
    """
    last = math.ceil(duration * RATE)
    # Rounding may put the product on the wrong side of a whole number.
    while last / RATE < duration:
        last += 1
    while last > 0 and (last - 1) / RATE >= duration:
        last -= 1
    return last + 1


def frame_count(duration: float) -> int:
    """Return the number of frames of a shot's film."""
    return moving_frames(duration) + HOLD


def film_frames(shot: PlayedShot, size: tuple[int, int] = FILM_SIZE) -> Iterator[memoryview]:
    """Yield the frames of a shot's film, (height, width, 4) bytes of red, green, blue, alpha.

    Parameters
    ----------
    shot : PlayedShot
    size : tuple of int, optional
        Width and height in pixels.

    Notes
    -----
    All frames share one buffer: use a frame before you ask for the next one.
    """
    width, height = size
    dpi = height / 7.2
    figure = empty_figure(width / dpi, height / dpi)
    figure.set_dpi(dpi)
    picture = TablePicture(shot.table, figure.add_axes((0.01, 0.01, 0.98, 0.91)))
    caption = figure.text(0.02, 0.96, '', fontsize=20, va='center')
    for artist in (*picture.balls, caption):
        artist.set_animated(True)
    canvas: Any = figure.canvas  # matplotlib does not annotate the methods used here
    canvas.draw()
    empty_table = canvas.copy_from_bbox(figure.bbox)
    times = np.arange(moving_frames(shot.trajectory.duration)) / RATE
    for time, positions in zip(times, shot.trajectory.positions(times), strict=True):
        canvas.restore_region(empty_table)
        picture.place(positions)
        caption.set_text(f'Simulation {shot.number}, t = {time:.3f} s')
        for artist in (*picture.balls, caption):
            figure.draw_artist(artist)
        yield canvas.buffer_rgba()
    for _ in range(HOLD):
        yield canvas.buffer_rgba()
