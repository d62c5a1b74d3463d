import pytest
from rclpy.context import Context
from rclpy.parameter import Parameter

from pool_sim_ros.ros.node_options import check_options

GOOD = {
    'context': Context(),
    'cli_args': ['--ros-args', '-p', 'step_ticks:=2'],
    'namespace': 'left',
    'use_global_arguments': False,
    'parameter_overrides': [Parameter('step_ticks', value=2)],
}


def test_what_rclpy_takes_passes():
    check_options('a', GOOD)
    check_options('a', {name: None for name in GOOD if name != 'use_global_arguments'})
    check_options('a', {'cli_args': [], 'parameter_overrides': []})


@pytest.mark.parametrize(
    ('name', 'value', 'words'),
    [
        ('context', 'mine', 'a rclpy Context'),
        ('cli_args', '-r __ns:=/a', 'a list of strings'),
        ('cli_args', [1], 'a list of strings'),
        ('namespace', 5, 'a string'),
        ('use_global_arguments', None, 'true or false'),
        ('enable_rosout', 'no', 'true or false'),
        ('parameter_overrides', {'step_ticks': 2}, 'a list of rclpy Parameters'),
        ('parameter_overrides', [('step_ticks', 2)], 'a list of rclpy Parameters'),
    ],
)
def test_another_type_is_refused_by_name(name, value, words):
    with pytest.raises(TypeError, match=f'^{name} must be {words}, not ') as error:
        check_options('a', {name: value})
    assert '\n' not in str(error.value)


@pytest.mark.parametrize('name', [None, 7, b'pool'])
def test_a_name_is_a_string(name):
    with pytest.raises(TypeError, match='^node_name must be a string'):
        check_options(name, {})
