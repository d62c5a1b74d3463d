"""The section of the page that compares the print, time slicing and the exact result."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import count

import numpy as np

from pool_sim_ros.me212 import nearest_ball
from pool_sim_ros.physics import EventKind, Table
from pool_sim_ros.report.comparison import (
    SLICES,
    STATED_E_CUE_BALL,
    Comparison,
    final_inches,
    greatest_difference,
)
from pool_sim_ros.report.markup import (
    Cell,
    Html,
    ball_name,
    fill,
    join,
    number,
    pair,
    short,
    table,
)
from pool_sim_ros.report.played import moved_balls

REPORT_SLICE = SLICES[-1]


def comparison_section(given: Table, comparisons: Sequence[Comparison]) -> Html:
    """Return the section as HTML; without comparisons it says why there are none.

    Parameters
    ----------
    given : Table
        The report's table.
    comparisons : sequence of Comparison
        One for each shot, or none.
    """
    if not comparisons:
        return fill('no_comparison.html')
    by_number = {comparison.number: comparison for comparison in comparisons}
    parts = [_exact(given, comparisons)]
    sections = (f'4.{i}' for i in count(3))
    if 1 in by_number:
        parts.append(_slicing_error(next(sections), given, by_number[1]))
    if 4 in by_number:
        parts.append(_rounding_branch(next(sections), given, by_number[4]))
    parts.append(_listing(next(sections), given, comparisons))
    return join(parts, '\n')


def _exact(given: Table, comparisons: Sequence[Comparison]) -> Html:
    ends = [np.round(final_inches(comparison.exact), 2) for comparison in comparisons]
    equal = [
        np.all(np.isclose(end, comparison.printed, rtol=0.0, atol=1e-6), axis=1)
        for end, comparison in zip(ends, comparisons, strict=True)
    ]
    rows = [
        [
            ball_name(ball),
            *(
                Cell(pair(end[index], 2), '' if same[index] else 'off')
                for end, same in zip(ends, equal, strict=True)
            ),
        ]
        for index, ball in enumerate(given.balls)
    ]
    convergence = [
        [
            f'{comparison.number}',
            *(
                _greatest(given, final_inches(trajectory), final_inches(comparison.exact))
                for trajectory in comparison.sliced.values()
            ),
        ]
        for comparison in comparisons
    ]
    return fill(
        'comparison.html',
        exact_equal=int(np.sum(equal)),
        exact_total=np.size(equal),
        exact_positions=table(
            ['Ball', *(f'Shot {comparison.number}' for comparison in comparisons)],
            rows,
            'Exact end positions [x, y], inches.',
        ),
        convergence=table(
            ['Shot', *(Cell(f'{short(time_slice)} s') for time_slice in SLICES)],
            convergence,
            'Greatest difference from the exact result (and its ball), inches, by slice.',
        ),
    )


def _slicing_error(section: str, given: Table, comparison: Comparison) -> Html:
    sliced = comparison.sliced[REPORT_SLICE]
    error, ball = greatest_difference(final_inches(sliced), final_inches(comparison.exact))
    return fill(
        'slicing_error.html',
        section=section,
        contacts=int((comparison.exact.events['kind'] != EventKind.STOP).sum()),
        time_slice=short(REPORT_SLICE),
        ball=given.labels[ball],
        error=number(error, 3),
    )


def _rounding_branch(section: str, given: Table, comparison: Comparison) -> Html:
    rows = []
    for index in moved_balls(comparison.exact):
        sliced = [pair(final_inches(t)[index], 2) for t in comparison.sliced.values()]
        exact = pair(final_inches(comparison.exact)[index], 2)
        printed = pair(comparison.printed[index], 2)
        rows.append([ball_name(given.balls[index]), *sliced, exact, printed])
    slices = [Cell(f'{short(time_slice)} s') for time_slice in SLICES]
    return fill(
        'rounding_branch.html',
        section=section,
        nearest=given.labels[nearest_ball(given)],
        branches=table(
            ['Ball', *slices, 'Exact', 'Printed'],
            rows,
            'End positions [x, y] of the balls that move in shot 4, by slice, inches.',
        ),
    )


def _listing(section: str, given: Table, comparisons: Sequence[Comparison]) -> Html:
    rows = [
        [
            f'{comparison.number}',
            *(
                _greatest(given, final_inches(trajectory), comparison.printed)
                for trajectory in (
                    comparison.sliced[REPORT_SLICE],
                    comparison.with_e_cn,
                    comparison.with_coulomb,
                )
            ),
        ]
        for comparison in comparisons
    ]
    return fill(
        'listing.html',
        section=section,
        stated=f'{STATED_E_CUE_BALL:g}',
        used=f'{given.e_cue_ball:.2f}',
        time_slice=short(REPORT_SLICE),
        changes=table(
            ['Shot', 'As it is', f'Restitution {STATED_E_CUE_BALL:g}', 'Coulomb friction'],
            rows,
            'Greatest difference from the print (and its ball), inches.',
        ),
    )


def _greatest(given: Table, one: np.ndarray, other: np.ndarray) -> str:
    difference, ball = greatest_difference(one, other)
    return f'{number(difference, 4)} ({given.labels[ball]})'
