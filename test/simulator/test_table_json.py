import json
from dataclasses import replace

import pytest

from pool_sim_ros.physics import Ball, Table, report_table
from pool_sim_ros.simulator.table_json import table_from_json, table_to_json


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
    ['', '[]', '{}', '7', '{"balls": [{}]}', '{"balls": 3}', '{"balls": [], "height": 1}'],
)
def test_what_is_no_table_is_refused(text):
    with pytest.raises(ValueError):
        table_from_json(text)


def test_values_that_make_no_table_are_refused():
    fields = json.loads(table_to_json(report_table()))
    with pytest.raises(ValueError, match='width'):
        table_from_json(json.dumps({**fields, 'width': -1.0}))
