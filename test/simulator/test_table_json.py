import json
from dataclasses import replace

import pytest

from pool_sim_ros.physics import Ball, Table, report_table
from pool_sim_ros.simulator.table_json import LONGEST, table_from_json, table_to_json


@pytest.mark.parametrize(
    'table',
    [
        report_table(),
        replace(report_table(), ball_friction='coulomb', e_cue_ball=0.1 + 0.2),
        Table(2.0, 1.0, [Ball('\u00e9 "1"', 0.1, 0.05, (0.1 + 0.2, 0.5), is_cue=True)]),
    ],
)
def test_a_table_comes_back_bit_for_bit(table):
    assert table_from_json(table_to_json(table)) == table


def test_the_fields_have_their_own_names():
    fields = json.loads(table_to_json(report_table()))
    assert fields['length'] == report_table().length
    assert fields['balls'][0]['label'] == 'C' and fields['balls'][0]['is_cue'] is True


@pytest.mark.parametrize(
    'text',
    [
        '',
        '[]',
        '{}',
        '7',
        '{"balls": [{}]}',
        '{"balls": 3}',
        '{"balls": [], "height": 1}',
        '[' * 1_000_000,
        '{"balls": ' * 1_000_000,
        '{"balls": [[[[]]]]}',
        '{"balls": [5]}',
        '{"balls": null}',
        'x' * (LONGEST + 1),
    ],
    ids=lambda value: repr(value)[:20],
)
def test_what_is_no_table_is_refused(text):
    with pytest.raises(ValueError):
        table_from_json(text)


def test_values_that_make_no_table_are_refused():
    fields = json.loads(table_to_json(report_table()))
    with pytest.raises(ValueError, match='width'):
        table_from_json(json.dumps({**fields, 'width': -1.0}))


@pytest.mark.parametrize(
    'value', ['NaN', '1e999', '9' * 400, 'null', '"x"', '[]', '{}', '-1'], ids=range(8)
)
@pytest.mark.parametrize('name', ['length', 'mu_ball_ball', 'e_cue_ball', 'mass', 'position'])
def test_a_foreign_value_is_refused_by_name(name, value):
    fields = json.loads(table_to_json(report_table()))
    for owner in (fields, fields['balls'][3]):
        if name in owner:
            owner[name] = 'HERE'
    with pytest.raises(ValueError, match=rf'this is no table: .*{name}'):
        table_from_json(json.dumps(fields).replace('"HERE"', value))


def test_a_label_of_half_a_character_is_refused():
    text = table_to_json(report_table()).replace('"C"', r'"\ud83c"')
    with pytest.raises(ValueError, match='half a character'):
        table_from_json(text)
