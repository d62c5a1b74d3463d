"""Whatever a callback raises goes into the log; the node goes on, under any executor."""

import asyncio

import pytest
from rclpy.executors import ExternalShutdownException
from ros_harness import Ros
from std_msgs.msg import String
from std_srvs.srv import Trigger

from pool_sim_ros.ros.guarded_node import GuardedNode, exceptions_told


@pytest.fixture
def node(ros):
    return ros.add(GuardedNode('guarded', context=ros.context))


def failing(calls):
    def fail(*_):
        calls.append(1)
        raise ZeroDivisionError('no reason')

    return fail


def failing_later(calls):
    async def fail(*_):
        failing(calls)()

    return fail


@pytest.mark.parametrize('kind', [failing, failing_later])
def test_a_subscription_that_raises_is_called_again(ros, node, capfd, kind):
    calls = []
    subscription = node.create_subscription(String, 'words', kind(calls), 10)
    publisher = ros.node().create_publisher(String, 'words', 10)
    ros.spin_until(subscription.get_publisher_count, 'a match')
    for count in (1, 2, 3):
        publisher.publish(String())
        ros.spin_until(lambda c=count: len(calls) == c, 'the call')
    errors = capfd.readouterr().err
    assert errors.count('words failed, and the node goes on') == 1  # throttled
    assert 'no reason' in errors


@pytest.mark.parametrize('kind', [failing, failing_later])
def test_a_service_that_raises_is_answered_with_its_empty_response(ros, node, capfd, kind):
    calls = []
    node.create_service(Trigger, 'broken', kind(calls))
    client = ros.node().create_client(Trigger, 'broken')
    ros.spin_until(client.service_is_ready, 'the service')
    for _ in range(2):
        future = client.call_async(Trigger.Request())
        ros.spin_until(future.done, 'an answer')
        assert future.result() == Trigger.Response()
    assert len(calls) == 2
    assert 'broken failed' in capfd.readouterr().err


def test_a_timer_that_raises_is_called_again(ros, node, capfd):
    calls = []
    node.create_timer(0.01, failing(calls))
    ros.spin_until(lambda: len(calls) >= 3, 'three calls')
    assert 'a timer failed' in capfd.readouterr().err


def test_callbacks_that_raise_nothing_do_as_they_do(ros, node):
    heard, informed = [], []
    node.create_subscription(String, 'words', heard.append, 10)
    node.create_subscription(String, 'words', lambda m, info: informed.append(info), 10)
    node.create_service(Trigger, 'fine', lambda _, answer: Trigger.Response(message='yes'))
    other = ros.node()
    publisher, client = other.create_publisher(String, 'words', 10), None
    client = other.create_client(Trigger, 'fine')
    ros.spin_until(lambda: publisher.get_subscription_count() == 2, 'a match')
    publisher.publish(String(data='hello'))
    ros.spin_until(lambda: heard and informed, 'the message')
    assert heard == [String(data='hello')] and 'source_timestamp' in informed[0]
    ros.spin_until(client.service_is_ready, 'the service')
    future = client.call_async(Trigger.Request())
    ros.spin_until(future.done, 'an answer')
    assert future.result().message == 'yes'


def test_what_rclpy_serves_by_itself_raises_nothing_either(ros, node):
    assert {'guarded/get_type_description', 'guarded/set_parameters'} <= {
        service.srv_name for service in node.services
    }
    for service in node.services:
        empty = service.srv_type.Response()
        assert service.callback(None, service.srv_type.Response()) == empty


def test_a_shutdown_is_no_failure(domain, capfd):
    with Ros(domain) as ros:
        log = ros.node().get_logger()
        with pytest.raises(ExternalShutdownException):
            with exceptions_told('a', ros.context, log):
                raise ExternalShutdownException
        with pytest.raises(KeyboardInterrupt):
            with exceptions_told('a', ros.context, log):
                raise KeyboardInterrupt
        ros.context.try_shutdown()
        with exceptions_told('a', ros.context, log):
            raise RuntimeError('the context is down')
    assert 'failed' not in capfd.readouterr().err


def test_a_coroutine_goes_on_to_be_one(ros, node):
    async def double(number):
        return 2 * number

    assert asyncio.run(node._guarded('doubling', double)(4)) == 8


def test_what_no_log_can_write_is_written_all_the_same(ros, node, capfd):
    with exceptions_told('words', ros.context, node.get_logger()):
        raise ValueError('half of a pair: \ud800')
    node.warn('another half: \udfff')
    logged = capfd.readouterr().err
    assert '\\ud800' in logged and '\\udfff' in logged


def test_warnings_are_throttled(ros, node, capfd):
    for _ in range(50):
        node.warn('a peer did this')
    assert 1 <= capfd.readouterr().err.count('a peer did this') <= 5
