"""What comes of a shot over its angle and its speed: which ball is hit first, where ball 9 ends.

    pip install '.[plot]'  # in the folder of this repository
    python examples/map_of_a_shot.py --side 400 --out map.png

A map of 400 x 400 shots takes a second or two. Away from the first ball that is hit it is smooth;
where a ball is missed by a hair it tears.
"""

import argparse
import time

import numpy as np

from pool_sim_ros.physics import report_table, simulate_many

BALL = '9'
AZIMUTHS, SPEEDS = (160.0, 200.0), (0.5, 5.0)
"""Degrees counterclockwise from +x, and m/s."""


def play(table, side):
    """Return the azimuths and the speeds, (side,), and the outcomes of side * side shots."""
    azimuths, speeds = np.linspace(*AZIMUTHS, side), np.linspace(*SPEEDS, side)
    angle, speed = np.meshgrid(np.radians(azimuths), speeds)
    velocities = np.stack([speed * np.cos(angle), speed * np.sin(angle)], axis=-1)
    return azimuths, speeds, simulate_many(table, velocities.reshape(-1, 2))


def draw(table, outcomes, side, file):
    """Draw both maps into a picture."""
    from matplotlib.colors import ListedColormap
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11, 4.5), layout='constrained')
    left, right = figure.subplots(1, 2, sharey=True)
    extent, colors = (*AZIMUTHS, *SPEEDS), ['0.9', *(ball.color for ball in table.balls[1:])]
    hit = np.maximum(outcomes.first_hit, 0).reshape(side, side)
    style = {'origin': 'lower', 'extent': extent, 'aspect': 'auto', 'interpolation': 'nearest'}
    shown = left.imshow(hit, cmap=ListedColormap(colors), vmin=-0.5, vmax=10.5, **style)
    bar = figure.colorbar(shown, ax=left, ticks=range(len(table.balls)))
    bar.ax.set_yticklabels(['none', *table.labels[1:]])
    left.set(title='the ball that is hit first', xlabel='azimuth (degrees)', ylabel='speed (m/s)')
    ends = outcomes.finals[:, table.index(BALL), 0].reshape(side, side)
    shown = right.imshow(ends, cmap='viridis', **style)
    figure.colorbar(shown, ax=right, label='x (m)')
    right.set(title=f'where ball {BALL} ends', xlabel='azimuth (degrees)')
    figure.savefig(file, dpi=110)


def main():
    """Play, say what was found, and draw it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--side', type=int, default=400, help='shots along each side of the map')
    parser.add_argument('--out', metavar='FILE', help='write the map as a picture')
    given = parser.parse_args()
    table = report_table()
    begin = time.perf_counter()
    azimuths, speeds, outcomes = play(table, given.side)
    print(f'{len(outcomes.finals):,} shots in {time.perf_counter() - begin:.2f} s')
    moved = np.linalg.norm(outcomes.finals - table.positions, axis=2)[:, table.index(BALL)]
    row, column = divmod(int(moved.argmax()), given.side)
    print(
        f'Ball {BALL} goes farthest, {moved.max():.2f} m, '
        f'at {azimuths[column]:.1f} degrees and {speeds[row]:.2f} m/s.'
    )
    if given.out:
        draw(table, outcomes, given.side, given.out)


if __name__ == '__main__':
    main()
