"""Play the same shots of balls that spin with pooltool and with pool_sim_ros, and compare them.

    python test/benchmark/pooltool_results.py --pooltool .venv-bench/bin/python

Prints a table; `make bench` creates the environment and writes the table to docs/pooltool.md.
"""

from __future__ import annotations

import dataclasses
import statistics
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import numpy as np  # noqa: E402
from benchmark.ask_pooltool import Pooltool, Shots  # noqa: E402
from benchmark.pooltool_command import run  # noqa: E402
from benchmark.results import PLAYED, significant  # noqa: E402
from benchmark.spaced import Contact, Played, PushedInError, play, play_spaced  # noqa: E402
from benchmark.spin_workloads import (  # noqa: E402
    FIFTEEN,
    NINE,
    TEN,
    TEN_WITH_POCKETS,
    shots_of,
    table_of,
)

from pool_sim_ros.physics import Table  # noqa: E402

BALL_BALL, CUSHION, POCKETED = 0, 1, 3

Player = Callable[..., Played]


@dataclass(frozen=True)
class Case:
    """Shots of a workload with the models of these names."""

    name: str
    ball_friction: str
    cushion_model: str
    shots: int

    @property
    def table(self) -> Table:
        return dataclasses.replace(
            table_of(self.name),
            ball_friction=self.ball_friction,
            cushion_model=self.cushion_model,
        )

    @property
    def what(self) -> str:
        return f'{self.name}; `{self.ball_friction}`, `{self.cushion_model}`'


CASES = (
    Case(TEN, 'coulomb', 'han', 100),
    Case(TEN, 'coulomb', 'impulse', 100),
    Case(TEN, 'alciatore', 'stronge', 100),
    Case(TEN, 'alciatore', 'mathavan', 40),
    Case(TEN_WITH_POCKETS, 'coulomb', 'han', 100),
    Case(TEN_WITH_POCKETS, 'coulomb', 'impulse', 100),
    Case(TEN_WITH_POCKETS, 'alciatore', 'stronge', 100),
    Case(NINE, 'alciatore', 'stronge', 40),
    Case(FIFTEEN, 'alciatore', 'stronge', 30),
)


@dataclass
class Agreement:
    """How many of the shots agree, and how far apart they end (m) where the contacts are equal."""

    shots: int = 0
    contacts: int = 0
    pocketed: int = 0
    apart: list[float] = field(default_factory=list)
    unlike: list[int] = field(default_factory=list)
    pushed_in: int = 0

    def add(self, number: int, ours: Played | None, theirs: Played) -> None:
        self.shots += 1
        if ours is None:
            self.pushed_in += 1
            return
        self.pocketed += _pocketed(ours) == _pocketed(theirs)
        if _sides(ours) == _sides(theirs):
            self.contacts += 1
            self.apart.append(float(np.max(np.abs(ours.final - theirs.final))))
        else:
            self.unlike.append(number)


def _sides(played: Played) -> list[tuple[int, int, int]]:
    return [contact[1:] for contact in played.contacts]


def _pocketed(played: Played) -> list[tuple[int, int]]:
    return [(c.a, c.b) for c in played.contacts if c.kind == POCKETED]


def compare(
    pooltool: Pooltool, case: Case, players: tuple[Player, ...], most: int | None = None
) -> list[Agreement]:
    """Return for each way to play how its shots, `most` at most, agree with pooltool's."""
    shots = shots_of(case.name, min(case.shots, most or case.shots))
    theirs = played_by_pooltool(pooltool, case.table, shots)
    found = []
    for player in players:
        agreement = Agreement()
        for number, (shot, other) in enumerate(zip(zip(*shots, strict=True), theirs, strict=True)):
            try:
                ours = player(case.table, *shot)
            except PushedInError:
                ours = None
            agreement.add(number, ours, other)
        found.append(agreement)
    return found


def played_by_pooltool(pooltool: Pooltool, table: Table, shots: Shots) -> list[Played]:
    """Return pooltool's shots, with our numbers of cushions and pockets.

    Raises
    ------
    RuntimeError
        Where pooltool raised an error.
    """
    found = []
    for shot in pooltool.play_balls(table, shots)['shots']:
        if shot['error']:
            raise RuntimeError(f'pooltool: {shot["error"]}')
        contacts = [
            Contact(t, kind, a, b if kind == BALL_BALL else nearest(table, kind, place))
            for t, kind, a, b, place in shot['contacts']
        ]
        found.append(Played(contacts, np.array(shot['positions'])))
    return found


def nearest(table: Table, kind: int, place: tuple[float, float]) -> int:
    """Return our number of the cushion or pocket that lies at `place`."""
    if kind == POCKETED:
        places = table.pockets[:, :2]
    elif table.cushions is None:
        length, width = table.length, table.width
        places = np.array(
            [(0.0, width / 2), (length, width / 2), (length / 2, 0.0), (length / 2, width)]
        )
    else:
        segments, noses = table.cushions.segments, table.cushions.noses
        middles = (segments[:, :2] + segments[:, 2:4]) / 2.0
        places = np.concatenate([middles, noses[:, :2]])
    return int(np.argmin(np.hypot(*(places - place).T)))


def compared(pooltool: Pooltool) -> str:
    """Return the table, in Markdown."""
    version = pooltool.versions()['pooltool']
    lines = [
        '',
        f'| shots; laws | as pooltool {version} spaces balls: contacts | pocketed | apart, m '
        '| nothing imitated: contacts | pocketed | apart, m: median, most |',
        '| --- | ---: | ---: | ---: | ---: | ---: | ---: |',
    ]
    for case in CASES:
        spaced, plain = compare(pooltool, case, (play_spaced, play))
        cells = [case.what, *counts(spaced), at_most(spaced), *counts(plain), middle_most(plain)]
        lines.append(f'| {" | ".join(cells)} |')
        if spaced.unlike:
            print(
                f'{case.what}: unlike with the spacing are shots {spaced.unlike}', file=sys.stderr
            )
    return '\n'.join([*lines, ''])


def counts(found: Agreement) -> list[str]:
    pushed = f', {found.pushed_in} pushed into a third' if found.pushed_in else ''
    return [f'{found.contacts} of {found.shots}{pushed}', f'{found.pocketed} of {found.shots}']


def at_most(found: Agreement) -> str:
    return f'{max(found.apart, default=0.0):.0e}'


def middle_most(found: Agreement) -> str:
    if not found.apart:
        return ''
    return f'{statistics.median(found.apart):.0e}, {significant(max(found.apart), 1)}'


if __name__ == '__main__':
    sys.exit(run(__doc__.partition('\n\n')[0], compared, PLAYED))
