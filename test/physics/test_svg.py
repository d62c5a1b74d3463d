"""What a notebook shows of a table and of a shot."""

import dataclasses
import xml.etree.ElementTree as ElementTree

import pytest
from tables import table_of

from pool_sim_ros.physics import pool_table, report_table, simulate

NAME = '{http://www.w3.org/2000/svg}'


def parsed(shown):
    """Return the whole, which must be well-formed, and its picture."""
    root = ElementTree.fromstring(shown._repr_html_().replace('<br>', '<br/>'))
    return root, root.find(f'{NAME}svg')


@pytest.mark.parametrize('table', [report_table(), pool_table('7ft')], ids=['report', '7ft'])
def test_a_table_shows_its_balls_and_pockets(table):
    root, picture = parsed(table)
    circles = picture.findall(f'.//{NAME}circle')
    pockets, balls = circles[: len(table.pockets)], circles[len(table.pockets) :]
    assert [ball.find(f'{NAME}title').text for ball in balls] == list(table.labels)
    for circle, (x, y) in zip(balls, table.positions, strict=True):
        assert float(circle.get('cx')) == pytest.approx(1000 * x, abs=0.01)
        assert float(circle.get('cy')) == pytest.approx(1000 * y, abs=0.01)
    assert len(pockets) == len(table.pockets)
    text = ''.join(root.itertext())
    assert repr(table) in text and f'e_ball_ball {table.e_ball_ball:g}' in text
    assert ('mu_roll' in text) == (table.motion == 'ball')


def test_a_shot_shows_its_paths_and_its_end():
    shot = simulate(report_table(), (-4.0, 0.0))
    root, picture = parsed(shot)
    lines = picture.findall(f'.//{NAME}polyline')
    moved = [k for k in range(11) if len(shot.path(k)) > 1]
    assert len(lines) == 2 * len(moved)
    x, y = lines[0].get('points').split()[-1].split(',')
    assert (float(x), float(y)) == pytest.approx(1000 * shot.final_positions[moved[0]], abs=0.01)
    assert repr(shot) in ''.join(root.itertext())


def test_a_label_is_text_and_nothing_else():
    label = '<script>&"'
    table = report_table()
    balls = [dataclasses.replace(table.balls[0], label=label), *table.balls[1:]]
    _, picture = parsed(dataclasses.replace(table, balls=balls))
    assert picture.find(f'.//{NAME}title').text == label


def test_a_table_with_many_balls_has_words_alone():
    places = [(0.1 + 0.1 * (k % 40), 0.1 + 0.1 * (k // 40)) for k in range(400)]
    table = table_of(places, length=5.0, width=2.0, radius=0.01)
    assert parsed(table)[1] is None
    assert len(simulate(table, (0.1, 0.0))._repr_html_()) < 300
