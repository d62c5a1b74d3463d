import math
import re
from dataclasses import replace

import numpy as np
import pytest
from page_reader import Page, numbers

from pool_sim_ros.me212.log import published_final_positions
from pool_sim_ros.physics import simulate, two_ball_collision
from pool_sim_ros.report.comparison import compare, greatest_difference
from pool_sim_ros.report.markup import number, short
from pool_sim_ros.report.mathml import with_formulae
from pool_sim_ros.report.page import Content, make_page
from pool_sim_ros.report.played import play_shots, verdict

INCH = 0.0254


class AnyPicture(dict):
    def __missing__(self, path):
        return b'<svg/>'


def page_of(settings, shots, comparisons=(), films=None):
    content = Content(settings, shots, comparisons, AnyPicture(), films or {}, ['output.log'])
    html = make_page(content)
    assert not re.search(r'\$[a-z]', html)
    assert '\\(' not in html
    assert '\\[' not in html
    return Page(html)


@pytest.fixture(scope='module')
def comparisons(settings, shots):
    return [compare(settings.table, n, shot.printed) for n, shot in shots.items()]


@pytest.fixture(scope='module')
def page(settings, shots, comparisons):
    return page_of(settings, list(shots.values()), comparisons)


@pytest.mark.parametrize('number', [1, 2, 3, 4])
def test_end_positions_stand_beside_the_printed_ones(page, shots, number):
    printed = published_final_positions()[number]
    rows = page.table(f'End positions of simulation {number}')
    assert [row[0] for row in rows] == list(printed)
    for label, metres, end, beside, difference in rows:
        assert numbers(end) == numbers(beside) == printed[label]
        assert numbers(difference) == (0.0, 0.0)
        exact = shots[number].final_positions[label]
        assert numbers(metres) == pytest.approx(exact, abs=5.1e-7)


def test_the_given_data_are_those_of_the_report(page):
    constants = dict(page.table('The table'))
    assert constants['Length and width'] == '2.2352 m, 1.1176 m'
    assert constants['Gravity'] == '9.80665 m/s²'
    friction = [value for name, value in constants.items() if 'Friction' in name]
    assert friction == ['μ = 0.05', 'μ = 0.1', 'μ = 0.2']
    restitution = [value for name, value in constants.items() if 'Restitution' in name]
    assert restitution == ['e = 0.7', 'e = 0.9', 'e = 0.7']
    balls = page.table('Table 1')
    assert balls[0] == ['C', '66.00, 22.00', '1.6764, 0.5588', '2.25', '200']
    assert balls[10][:2] == ['10', '19.78, 26.81']
    assert len(balls) == 11


def test_the_page_has_all_equations_and_says_how_it_compares(page):
    for tag in range(1, 11):
        assert f'({tag})' in page.text
    assert '44 of 44 end positions equal the printed ones' in page.text
    # Equation 8 as printed: 0.040102 degrees, 1.3998 mm.
    assert '0.0401' in page.text
    assert '1.3998' in page.text


def test_the_exact_positions_are_marked_where_they_differ_from_the_print(page, settings, shots):
    rows = page.table('Exact end positions')
    marked = page.bold['Exact end positions [x, y], inches.']
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


def test_the_example_of_part_1_is_computed(page):
    before = (1.2, 0.6)
    for law, ball, *cells in page.table('Velocities of the example'):
        result = two_ball_collision(
            0.2, 0.16, before, (0.0, 0.0), 0.05715, 0.05715, 0.04572, 0.7, 0.05, law.lower()
        )
        after = result.velocity_a if ball == 'a' else result.velocity_b
        assert numbers(cells[-1]) == pytest.approx(tuple(after), abs=5.1e-5)
        index = 'ab'.index(ball)
        parts = (
            result.normal_before,
            result.tangential_before,
            result.normal_after,
            result.tangential_after,
        )
        assert [numbers(cell)[0] for cell in cells[:-1]] == pytest.approx(
            [part[index] for part in parts], abs=5.1e-5
        )


def test_every_picture_is_in_the_page_and_described(page):
    assert len(page.pictures) == 3 + 2 * 4
    assert all(source.startswith('data:image/svg+xml;base64,') for source, _ in page.pictures)
    assert all(len(description) > 20 for _, description in page.pictures)
    files = [link for link in page.links if link.startswith('images/')]
    assert [name for name in files if 'Simulation' in name] == [
        f'images/Simulation_{number}_{when}.png'
        for number in range(1, 5)
        for when in ('start', 'end')
    ]


