"""Requests to the parameter services over which rclpy stumbles are answered, and change nothing."""

import pytest
from rcl_interfaces.msg import Parameter as ParameterMessage
from rcl_interfaces.msg import ParameterValue
from rcl_interfaces.srv import (
    DescribeParameters,
    GetParameters,
    GetParameterTypes,
    ListParameters,
    SetParameters,
    SetParametersAtomically,
)
from rclpy.parameter import Parameter

from pool_sim_ros.ros.parameter_services import MOST_NAMES, checked

NAMES = {
    DescribeParameters: 'names',
    GetParameters: 'names',
    GetParameterTypes: 'names',
    ListParameters: 'prefixes',
}


def parameter(name, value, kind=None):
    message = Parameter(name, value=value).to_parameter_msg()
    if kind is not None:
        message.value.type = kind
    return message


@pytest.fixture
def call(ros):
    """A SimNode, and a function that calls one of its parameter services."""
    node, clients = ros.sim_node(), {}

    def call(service, **fields):
        name = ''.join(f'_{c.lower()}' if c.isupper() else c for c in service.__name__)
        if service not in clients:
            clients[service] = ros.node().create_client(service, f'pool_sim/{name[1:]}')
        ros.spin_until(clients[service].service_is_ready, name)
        future = clients[service].call_async(service.Request(**fields))
        ros.spin_until(future.done, 'an answer')
        return future.result()

    return node, call


@pytest.mark.parametrize('kind', [10, 77, 255])
def test_an_unknown_type_is_refused_by_name_and_the_others_are_set(call, capfd, kind):
    node, call = call
    before = node.get_parameter('max_shot_duration').value
    bad = parameter('max_shot_duration', 7.0, kind)
    good, other = parameter('max_cue_speed', 5.0), parameter('step_ticks', 2)
    results = call(SetParameters, parameters=[good, bad, other]).results
    assert [result.successful for result in results] == [True, False, True]
    assert 'max_shot_duration' in results[1].reason and str(kind) in results[1].reason
    assert '\n' not in results[1].reason
    assert node.get_parameter('max_cue_speed').value == 5.0
    assert node.get_parameter('step_ticks').value == 2

    result = call(SetParametersAtomically, parameters=[parameter('step_ticks', 3), bad]).result
    assert not result.successful and str(kind) in result.reason
    assert node.get_parameter('step_ticks').value == 2
    assert node.get_parameter('max_shot_duration').value == before
    assert 'SetParameters was refused' in capfd.readouterr().err


@pytest.mark.parametrize('service', [SetParameters, SetParametersAtomically])
@pytest.mark.parametrize('kind', list(range(256)))
def test_any_type_under_any_name_has_one_answer_each(service, kind):
    def rclpys(request, response):
        for one in request.parameters:
            Parameter.from_parameter_msg(one)
        raise AttributeError('something else')

    said = []
    answer = checked(service, rclpys, said.append)
    request = service.Request(
        parameters=[ParameterMessage(name='a', value=ParameterValue(type=kind))] * 3
    )
    response = answer(request, service.Response())
    results = response.results if service is SetParameters else [response.result]
    assert len(results) == (3 if service is SetParameters else 1)
    assert not any(result.successful for result in results)
    assert all(result.reason for result in results) and len(said) == len(results)


@pytest.mark.parametrize('service', NAMES)
def test_too_many_names_are_refused_in_a_line_before_rclpy_looks_at_them(service):
    def rclpys(*_):
        raise AssertionError('called')

    said = []
    request = service.Request(**{NAMES[service]: ['a'] * (MOST_NAMES + 1)})
    assert checked(service, rclpys, said.append)(request, service.Response()) == service.Response()
    [line] = said
    assert service.__name__ in line and str(MOST_NAMES + 1) in line and '\n' not in line


def test_too_many_names_get_an_empty_answer(call):
    node, call = call
    for service, field in NAMES.items():
        response = call(service, **{field: ['a'] * (MOST_NAMES + 1)})
        assert response == service.Response()
        assert call(service, **{field: ['table.length']}) != service.Response()
    many = [parameter('step_ticks', 3)] * (MOST_NAMES + 1)
    assert list(call(SetParameters, parameters=many).results) == []
    result = call(SetParametersAtomically, parameters=many).result
    assert not result.successful and str(MOST_NAMES) in result.reason
    assert node.get_parameter('step_ticks').value == 1


def test_another_service_is_left_alone():
    assert checked(object, print, print) is print
