import pytest
from parameter_files import CONFIG, from_file

from pool_sim_ros.physics import Ball, Table, report_table
from pool_sim_ros.simulator.parameter_table import (
    BALL_LISTS,
    PARAMETERS,
    default_values,
    parameters_of,
)
from pool_sim_ros.simulator.parameter_values import coerce, values_from


def test_the_report_file_has_every_parameter_with_its_default():
    values = from_file(CONFIG / 'report.yaml')
    assert set(values) == set(parameters_of('disc'))
    assert values_from(values) == default_values()


@pytest.mark.parametrize('name', PARAMETERS)
def test_every_default_is_a_value_of_its_own_parameter(name):
    default = PARAMETERS[name].default
    assert coerce(name, default) == default
    assert type(coerce(name, default)) is type(default)


@pytest.mark.parametrize('name', PARAMETERS)
def test_every_parameter_is_described_and_every_number_has_a_range(name):
    spec = PARAMETERS[name]
    assert spec.name == name and spec.doc and '\n' not in spec.doc
    if type(spec.default) in (int, float):
        assert float('-inf') < spec.least <= spec.default <= spec.most < float('inf')
    if spec.choices:
        assert spec.default in spec.choices


def test_every_field_of_the_table_and_of_a_ball_has_a_parameter():
    table = {name.removeprefix('table.') for name in PARAMETERS if name.startswith('table.')}
    lists = {'cushion_segments', 'cushion_noses'}  # which are the field `cushions`
    assert table - {'preset'} == set(Table.__dataclass_fields__) - {'balls', 'cushions'} | lists
    balls = {name.removeprefix('balls.') for name in PARAMETERS if name.startswith('balls.')}
    assert balls == set(BALL_LISTS)
    assert len(balls) == len(set(Ball.__dataclass_fields__) - {'is_cue'})


def test_the_lists_of_the_balls_have_so_many_values_for_each():
    count = len(report_table().balls)
    for name, width in BALL_LISTS.items():
        assert len(PARAMETERS[f'balls.{name}'].default) == width * count
