import re
from dataclasses import replace

import pytest
from page_reader import Page, html_of, numbers, page_of, skeleton

from pool_sim_ros.me212.log import published_final_positions
from pool_sim_ros.physics import two_ball_collision
from pool_sim_ros.report.played import play_shots


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
    constants = dict(page.table('Constants of the table'))
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


@pytest.fixture(scope='module')
def html(settings, shots, comparisons):
    """The same page as HTML."""
    return html_of(settings, list(shots.values()), comparisons)


def test_the_equations_stand_in_the_report_s_order_with_its_matrices(html):
    formulae = html.split('<div class="formula">')[1:]
    numbers = [re.search(r'<span class="number">\((\d+)\)</span>', each) for each in formulae]
    tags = [int(number[1]) for number in numbers if number]
    assert tags == list(range(1, 11))
    with_matrix = [
        int(number[1])
        for number, formula in zip(numbers, formulae, strict=True)
        if number and '<mtable' in formula.partition(number[0])[0]
    ]
    assert with_matrix == [5, 7]


def test_the_exact_integrator_leaves_no_equation_out(other_settings):
    html = html_of(other_settings, list(play_shots(other_settings, (3,))))
    tags = re.findall(r'<span class="number">\((\d+)\)</span>', html)
    assert tags == [str(tag) for tag in range(1, 11)]


def test_the_abstract_has_the_result_and_how_far_the_exact_one_is_from_the_print(html, comparisons):
    abstract = Page(html[html.index('<h2 id="abstract"') : html.index('</section>')]).text
    assert '44 of 44 end positions equal the printed ones' in abstract
    off = max(abs(each.exact.final_positions / 0.0254 - each.printed).max() for each in comparisons)
    assert f'by up to {off:.2f} in (ball 9 in shot 4)' in abstract


def test_contents_and_lists_name_everything_of_the_report_and_every_link_leads_there(html):
    names = [name for name in Page(html).links if name.startswith('#')]
    ids = re.findall(' id="(.+?)"', html)
    assert len(ids) == len(set(ids))
    assert {name[1:] for name in names} <= set(ids)
    of_the_report = (
        *(f'#figure-{number}' for number in range(1, 12)),
        *(f'#table-{number}' for number in (1, 2)),
        *(f'#listing-{number}' for number in (1, 2, 3)),
    )
    for name in of_the_report:
        assert names.count(name) == 1
    assert names.index('#part-1') < names.index('#figure-1') < names.index('#table-1')
    assert names.index('#table-a') < names.index('#listing-1')
    sections = ('1.1', '1.2', '1.3', '2.1', '2.2', '2.3')
    assert [name for name in names if name in {f'#section-{part}' for part in sections}] == [
        f'#section-{part}' for part in sections
    ]


def test_the_page_says_how_it_compares(page):
    assert '44 of 44 end positions equal the printed ones' in page.text
    # Equation 8 as printed: 0.040102 degrees, 1.3998 mm.
    assert '0.0401' in page.text
    assert '1.3998' in page.text


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
    head = page.tables['Table C: End positions of simulation 1, [x, y].'][0]
    assert head == ['Ball', 'End, m', 'End, in']
    assert len(page.table('Table 1')) == 9
    assert 'Printed' not in page.text


def test_labels_are_text_not_markup(other_settings):
    table = other_settings.table
    balls = [replace(table.balls[0], label='<b>&"'), *table.balls[1:]]
    settings = replace(other_settings, table=replace(table, balls=balls))
    page = page_of(settings, list(play_shots(settings, (3,))))
    assert page.table('Table 1')[0][0] == '<b>&"'


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


EVIL = (
    '<img src=x onerror="document.title=1">',
    '\'"><script>document.title = 1</script>',
    r'\(x^2\) \[y\]',
    '$verdict ${x} $$',
    '&lt;b&gt;',
    '</title></style><h2 id="x">y</h2>',
)
"""Labels that would be something else than text if they were not escaped."""


@pytest.fixture(scope='module')
def htmls(settings, comparisons):
    """The whole page of the report's table with plain labels, then with evil ones; and those."""
    plain = [f'ball {index:02}' for index in range(11)]
    evil = [f'{EVIL[index % len(EVIL)]}{index:02}' for index in range(11)]
    return [(_labelled(settings, comparisons, labels), labels) for labels in (plain, evil)]


def _labelled(settings, comparisons, labels):
    balls = zip(settings.table.balls, labels, strict=True)
    renamed = [replace(ball, label=label) for ball, label in balls]
    other = replace(settings, table=replace(settings.table, balls=renamed))
    shots = []
    for shot in play_shots(other, (1, 4)):
        printed = published_final_positions()[shot.number].values()
        shots.append(replace(shot, printed=dict(zip(labels, printed, strict=True))))
    return html_of(other, shots, [comparisons[0], comparisons[3]])


def test_labels_change_nothing_but_the_text(htmls):
    (plain, _), (evil, _) = htmls
    assert skeleton(evil) == skeleton(plain)
    assert '<math' in plain


def test_every_label_can_be_read_wherever_it_stands(htmls):
    texts = []
    for html, labels in htmls:
        text = Page(html).text
        for index, label in enumerate(labels):
            text = text.replace(label, f'LABEL{index}.')
        texts.append(text)
    plain, evil = texts
    assert plain == evil
    # The nearest ball is named in the words on shot 4 and on its rounding error.
    assert re.search(r'toward ball LABEL\d+', plain)
    assert re.search(r'centre of ball LABEL\d+', plain)
    assert re.search(r'ball LABEL\d+\.\s+ends', plain)


def test_the_page_forbids_every_script(htmls):
    _, (html, _) = htmls
    policy = html.index('<meta http-equiv="Content-Security-Policy" content="')
    assert policy < html.index('<style') and policy < html.index('<title')
    content = html[policy:].partition('content="')[2].partition('"')[0]
    rules = dict(rule.strip().split(' ', 1) for rule in content.split(';'))
    assert rules['default-src'] == "'none'" and 'script-src' not in rules
    assert "'none'" == rules['base-uri'] == rules['form-action']
