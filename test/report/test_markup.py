import base64

import pytest
from page_reader import Page, skeleton

from pool_sim_ros.physics import Ball
from pool_sim_ros.report.markup import (
    Cell,
    Html,
    ball_name,
    figure,
    fill,
    join,
    link,
    listing,
    number,
    pair,
    short,
    table,
)


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


def test_a_pair_has_x_and_y():
    assert pair((1.005, -2.0), 1) == '1.0, −2.0'


def test_cells_of_a_table_are_text_unless_they_are_html():
    html = table(
        ['<head>', Cell('a<sup>2</sup>')], [['x & y', Cell('<b>z</b>', 'off')]], 'A <table>'
    )
    page = Page(html)
    assert page.tables == {'A <table>': [['<head>', 'a2'], ['x & y', 'z']]}
    assert page.bold == {'A <table>': ['z']}
    assert '<sup>2</sup>' in html


def test_a_column_of_text_has_a_class_of_its_own():
    html = table(['a', 'b'], [['1', '2']], 'A table', text_columns=(1,))
    assert '<td>1</td><td class="text">2</td>' in html


def test_a_figure_holds_its_picture_and_links_to_the_file():
    vectors = b'<svg id="one"/>'
    html = figure({'images/one.png': vectors}, 'images/one.png', 'One & only', 'A "picture"')
    page = Page(html)
    ((source, description),) = page.pictures
    assert base64.b64decode(source.removeprefix('data:image/svg+xml;base64,')) == vectors
    assert description == 'A "picture"'
    assert page.links == ['images/one.png']
    assert page.text == 'One & only (600 dpi).'


def test_a_ball_has_a_spot_of_its_colour():
    ball = Ball('<1>', 0.16, 0.05, (1.0, 0.5), color=(1.0, 0.5, 0.0))
    assert 'rgb(255 128 0)' in ball_name(ball)
    assert ball_name(ball).endswith('&lt;1&gt;')


def test_a_template_is_filled_only_when_nothing_is_left_out():
    assert 'another table' in fill('no_comparison.html')
    with pytest.raises(KeyError):
        fill('shot.html', number=1)


def test_parts_of_a_template_are_text_unless_they_are_html():
    html = fill(
        'rounding_branch.html', section='4.4', nearest='<1 & \\(2\\)>', branches=Html('<hr>')
    )
    assert '&lt;1 &amp; &#92;(2&#92;)&gt;' in html and '<hr>' in html
    assert isinstance(html, Html)


def test_parts_that_are_joined_are_text_unless_they_are_html():
    assert join(['a < b', Html('<br>'), 3], ' ') == 'a &lt; b <br> 3'


def test_captions_and_descriptions_are_text():
    html = figure({'a"b.png': b''}, 'a"b.png', '<i>', '"><script>')
    assert skeleton(html) == skeleton(figure({'a.png': b''}, 'a.png', 'i', 'script'))
    assert skeleton(table(['a'], [], '<b>"')) == skeleton(table(['a'], [], 'b'))


def test_a_listing_holds_its_lines_as_they_are():
    html = listing('a <b>\n\n  c', 'Listing 1: Output')
    page = Page(html)
    assert page.text == 'Listing 1: Output.a <b>\n\n  c\n'
    assert html.count('<span>') == 3


def test_a_link_shows_its_path_or_a_text():
    assert link('a&b.log') == '<a href="a&amp;b.log">a&amp;b.log</a>'
    assert link('a.log', '<file>') == '<a href="a.log">&lt;file&gt;</a>'