def test_films_are_on_the_page_when_there_are_any(settings, shots, page):
    assert not any(link.endswith('.mp4') for link in page.links)
    with_film = page_of(settings, [shots[3]], films={3: 'videos/collision_3.mp4'})
    assert 'videos/collision_3.mp4' in with_film.links


def test_another_integrator_is_said_and_still_compared(settings, comparisons):
    exact = replace(settings, report_integrator='event')
    shots = list(play_shots(exact, (1, 4)))
    page = page_of(exact, shots, [comparisons[0], comparisons[3]])
    assert 'the exact integrator' in page.text
    assert 'the print is not of this run (integrator event)' in page.text
    rows = page.table('End positions of simulation 4')
    for label, _, end, printed, difference in rows:
        assert numbers(printed) == published_final_positions()[4][label]
        off = [a - b for a, b in zip(numbers(end), numbers(printed), strict=True)]
        assert numbers(difference) == pytest.approx(off, abs=1e-9)
    assert any(numbers(row[4]) != (0.0, 0.0) for row in rows)


def test_another_table_has_nothing_printed_to_compare_with(other_settings):
    shots = list(play_shots(other_settings, (1, 2)))
    page = page_of(other_settings, shots)
    assert 'printed nothing for this table' in page.text
    assert 'the report printed positions for its own table only' in page.text
    head = page.tables['End positions of simulation 1, [x, y].'][0]
    assert head == ['Ball', 'End, m', 'End, in']
    assert len(page.table('Table 1')) == 9
    assert 'Printed' not in page.text


def test_labels_are_text_not_markup(other_settings):
    table = other_settings.table
    balls = [replace(table.balls[0], label='<b>&"'), *table.balls[1:]]
    settings = replace(other_settings, table=replace(table, balls=balls))
    page = page_of(settings, list(play_shots(settings, (3,))))
    assert page.table('Table 1')[0][0] == '<b>&"'


def test_deviations_name_all_that_differs(settings, other_settings):
    assert settings.deviations == []
    assert replace(settings, time_slice=1e-5).deviations == ['slices of 1e-05 s']
    assert other_settings.deviations == ['another table', 'integrator event']
    # Colours move nothing.
    balls = [replace(ball, color=(0.5, 0.5, 0.5)) for ball in settings.table.balls]
    assert replace(settings, table=replace(settings.table, balls=balls)).deviations == []


def test_the_verdict_counts(settings, shots):
    assert verdict(settings, [shots[2]]).startswith('11 of 11 ')


def test_greatest_difference_is_by_coordinate_and_names_the_ball():
    one = np.array([[0.0, 0.0], [1.0, 1.0], [5.0, 5.0]])
    other = np.array([[0.1, 0.1], [1.0, 1.5], [5.3, 4.7]])
    assert greatest_difference(one, other) == (0.5, 1)


@pytest.mark.parametrize(
    ('value', 'text'),
    [(0.0, '0.00'), (-0.001, '0.00'), (-0.006, '−0.01'), (12.345, '12.35'), (-10.0, '−10.00')],
)
def test_numbers_have_no_minus_before_nothing(value, text):
    assert number(value, 2) == text


@pytest.mark.parametrize(
    ('value', 'text'),
    [
        (0.0, '0'),
        (0.25, '0.25'),
        (1e-6, '10<sup>−6</sup>'),
        (2e-6, '2 · 10<sup>−6</sup>'),
        (1.25e-5, '1.25 · 10<sup>−5</sup>'),
        (3e7, '3 · 10<sup>7</sup>'),
    ],
)
def test_small_numbers_are_powers_of_ten(value, text):
    assert short(value) == text


def test_formulae_become_mathml_with_their_numbers():
    html = with_formulae(r'a \(x_1\) b \[ y = 2 , \quad z = 3 \tag{7} \] c')
    assert html.count('<math') == 3
    assert '<span class="number">(7)</span>' in html
    assert '<msub><mi>x</mi><mn>1</mn></msub>' in html
    assert html.startswith('a <math')
    assert html.endswith('</div> c')
