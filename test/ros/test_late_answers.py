"""A service may answer later, from another thread; the executor serves others meanwhile."""

import threading
from concurrent.futures import Future

import pytest
from rclpy.node import Node
from std_srvs.srv import Trigger

from pool_sim_ros.ros.late_answers import allow_late_answers


@pytest.fixture
def serve(ros):
    """Serve with a callback, and return a function that calls and returns the future."""
    count = 0

    def serve(callback):
        nonlocal count
        count += 1
        name, node = f'late_{count}', ros.add(Node(f'server_{count}', context=ros.context))
        allow_late_answers(node, node.create_service(Trigger, name, callback))
        client = ros.node().create_client(Trigger, name)
        ros.spin_until(client.service_is_ready, 'the service')
        return lambda: client.call_async(Trigger.Request())

    return serve


def test_an_answer_at_once_is_as_ever(ros, serve):
    call = serve(lambda _, response: Trigger.Response(message='now'))
    future = call()
    ros.spin_until(future.done, 'the answer')
    assert future.result().message == 'now'


def test_late_answers_go_to_those_that_asked_in_any_order(ros, serve):
    answers = []

    def later(_, response):
        answers.append(Future())
        return answers[-1]

    ask_later, ask_now = serve(later), serve(lambda _, response: response)
    first, second = ask_later(), ask_later()
    ros.spin_until(lambda: len(answers) == 2, 'the requests')
    other = ask_now()
    ros.spin_until(other.done, 'an answer meanwhile')
    assert not (first.done() or second.done())
    for index, message in ((1, 'to the second'), (0, 'to the first')):
        thread = threading.Thread(
            target=answers[index].set_result, args=(Trigger.Response(message=message),)
        )
        thread.start()
        thread.join()
    ros.spin_until(lambda: first.done() and second.done(), 'both answers')
    assert (first.result().message, second.result().message) == ('to the first', 'to the second')


def test_an_answer_that_cannot_be_sent_is_logged_where_it_was_given(ros, serve, capfd):
    answers = []

    def later(_, response):
        answers.append(Future())
        return answers[-1]

    ask = serve(later)
    ask()
    ros.spin_until(lambda: answers, 'the request')
    answers[0].set_result('no response')
    assert 'failed, and the node goes on' in capfd.readouterr().err
