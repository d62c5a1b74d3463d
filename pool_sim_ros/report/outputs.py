"""Write the report's pictures and films into one folder."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path

from matplotlib.figure import Figure

from pool_sim_ros.physics import Table
from pool_sim_ros.report.collision_drawing import draw_construction, draw_setup
from pool_sim_ros.report.drawing import TablePicture, save_figure
from pool_sim_ros.report.encoder import encode, join
from pool_sim_ros.report.files import whole_file
from pool_sim_ros.report.films import FILM_SIZE, RATE, film_frames
from pool_sim_ros.report.part_one import example
from pool_sim_ros.report.paths import draw_paths
from pool_sim_ros.report.played import PlayedShot

COMBINED_FILM = 'videos/combinedCollisions.mp4'


def picture_count(shots: Sequence[PlayedShot]) -> int:
    """Return the number of pictures that `write_pictures` writes."""
    return 3 + 2 * len(shots)


def write_pictures(
    folder: Path, table: Table, shots: Iterable[PlayedShot]
) -> Iterator[tuple[str, bytes]]:
    """Write all pictures as PNG at 600 dpi.

    Yields
    ------
    path : str
        Path of the file, relative to `folder`.
    picture : bytes
        The same picture as SVG.
    """
    for path, figure in _figures(table, shots):
        with whole_file(folder / path) as part:
            save_figure(figure, str(part), 'png')
        vectors = io.BytesIO()
        save_figure(figure, vectors, 'svg')
        yield path, vectors.getvalue()


def write_film(
    folder: Path,
    shot: PlayedShot,
    size: tuple[int, int] = FILM_SIZE,
    on_frame: Callable[[], object] = lambda: None,
) -> str:
    """Write the film of one shot.

    Parameters
    ----------
    folder : Path
    shot : PlayedShot
    size : tuple of int, optional
        Width and height in pixels.
    on_frame : callable, optional
        Called for each frame.

    Returns
    -------
    str
        Path of the film, relative to `folder`.
    """

    def frames() -> Iterator[memoryview]:
        for frame in film_frames(shot, size):
            on_frame()
            yield frame

    path = f'videos/collision_{shot.number}.mp4'
    with whole_file(folder / path) as part:
        encode(frames(), size, RATE, part)
    return path


def join_films(folder: Path, films: Iterable[str]) -> str:
    """Join films in order into one film.

    Parameters
    ----------
    folder : Path
    films : iterable of str
        Their paths, relative to `folder`.

    Returns
    -------
    str
        Path of the combined film, relative to `folder`.
    """
    with whole_file(folder / COMBINED_FILM) as part:
        join((folder / film for film in films), part)
    return COMBINED_FILM


def _figures(table: Table, shots: Iterable[PlayedShot]) -> Iterator[tuple[str, Figure]]:
    collision = example(table)
    yield 'images/Part_1_setup.png', draw_setup(collision)
    yield 'images/Part_1_construction.png', draw_construction(collision)
    yield 'images/Table_layout.png', TablePicture(table).figure
    for shot in shots:
        picture = TablePicture(table)
        yield f'images/Simulation_{shot.number}_start.png', picture.figure
        picture.place(shot.trajectory.final_positions)
        draw_paths(picture.axes, shot.trajectory)
        yield f'images/Simulation_{shot.number}_end.png', picture.figure
