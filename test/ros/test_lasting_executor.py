"""The executor of `sim_node` outlasts what is raised in it, and still ends with its context."""

import threading

import pytest
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from ros_harness import Ros
from std_msgs.msg import String
from std_srvs.srv import Trigger
from waiting import PATIENCE

from pool_sim_ros.ros import lasting_executor
from pool_sim_ros.ros.lasting_executor import LastingExecutor


@pytest.fixture
def lasting(domain):
    """A context with the executor under test in place of rclpy's."""
    with Ros(domain) as ros:
        ros.executor = LastingExecutor(ros.context)
        yield ros
        ros.executor.shutdown(0.0)


def heard_through(ros, callback):
    """Return a publisher whose messages a plain node hears."""
    subscription = ros.node().create_subscription(String, 'words', callback, 10)
    publisher = ros.node().create_publisher(String, 'words', 10)
    ros.spin_until(subscription.get_publisher_count, 'a match')
    return publisher


def test_a_callback_that_raises_is_called_again(lasting, capfd):
    calls = []

    def fail(message):
        calls.append(message.data)
        raise ZeroDivisionError('no reason')

    publisher = heard_through(lasting, fail)
    for data in 'abc':
        publisher.publish(String(data=data))
        lasting.spin_until(lambda d=data: calls[-1:] == [d], 'the call')
    assert calls == list('abc')
    assert 'no reason' in capfd.readouterr().err


def test_a_message_that_cannot_be_taken_leaves_the_subscription_alive(lasting, monkeypatch, capfd):
    heard, takes = [], []
    publisher = heard_through(lasting, heard.append)
    take = SingleThreadedExecutor._take_subscription

    def fail_at_first(self, subscription):
        call = take(self, subscription)
        takes.append(1)
        if len(takes) == 1:
            raise RuntimeError('it cannot be decoded')
        return call

    monkeypatch.setattr(SingleThreadedExecutor, '_take_subscription', fail_at_first)
    publisher.publish(String(data='bad'))
    lasting.spin_until(lambda: takes, 'the first')
    publisher.publish(String(data='good'))
    lasting.spin_until(lambda: heard, 'the second')
    assert heard == [String(data='good')]
    assert 'it cannot be decoded' in capfd.readouterr().err


def test_an_answer_that_cannot_be_sent_leaves_the_service_alive(lasting, capfd):
    answers = iter(['no response', Trigger.Response(success=True)])
    lasting.node().create_service(Trigger, 'odd', lambda *_: next(answers))
    client = lasting.node().create_client(Trigger, 'odd')
    lasting.spin_until(client.service_is_ready, 'the service')
    client.call_async(Trigger.Request())
    future = client.call_async(Trigger.Request())
    lasting.spin_until(future.done, 'the second answer')
    assert future.result().success
    assert 'odd failed' in capfd.readouterr().err


def test_a_wait_that_fails_is_tried_again_after_a_pause(lasting, monkeypatch, capfd):
    heard, waits, pauses = [], [], []
    publisher = heard_through(lasting, heard.append)
    wait = SingleThreadedExecutor.wait_for_ready_callbacks

    def fail_at_first(self, *args):
        waits.append(1)
        if len(waits) <= 3:
            raise RuntimeError('it cannot wait')
        return wait(self, *args)

    monkeypatch.setattr(SingleThreadedExecutor, 'wait_for_ready_callbacks', fail_at_first)
    monkeypatch.setattr(lasting_executor.time, 'sleep', pauses.append)
    publisher.publish(String(data='late'))
    lasting.spin_until(lambda: heard, 'the message')
    assert pauses == [lasting_executor.PAUSE] * 3
    assert 'it cannot wait' in capfd.readouterr().err


def test_it_ends_with_its_context(domain):
    ended = []
    with Ros(domain) as ros:
        executor = LastingExecutor(ros.context)
        executor.add_node(ros.node())

        def spin():
            try:
                executor.spin()
            except ExternalShutdownException:
                pass
            ended.append(1)

        thread = threading.Thread(target=spin, daemon=True)
        thread.start()
        ros.context.try_shutdown()
        thread.join(PATIENCE)
        assert ended
