"""The command `report`: it computes the report's outputs anew and writes them to a folder."""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Iterator
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from pool_sim_ros.console import Parser, console_command, missing_line, path
from pool_sim_ros.me212 import SHOT_NUMBERS
from pool_sim_ros.physics import INTEGRATORS
from pool_sim_ros.report.errors import ReportError
from pool_sim_ros.report.interrupts import Interrupts

if TYPE_CHECKING:
    from tqdm import tqdm

    from pool_sim_ros.report.played import PlayedShot
    from pool_sim_ros.simulator import Settings

T = TypeVar('T')


@console_command(
    'report',
    ReportError,
    interrupted='\nreport: interrupted; the files that are there are whole',
)
def main(args: list[str]) -> None:
    """Make the report."""
    options = _parser().parse_args(args)
    with Interrupts() as interrupts:
        _check_packages(options)
        _make(options, interrupts)


def _make(options: argparse.Namespace, interrupts: Interrupts) -> None:
    from pool_sim_ros.report.files import write_text
    from pool_sim_ros.report.played import log_of, play_shots, verdict
    from pool_sim_ros.report.positions import format_positions

    out, settings = options.out, _settings(options)
    shots = list(_checking(play_shots(settings, sorted(set(options.shots))), interrupts))
    write_text(out / 'output.log', log_of(settings, shots))
    print(verdict(settings, shots))
    files = ['output.log']
    if not options.log_only:
        write_text(out / 'positions.csv', format_positions(shots))
        files += ['positions.csv', *_draw(options, settings, shots, interrupts)]
    print(f'{out}: {", ".join(files)}')


def _draw(
    options: argparse.Namespace,
    settings: Settings,
    shots: list[PlayedShot],
    interrupts: Interrupts,
) -> list[str]:
    """Write pictures, films and page; return what the last line of output names."""
    import matplotlib

    from pool_sim_ros.report import outputs, page
    from pool_sim_ros.report.comparison import compare
    from pool_sim_ros.report.files import write_text
    from pool_sim_ros.report.played import log_of

    # The user's own style must not change the pictures.
    matplotlib.rcdefaults()
    out, table = options.out, settings.table
    drawing = outputs.write_pictures(out, table, shots)
    drawing = _bar(drawing, outputs.picture_count(shots), 'Pictures')
    pictures = dict(_checking(drawing, interrupts))
    made, files = [f'{len(pictures)} pictures in images'], ['output.log', 'positions.csv']
    films = _films(out, shots, interrupts) if options.videos else {}
    if films:
        files.append(outputs.join_films(out, films.values()))
        made.append(f'{len(films) + 1} films in videos')
    comparisons = [
        compare(table, shot.number, shot.printed)
        for shot in _checking(_bar(shots, len(shots), 'Comparison'), interrupts)
        if shot.printed
    ]
    log = log_of(settings, shots)
    content = page.Content(settings, shots, comparisons, pictures, films, files, log)
    write_text(out / 'report.html', page.make_page(content))
    return [*made, 'report.html']


def _films(out: Path, shots: list[PlayedShot], interrupts: Interrupts) -> dict[int, str]:
    """Make a film of each shot; return number of the shot -> path of its film in `out`."""
    from pool_sim_ros.report.films import frame_count
    from pool_sim_ros.report.outputs import write_film

    total = sum(frame_count(shot.trajectory.duration) for shot in shots)
    with _bar(None, total, 'Films', unit='frame') as bar:

        def on_frame() -> None:
            interrupts.check()
            bar.update()

        return {shot.number: write_film(out, shot, on_frame=on_frame) for shot in shots}


def _bar(steps: Iterable[T] | None, total: int, title: str, unit: str = 'it') -> tqdm[T]:
    """Return a progress bar, which only a terminal shows."""
    from tqdm import tqdm

    return tqdm(steps, title, total, unit=unit, disable=None)


def _checking(steps: Iterable[T], interrupts: Interrupts) -> Iterator[T]:
    """Yield what `steps` yields, until an interrupt."""
    interrupts.check()
    for step in steps:
        interrupts.check()
        yield step


def _settings(options: argparse.Namespace) -> Settings:
    from pool_sim_ros.report.table_file import read_settings
    from pool_sim_ros.simulator import build_settings, default_values

    settings = read_settings(options.table) if options.table else build_settings(default_values())
    if options.integrator:
        settings = replace(settings, report_integrator=options.integrator)
    return settings


def _check_packages(options: argparse.Namespace) -> None:
    """Raise ReportError before the work begins if a package that it needs is missing."""
    needed = ['yaml'] if options.table else []
    if not options.log_only:
        needed += ['latex2mathml', 'matplotlib', 'tqdm']
        if options.videos:
            needed.append('imageio_ffmpeg')
    missing = [module for module in needed if find_spec(module) is None]
    if missing:
        raise ReportError(missing_line(missing))


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        prog='report',
        description='Compute the four shots of the ME 212 Billiards Project Report and write its '
        'outputs: the log, the end positions, pictures and films of the shots, and one page, '
        'report.html, with the equations, the results and their accuracy.',
        epilog='Needs no ROS, but for the page: '
        'pip install matplotlib tqdm pyyaml latex2mathml imageio-ffmpeg',
    )
    parser.add_argument(
        '--out',
        type=path,
        default=Path('report'),
        metavar='FOLDER',
        help='where to write; files of the same names are replaced (default: ./%(default)s)',
    )
    parser.add_argument(
        '--shots',
        type=int,
        nargs='+',
        choices=SHOT_NUMBERS,
        default=SHOT_NUMBERS,
        metavar='N',
        help='only these of the shots 1 to 4',
    )
    parser.add_argument(
        '--integrator',
        choices=INTEGRATORS,
        help="time_slice: the report's, which ends where it printed; event: the exact one "
        "(default: the table file's report_integrator, or time_slice)",
    )
    parser.add_argument(
        '--table',
        type=path,
        metavar='FILE',
        help='play on another table: a parameter file of sim_node, like config/report.yaml',
    )
    parser.add_argument(
        '--no-videos', dest='videos', action='store_false', help='make no films, which take longest'
    )
    parser.add_argument('--log-only', action='store_true', help='write output.log and nothing else')
    return parser
