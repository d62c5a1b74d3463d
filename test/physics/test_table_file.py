"""A table goes to a file and comes back; a file that is none is refused in one line."""

import json

import numpy as np
import pytest
from spin_tables import spin_table

from pool_sim_ros.physics import POOL_TABLES, Table, pool_table, report_table, simulate
from pool_sim_ros.physics.table_file import LARGEST, table_of_text, table_text

TABLES = {name: lambda name=name: pool_table(name) for name in POOL_TABLES} | {
    'report': report_table,
    'rectangle': lambda: spin_table([(0.1 + 0.2, 1 / 3)], cushion_model='stronge'),
}


@pytest.mark.parametrize('name', TABLES)
def test_a_table_comes_back_bit_for_bit(name, tmp_path):
    table = TABLES[name]()
    table.save(tmp_path / 'table.json')
    found = Table.load(str(tmp_path / 'table.json'))
    assert found == table
    np.testing.assert_array_equal(found.positions, table.positions)
    np.testing.assert_array_equal(found.pockets, table.pockets)
    assert found.balls == table.balls and found.cushions == table.cushions
    assert table_of_text(table_text(table)) == table


def test_it_plays_the_same_shot(tmp_path):
    table = pool_table('7ft')
    table.save(tmp_path / 'table.json')
    shots = [simulate(t, (-5.0, 0.1)) for t in (table, Table.load(tmp_path / 'table.json'))]
    np.testing.assert_array_equal(shots[0].events, shots[1].events)


def test_a_home_folder_is_found(tmp_path, monkeypatch):
    monkeypatch.setenv('HOME', str(tmp_path))
    report_table().save('~/table.json')
    assert Table.load('~/table.json') == report_table()


def refused(tmp_path, text):
    """Return the line in which a file is refused, after its name."""
    file = tmp_path / 'bad.json'
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(ValueError) as caught:
        Table.load(file)
    message = str(caught.value)
    assert '\n' not in message and message.startswith(f'{file}: ')
    return message.removeprefix(f'{file}: ')


@pytest.mark.parametrize(
    ('text', 'words'),
    [
        ('', 'Expecting value'),
        ('{', 'Expecting property name'),
        (b'\xff\xfe\x00', 'codec'),
        ('[]', 'it is no pool_sim_ros table'),
        ('{"length": 2.0}', 'it is no pool_sim_ros table'),
        ('[' * 100_000, 'nested'),
        ('{"format": "pool_sim_ros table", "version": 9}', 'version: 9 must be 1'),
        ('{"format": "pool_sim_ros table"}', 'version: None must be 1'),
        ('{"format": "pool_sim_ros table", "version": 1}', 'balls: None must be a list'),
        (b' ' * (LARGEST + 1), 'it has more than 64 MiB'),
    ],
    ids=['empty', 'cut', 'bytes', 'list', 'other', 'deep', 'new', 'no version', 'bare', 'large'],
)
def test_a_file_that_is_no_table(text, words, tmp_path):
    assert words in refused(tmp_path, text)


MISSING = object()


@pytest.mark.parametrize(
    ('path', 'value', 'words'),
    [
        (('length',), MISSING, "table: 'length' is missing"),
        (('length',), 'two', "length: 'two' is not a number"),
        (('length',), None, 'length: None is not a number'),
        (('mu_slide',), None, 'mu_slide: '),
        (('mu_slide',), -1, 'mu_slide: -1.0 must be at least 0'),
        (('mu_roll',), float('nan'), 'mu_roll: nan is not finite'),
        (('nose_height',), 1.0, 'nose_height: 1 must be between'),
        (('motion',), 'rolls', "motion: 'rolls' must be"),
        (('motion',), [], 'motion: '),
        (('ball_friction',), {}, 'ball_friction: '),
        (('cushion_model',), ['han'], 'cushion_model: '),
        (('colour',), 1, "table: 'colour' is not a field"),
        (('balls',), 7, 'balls: 7 must be a list'),
        (('balls',), [], 'balls: there are none'),
        (('balls', 1), 'nine', "balls[1]: 'nine' must be an object"),
        (('balls', 1, 'mass'), MISSING, "balls[1]: 'mass' is missing"),
        (('balls', 1, 'mass'), 0, "ball '1': mass: 0.0"),
        (('balls', 1, 'label'), [], 'label must be a non-empty string'),
        (('balls', 1, 'spin'), 0, "balls[1]: 'spin' is not a field"),
        (('cushions',), [], 'cushions: [] must be an object'),
        (('cushions', 'noses'), MISSING, "cushions: 'noses' is missing"),
        (('cushions', 'segments'), [[1.0]], 'cushions.segments: an array of shape'),
        (('cushions', 'segments'), {'a': 1}, 'cushions.segments: '),
        (('pockets',), [[0.0, 0.0, 'wide']], 'pockets: '),
        (('pockets',), None, 'pockets: '),
    ],
)
def test_a_field_that_is_wrong_is_named(path, value, words, tmp_path):
    content = json.loads(table_text(pool_table('7ft')))
    *folders, name = path
    holder = content
    for key in folders:
        holder = holder[key]
    if value is MISSING:
        del holder[name]
    else:
        holder[name] = value
    assert words in refused(tmp_path, json.dumps(content))


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(OSError, match=r'none\.json'):
        Table.load(tmp_path / 'none.json')
