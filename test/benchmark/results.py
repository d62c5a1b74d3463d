"""The figures of a benchmark run, and the table made of them."""

from __future__ import annotations

import datetime
import platform
import statistics
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from importlib.metadata import version
from pathlib import Path

from pool_sim_ros.physics.cores import available_cores

FIGURES = '<!-- figures: begin -->', '<!-- figures: end -->'
"""What the table stands between in the file that it is written to."""

PLAYED = '<!-- played: begin -->', '<!-- played: end -->'
"""The same of the shots that are played with pooltool too."""

SECTIONS = (
    "The report's four shots, one core",
    "Random shots on the report's table",
    "Planners' calls on the report's table, one core",
    'Many balls, everything moving, one core',
    'Balls that spin, one core',
    'Environments, one core',
    'Sweeps, two workers',
    'Memory',
    'Starting',
)
"""The first sections of the table, in order; others follow as they were measured."""


@dataclass(frozen=True)
class Row:
    """One line of the table; `spread` is how wide the middle half of the times is."""

    what: str
    median: str
    spread: str = ''
    target: str = ''


@dataclass
class Results:
    """All figures of a run; `medians` (s) has those that others are compared with, by key."""

    rows: dict[str, list[Row]] = field(default_factory=dict)
    medians: dict[str, float] = field(default_factory=dict)
    versions: dict[str, str] = field(default_factory=dict)

    def note(self, section: str, what: str, value: str, target: str = '') -> None:
        """Add a line with a single figure."""
        self._add(section, Row(what, value, '', target))

    def add(
        self,
        section: str,
        what: str,
        seconds: Sequence[float],
        show: Callable[[float], str] | None = None,
        target: str = '',
        key: str = '',
    ) -> None:
        """Add a line with the median of some times.

        Parameters
        ----------
        section, what, target : str
            Where the line stands and what it says.
        seconds : sequence of float
            One time per round.
        show : callable, optional
            Makes text of a time; gives the time with its unit where left out.
        key : str, optional
            A name under which `ratio` finds the median.
        """
        show = show or as_time
        median = statistics.median(seconds)
        self.medians[key or what] = median
        spread = ''
        if len(seconds) > 3:
            low, _, high = statistics.quantiles(seconds, n=4, method='inclusive')
            spread = f'{100 * (high - low) / median:.0f} %'
        self._add(section, Row(what, show(median), spread, target))

    def ratio(self, section: str, what: str, slow: str, fast: str, target: str = '') -> None:
        """Add a line with how many times longer `slow` took than `fast`, both keys."""
        value = 'not measured'
        if slow in self.medians and fast in self.medians:
            value = f'{significant(self.medians[slow] / self.medians[fast], 3)} times'
        self._add(section, Row(what, value, '', target))

    def _add(self, section: str, row: Row) -> None:
        self.rows.setdefault(section, []).append(row)

    def markdown(self) -> str:
        """Return the table, with the machine and the versions over it."""
        lines = ['', f'{datetime.date.today()}, {machine()}; {self._all_versions()}.', '']
        for section in sorted(self.rows, key=section_order):
            lines += [f'### {section}', '', '| what | median | spread | target |']
            lines += ['| --- | ---: | ---: | ---: |']
            rows = self.rows[section]
            lines += [f'| {r.what} | {r.median} | {r.spread} | {r.target} |' for r in rows]
            lines += ['']
        return '\n'.join(lines)

    def _all_versions(self) -> str:
        ours = {name: version(name) for name in ('numpy', 'numba')}
        every = {'Python': platform.python_version(), **ours, **self.versions}
        return ', '.join(f'{name} {number}' for name, number in every.items())


def section_order(section: str) -> int:
    return SECTIONS.index(section) if section in SECTIONS else len(SECTIONS)


def write_between_marks(file: Path, table: str, marks: tuple[str, str] = FIGURES) -> None:
    """Put the table between the marks in `file`; raise ValueError where they are missing."""
    head, tail = around_marks(file, marks)
    file.write_text(f'{head}{marks[0]}\n{table}\n{marks[1]}{tail}')


def around_marks(file: Path, marks: tuple[str, str] = FIGURES) -> tuple[str, str]:
    """Return what stands before and after the marks; raise ValueError where they are missing."""
    head, begin, rest = file.read_text().partition(marks[0])
    _, end, tail = rest.partition(marks[1])
    if not begin or not end:
        raise ValueError(f'{file}: must contain the lines {marks[0]} and {marks[1]}')
    return head, tail


def machine() -> str:
    """Return the processor and how many cores may be used."""
    model = platform.processor() or platform.machine()
    told = Path('/proc/cpuinfo')  # of Linux
    for line in told.read_text().splitlines() if told.exists() else ():
        if line.startswith('model name'):
            model = line.partition(':')[2].strip()
            break
    cores = available_cores()
    return f'{model}, {cores} core{"s" if cores > 1 else ""}, {platform.system()}'


def significant(value: float, digits: int) -> str:
    """Return a number with so many significant digits, written out, thousands apart."""
    if value == 0.0:
        return '0'
    places = digits - 1 - int(f'{value:e}'.partition('e')[2])
    return f'{round(value, places):,.{max(places, 0)}f}'


def as_time(seconds: float) -> str:
    """Return a time in the unit that suits it."""
    for unit, size in (('s', 1.0), ('ms', 1e-3), ('us', 1e-6)):
        if seconds >= size:
            return f'{significant(seconds / size, 3)} {unit}'
    return f'{significant(seconds / 1e-9, 3)} ns'


def per_second(count: float, of: str) -> Callable[[float], str]:
    """Return what makes a rate of the seconds that `count` things took."""
    return lambda seconds: f'{significant(count / seconds, 3)} {of}/s'


def each(count: float) -> Callable[[float], str]:
    """Return what makes the time of one thing of the seconds that `count` things took."""
    return lambda seconds: as_time(seconds / count)
