"""Decodes films with the ffmpeg that made them, and finds balls in their frames by colour."""

import re
import subprocess

import imageio_ffmpeg  # noqa: F401 - without it there are no films
import numpy as np

from pool_sim_ros.report.drawing import CLOTH
from pool_sim_ros.report.encoder import find_ffmpeg

PLAIN_BALLS = ('1', '3', '4', '5', '6', '9')
"""Those whose colours nothing else in a frame has, neither labels nor lines."""


def describe(path):
    """Return what ffmpeg says of a film's stream of pictures."""
    done = subprocess.run(
        [find_ffmpeg(), '-hide_banner', '-i', path], capture_output=True, text=True, timeout=60
    )
    return re.search(r'Stream #0:0.*', done.stderr)[0]


def frame_times(path):
    """Return the time of each frame in units of 1/60 s."""
    rows = _ffmpeg('-i', path, '-f', 'framecrc', '-').decode()
    base = re.search(r'#tb 0: (\d+)/(\d+)', rows)
    stamps = [int(line.split(',')[2]) for line in rows.splitlines() if not line.startswith('#')]
    return [stamp * 60 * int(base[1]) / int(base[2]) for stamp in stamps]


def frames(path, size):
    """Return all frames, (k, height, width, 3)."""
    width, height = size
    data = _ffmpeg('-i', path, '-f', 'rawvideo', '-pix_fmt', 'rgb24', '-')
    return np.frombuffer(data, np.uint8).reshape(-1, height, width, 3)


def ball_positions(frame, table, labels=PLAIN_BALLS):
    """Return where balls are in a frame, label -> (x, y) in m; the cloth gives the scale."""
    to_metres = _scale(frame, table)
    balls = {ball.label: ball for ball in table.balls}
    return {label: to_metres(_centroid(frame, balls[label].color)) for label in labels}


def color_at(frame, table, position, color):
    """Return whether the pixels at a position in m have a colour."""
    to_metres = _scale(frame, table)
    rows, columns = np.mgrid[: frame.shape[0], : frame.shape[1]]
    x, y = to_metres((columns, rows))
    near = np.hypot(x - position[0], y - position[1]) < 0.012
    return bool(np.all(_distance(frame[near], color) < 60))


def _scale(frame, table):
    # The edge of the table is the middle of the black line around it.
    cloth, drawn = _distance(frame, CLOTH) < 12, _distance(frame, (1.0, 1.0, 1.0)) > 40
    left, right, top, bottom = (_box(cloth) + _box(drawn)) / 2

    def to_metres(pixel):
        x = (pixel[0] + 0.5 - left) / (right - left) * table.length
        y = (bottom - pixel[1] - 0.5) / (bottom - top) * table.width
        return x, y

    return to_metres


def _box(inside):
    """The rectangle of rows and columns that are for the most part inside."""
    columns = np.flatnonzero(inside.sum(axis=0) > inside.shape[0] / 3)
    rows = np.flatnonzero(inside.sum(axis=1) > inside.shape[1] / 3)
    return np.array([columns[0], columns[-1] + 1, rows[0], rows[-1] + 1])


def _centroid(frame, color):
    rows, columns = np.nonzero(_distance(frame, color) < 45)
    assert len(rows) > 50, f'no ball of colour {color}'
    # The edges of other balls and labels may by chance blend into this colour: a few stray pixels.
    near = np.hypot(columns - np.median(columns), rows - np.median(rows)) < frame.shape[1] / 20
    return columns[near].mean(), rows[near].mean()


def _distance(pixels, color):
    return np.linalg.norm(pixels.astype(float) - 255 * np.array(color), axis=-1)


def _ffmpeg(*arguments):
    command = [find_ffmpeg(), '-loglevel', 'error', *arguments]
    return subprocess.run(command, stdout=subprocess.PIPE, check=True, timeout=60).stdout
