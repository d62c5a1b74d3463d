"""Play the same shots with pooltool and with pool_sim_ros where contacts are hard to tell apart.

    python test/benchmark/pooltool_limits.py --pooltool .venv-bench/bin/python

Prints a table; `make bench` creates the environment and writes the table to docs/pooltool.md.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import numpy as np  # noqa: E402
from benchmark.ask_pooltool import Pooltool  # noqa: E402
from benchmark.pooltool_command import run  # noqa: E402
from benchmark.results import FIGURES  # noqa: E402

from pool_sim_ros.physics import Ball, Table, simulate  # noqa: E402

RADIUS = 0.028575
SEEN = 1e-5
"""m: pooltool keeps balls and cushions a micrometre apart; less than some of these is no fault."""


@dataclass(frozen=True)
class Case:
    """A shot, and whether the mirror image about y = 0.5 m is the same shot."""

    what: str
    positions: Sequence[tuple[float, float]]
    velocities: Sequence[tuple[float, float]]
    restitution: float = 0.95
    symmetric: bool = False

    def table(self) -> Table:
        balls = [
            Ball(str(k), 0.17, RADIUS, position, is_cue=k == 0)
            for k, position in enumerate(self.positions)
        ]
        return Table(
            length=2.0,
            width=1.0,
            balls=balls,
            mu_ball_ball=0.05,
            mu_ball_surface=0.2,
            mu_ball_cushion=0.2,
            e_cue_ball=self.restitution,
            e_ball_ball=self.restitution,
            e_ball_cushion=0.85,
            gravity=9.81,
            ball_friction='coulomb',
        )


def cases() -> list[Case]:
    """Return the shots; those that pooltool plays well stand beside those that it does not."""
    aside = (1.5, 0.5)
    rest = (0.0, 0.0)
    in_line = [(0.5, 0.5), (0.8, 0.5), (0.8 + 2 * RADIUS, 0.5)]
    abreast = [(0.5, 0.5), (0.8, 0.5 + RADIUS), (0.8, 0.5 - RADIUS)]
    at_rail = 'a ball on a cushion, gap {}, shot into it, 1 m/s'
    struck = 'a ball on a cushion, gap {}, struck squarely, 2 m/s'
    return [
        Case(at_rail.format('0'), [(RADIUS, 0.5), aside], [(-1, 0), rest]),
        Case(at_rail.format('1e-9 m'), [(RADIUS + 1e-9, 0.5), aside], [(-1, 0), rest]),
        Case(struck.format('0'), [(0.5, 0.5), (RADIUS, 0.5)], [(-2, 0), rest]),
        Case(struck.format('1e-6 m'), [(0.5, 0.5), (RADIUS + 1e-6, 0.5)], [(-2, 0), rest]),
        Case('a ball shot into a corner at 45 degrees, 2.8 m/s', [(0.5, 0.5), aside],
             [(-2, -2), rest]),
        Case('two balls 0.5 m apart, both at (1, 0) m/s', [(0.5, 0.3), (0.8, 0.7)],
             [(1, 0), (1, 0)]),
        Case('the same, one of them at (1, 0.01) m/s', [(0.5, 0.3), (0.8, 0.7)],
             [(1, 0), (1, 0.01)]),
        *(
            Case(f'a ball into two that touch, all in line, e = {e:g}, 1 m/s', in_line,
                 [(1, 0), rest, rest], e)
            for e in (0.95, 0.5, 0.1)
        ),
        *(
            Case(f'a ball at the middle of two that touch, e = {e:g}, 2 m/s', abreast,
                 [(2, 0), rest, rest], e, symmetric=True)
            for e in (0.95, 0.5, 0.1)
        ),
    ]  # fmt: skip


def compared(pooltool: Pooltool) -> str:
    """Return the table, in Markdown."""
    version = pooltool.versions()['pooltool']
    lines = ['', f'| shot | pooltool {version} | pool_sim_ros |', '| --- | --- | --- |']
    for case in cases():
        lines.append(f'| {case.what} | {played_by_pooltool(case, pooltool)} | {played(case)} |')
    return '\n'.join([*lines, ''])


def played_by_pooltool(case: Case, pooltool: Pooltool) -> str:
    [shot] = pooltool.play(case.table(), [case.velocities])['shots']
    if shot['error']:
        return f'stops: `{shot["error"]}`'
    contacts = sum(shot['kinds'].get(kind, 0) for kind in ('ball_ball', 'ball_linear_cushion'))
    return told(case, contacts, np.array(shot['positions']))


def played(case: Case) -> str:
    shot = simulate(case.table(), case.velocities)
    return told(case, int(np.sum(shot.events['kind'] != 2)), shot.final_positions)


def told(case: Case, contacts: int, positions: np.ndarray) -> str:
    """Say what is to be seen at the end of a shot."""
    size = np.array([2.0, 1.0])
    outside = max(np.max(RADIUS - positions), np.max(positions + RADIUS - size))
    words = [f'{contacts} contact{"" if contacts == 1 else "s"}']
    if outside > SEEN:
        words.append(f'a ball ends {outside:.2f} m outside')
    if case.symmetric:
        mirrored = [0.0, 1.0] + positions[[0, 2, 1]] * [1.0, -1.0]
        off = np.max(np.abs(positions - mirrored))
        words.append(f'{off:.2f} m from symmetric' if off > SEEN else 'symmetric')
    return ', '.join(words)


if __name__ == '__main__':
    sys.exit(run(__doc__.partition('\n\n')[0], compared, FIGURES))
