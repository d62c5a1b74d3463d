"""The command `python -m pool_sim_ros.study`: sweeps and their pictures."""

from __future__ import annotations

import argparse
import reprlib
from pathlib import Path
from typing import Any

from pool_sim_ros.console import CommandError, Parser, console_command, path
from pool_sim_ros.physics import Table
from pool_sim_ros.study.errors import SweepError
from pool_sim_ros.study.inputs import known_inputs
from pool_sim_ros.study.ranges import range_of_text
from pool_sim_ros.study.tables import NAMES, table_of

EXAMPLE = """inputs, as NAME=VALUE:
  2.5                          one value
  1,2,4                        these values
  0:360:721                    721 values from 0 to 360
  'uniform(0,360)'             drawn for each shot; also 'normal(2,0.1)', 'normal(0:360:721,0.1)'
names: angle, speed | vx, vy | cue_speed, azimuth, elevation, side, above; wx, wy, wz;
  x_LABEL, y_LABEL (where a ball starts); jitter; coefficients of the table, such as e_ball_ball

example:
  python -m pool_sim_ros.study sweep report map.zarr angle=0:360:721 speed=1:4:61
  python -m pool_sim_ros.study plot map.zarr map.png --what finals --ball 9
"""


@console_command(
    'study',
    SweepError,
    ValueError,
    OSError,
    interrupted='\nstudy: interrupted; the same command goes on from there',
)
def main(args: list[str]) -> None:
    """Sweep, or draw."""
    options = _parser().parse_args(args)
    options.run(options)


def _sweep(options: argparse.Namespace) -> None:
    from pool_sim_ros.study.sweeps import sweep

    table = _table(options.table)
    dataset = sweep(
        table,
        samples=options.samples,
        seed=options.seed,
        out=options.out,
        keep=options.keep,
        balls=options.balls,
        chunk=options.chunk,
        scheduler=options.scheduler,
        workers=options.workers,
        progress=not options.quiet,
        **_inputs(table, options.inputs),
    )
    sizes = {name: size for name, size in dataset.sizes.items() if name not in ('ball', 'axis')}
    shape = ' x '.join(f'{name} {size}' for name, size in sizes.items())
    kept = ', '.join(map(str, dataset.data_vars))
    print(f'{options.out}: {dataset.attrs["shots"]:,} shots ({shape}): {kept}')


def _plot(options: argparse.Namespace) -> None:
    import matplotlib

    matplotlib.use('Agg')
    from pool_sim_ros.study.datasets import open_sweep
    from pool_sim_ros.study.maps import plot
    from pool_sim_ros.study.zooms import zoom

    dataset = open_sweep(options.dataset)
    window: dict[str, Any] = {}
    for text in options.window:
        name, _, ends = text.partition('=')
        try:
            low, high = map(float, ends.split(':'))
        except ValueError:
            raise CommandError(f'--window: {text!r} is not as in angle=10:20') from None
        window[name] = (low, high)
    if window:
        dataset = zoom(dataset, **window)
    axes = plot(dataset, options.what, ball=options.ball, x=options.x, y=options.y)
    figure: Any = axes.figure
    figure.savefig(options.picture, dpi=150)
    print(options.picture)


def _table(text: str) -> Table:
    if text in NAMES:
        return table_of(text)
    if not Path(text).expanduser().is_file():
        raise CommandError(f'table: {text!r} is neither a file nor one of {", ".join(NAMES)}')
    return Table.load(text)


def _inputs(table: Table, texts: list[str]) -> dict[str, Any]:
    known = known_inputs(table)
    found: dict[str, Any] = {}
    for text in texts:
        name, equals, value = text.partition('=')
        if not equals:
            raise CommandError(f'{reprlib.repr(text)} is not NAME=VALUE, as in angle=0:360:721')
        if name in found:
            raise CommandError(f'{name}: it is given twice')
        if name not in known:
            raise CommandError(f'{name}: there is no such input; there are {", ".join(known)}')
        found[name] = range_of_text(name, value)
    return found


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        prog='study',
        description='Sweeps over ranges of inputs, and pictures of them.',
        epilog=EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    commands = parser.add_subparsers(required=True, metavar='sweep | plot')
    add = commands.add_parser(
        'sweep',
        help='play a shot for each combination of the inputs',
        epilog=EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add.set_defaults(run=_sweep)
    add.add_argument('table', help=f'{", ".join(NAMES)}, or a file of Table.save')
    add.add_argument('out', type=path, help='the zarr folder; what it has of this sweep stays')
    add.add_argument('inputs', nargs='+', metavar='NAME=VALUE', help='what is swept; see below')
    add.add_argument('--samples', type=int, help='how often to draw what is random')
    add.add_argument('--seed', type=int, default=0, help='of what is drawn (default: 0)')
    add.add_argument('--keep', nargs='+', help='which outcomes to keep (default: all)')
    add.add_argument('--balls', nargs='+', help='whose ends to keep (default: all)')
    add.add_argument('--chunk', type=int, help='shots that are written together')
    add.add_argument('--scheduler', help='address of a Dask cluster, like tcp://host:8786')
    add.add_argument('--workers', type=int, help='processes here (default: one a core)')
    add.add_argument('--quiet', action='store_true', help='show no progress')
    draw = commands.add_parser('plot', help='draw a sweep over two of its inputs')
    draw.set_defaults(run=_plot)
    draw.add_argument('dataset', type=path, help='the zarr folder')
    draw.add_argument('picture', type=path, help='the file to write, .png or .pdf')
    draw.add_argument(
        '--what', default='finals', help='finals, first_hit, pocketed, durations, ...'
    )
    draw.add_argument('--ball', help='the label of the ball')
    draw.add_argument('--x', help='the input along x')
    draw.add_argument('--y', help='the input along y')
    draw.add_argument(
        '--window', nargs='+', default=[], metavar='NAME=LOW:HIGH', help='sweep this window anew'
    )
    return parser
