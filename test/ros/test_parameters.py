"""The parameters as ROS has them: declared, described, checked when they are set."""

import pytest
from rcl_interfaces.msg import ParameterType
from rclpy.node import Node
from rclpy.parameter import Parameter

from pool_sim_ros.ros.parameters import declare_parameters, describe, on_change
from pool_sim_ros.simulator import PARAMETERS, Change, ParameterError, parameters_of


def test_every_parameter_is_declared_with_a_description_and_a_range(ros):
    node = ros.sim_node()
    for name, spec in parameters_of('disc').items():
        descriptor = node.describe_parameter(name)
        assert spec.doc in descriptor.description
        assert descriptor.read_only == (spec.change is Change.NEVER)
        value = node.get_parameter(name)
        if value.type_ is Parameter.Type.DOUBLE:
            [bounds] = descriptor.floating_point_range
            assert bounds.from_value <= value.value <= bounds.to_value
        elif value.type_ is Parameter.Type.INTEGER:
            [bounds] = descriptor.integer_range
            assert bounds.from_value <= value.value <= bounds.to_value
        assert descriptor.type != ParameterType.PARAMETER_NOT_SET


@pytest.mark.parametrize(
    ('name', 'value'),
    [
        ('table.length', 3.0),
        ('balls.labels', ['a']),
        ('publish_rate', 30),
        ('frame_id', 'map'),
        ('table.e_cue_ball', 1.5),
        ('table.e_cue_ball', 'high'),
        ('table.mu_ball_surface', 0.0),
        ('table.ball_friction', 'none'),
        ('integrator', 'euler'),
        ('real_time_factor', -1.0),
        ('real_time_factor', float('nan')),
        ('step_ticks', 0),
    ],
)
def test_a_parameter_that_may_not_change_or_not_to_that_is_refused(ros, name, value):
    node = ros.sim_node()
    before = node.get_parameter(name).value
    [result] = node.set_parameters([Parameter(name, value=value)])
    assert not result.successful and result.reason
    assert node.get_parameter(name).value == before


def test_a_description_says_what_a_text_may_be():
    spec = PARAMETERS['integrator']
    descriptor = describe(spec)
    assert descriptor.additional_constraints == ' or '.join(spec.choices)
    assert descriptor.floating_point_range == descriptor.integer_range == []


def test_values_that_make_no_table_declare_nothing(ros):
    node = Node(
        'strange',
        context=ros.context,
        parameter_overrides=[Parameter('table.lenght', value=2.0)],
    )
    try:
        with pytest.raises(ParameterError, match=r'table\.lenght.*table\.length'):
            declare_parameters(node)
        assert not any(node.has_parameter(name) for name in PARAMETERS)
    finally:
        node.destroy_node()


@pytest.fixture
def changing(ros):
    """A node with the parameters, and the settings that each change led to."""
    node, applied = ros.node(), []
    declare_parameters(node)
    on_change(node, applied.append)
    return node, applied


def test_a_change_is_applied_once_with_all_settings(changing):
    node, applied = changing
    [result] = node.set_parameters([Parameter('max_cue_speed', value=5)])
    assert result.successful
    assert node.get_parameter('max_cue_speed').value == 5.0
    assert [settings.max_cue_speed for settings in applied] == [5.0]


def test_a_change_of_several_that_is_wrong_in_one_changes_none(changing):
    node, applied = changing
    result = node.set_parameters_atomically(
        [Parameter('max_cue_speed', value=5.0), Parameter('real_time_factor', value=-1.0)]
    )
    assert not result.successful and 'real_time_factor' in result.reason
    assert node.get_parameter('max_cue_speed').value == PARAMETERS['max_cue_speed'].default
    assert applied == []


@pytest.mark.parametrize(
    ('name', 'text', 'value'),
    [('time_slice', '1e-6', 1e-6), ('step_ticks', '5', 5), ('step_ticks', 5.0, 5)],
)
def test_a_number_may_come_as_a_string_as_from_ros2_param_set(changing, name, text, value):
    node, applied = changing
    [result] = node.set_parameters([Parameter(name, value=text)])
    assert result.successful, result.reason
    now = node.get_parameter(name).value
    assert now == value and type(now) is type(value)
    assert getattr(applied[-1], name) == value
    [result] = node.set_parameters([Parameter(name, value='much')])
    assert not result.successful and result.reason
    assert node.get_parameter(name).value == value


def test_a_misspelt_name_is_warned_of_and_one_of_another_node_is_not(ros, capfd):
    given = [
        Parameter('real_time_facter', value=2.0),
        Parameter('publish_clok', value=True),
        Parameter('tabel.length', value=2.0),
        Parameter('table.frame', value='map'),
        Parameter('camera.rate', value=10),
    ]
    node = Node('strange', context=ros.context, parameter_overrides=given)
    try:
        assert declare_parameters(node).real_time_factor == 1.0
    finally:
        node.destroy_node()
    lines = [line for line in capfd.readouterr().err.splitlines() if 'did you mean' in line]
    assert len(lines) == 3
    for name, ours in (
        ('real_time_facter', 'real_time_factor'),
        ('publish_clok', 'publish_clock'),
        ('tabel.length', 'table.length'),
    ):
        assert any(f'{name} is not' in line and f'mean {ours}?' in line for line in lines)


def test_parameters_of_others_are_none_of_our_business(changing):
    node, applied = changing
    node.declare_parameter('lamp', 3)
    [result] = node.set_parameters([Parameter('lamp', value=4)])
    assert result.successful and applied == []
