"""The parameters as ROS has them: declared, described, checked when they are set."""

import pytest
from rcl_interfaces.msg import ParameterType
from rclpy.parameter import Parameter

from pool_sim_ros.simulator import PARAMETERS, Change


def test_every_parameter_is_declared_with_a_description_and_a_range(ros):
    node = ros.sim_node()
    for name, spec in PARAMETERS.items():
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
