import math
import re

import pytest
from page_reader import numbers

from pool_sim_ros.physics import INCH, simulate
from pool_sim_ros.report.comparison_page import comparison_section


def test_the_exact_positions_are_marked_where_they_differ_from_the_print(page, settings, shots):
    rows = page.table('Exact end positions')
    marked = page.bold['Table G: Exact end positions [x, y], inches.']
    differing = []
    for index, row in enumerate(rows):
        for shot, cell in zip(shots.values(), row[1:], strict=True):
            exact = simulate(settings.table, shot.velocity).final_positions[index] / INCH
            assert numbers(cell) == pytest.approx(tuple(exact), abs=0.00501)
            if numbers(cell) != shot.printed[row[0]]:
                differing.append(cell)
    assert marked == differing
    assert f'{44 - len(differing)} of 44 of them equal the print' in page.text


def test_slicing_is_compared_with_the_exact_result(page, settings, shots):
    (head,) = (
        rows[0]
        for caption, rows in page.tables.items()
        if 'by slice' in caption and 'Greatest' in caption
    )
    assert head == ['Shot', '10−4 s', '10−5 s', '2 · 10−6 s', '10−6 s']
    for row in page.table('from the exact result'):
        shot = shots[int(row[0])]
        exact = simulate(settings.table, shot.velocity)
        for cell, time_slice in zip(row[1:], (1e-4, 1e-5, 2e-6, 1e-6), strict=True):
            sliced = simulate(
                settings.table, shot.velocity, integrator='time_slice', time_slice=time_slice
            )
            off = abs(sliced.final_positions - exact.final_positions).max() / INCH
            assert float(cell.split()[0]) == pytest.approx(off, abs=5.1e-5)


def test_the_design_s_facts_are_on_the_page(page):
    # Shot 1: up to 0.016 in; shot 4: the print is one branch, another slice gives the other.
    assert 'ball 8 ends 0.016 in from the exact result' in page.text
    rows = {row[0]: row[1:] for row in page.table('balls that move in shot 4')}
    printed, exact = (numbers(rows['1'][i]) for i in (-1, -2))
    assert printed == (30.64, 21.41)
    assert math.dist(printed, exact) == pytest.approx(0.86, abs=0.01)
    branches = {numbers(cell)[1] > exact[1] for cell in rows['1'][:-2]}
    assert branches == {True, False}
    # The listing's restitution and friction: up to 8.8 in and 17 in.
    rows = page.table('Greatest difference from the print')
    cells = [[float(cell.split()[0]) for cell in row[1:]] for row in rows]
    as_is, e_cn, coulomb = zip(*cells, strict=True)
    assert max(as_is) < 0.006
    assert max(e_cn) == pytest.approx(8.8, abs=0.05)
    assert max(coulomb) == pytest.approx(17.0, abs=0.05)


def test_sections_are_numbered_in_order_whichever_shots_are_compared(settings, comparisons):
    def headings(*shots):
        section = comparison_section(settings.table, [comparisons[n - 1] for n in shots])
        return re.findall('<h3>(4[.][0-9]) (.{6})', section)[2:]

    assert headings(1, 4) == [('4.3', 'Shot 1'), ('4.4', 'Shot 4'), ('4.5', 'Two sl')]
    assert headings(4) == [('4.3', 'Shot 4'), ('4.4', 'Two sl')]
    assert headings(2, 3) == [('4.3', 'Two sl')]


def test_without_comparisons_the_section_says_why(settings):
    assert 'for its own table only' in comparison_section(settings.table, [])
