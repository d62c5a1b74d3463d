"""ROS in a process of our own: how it comes up, goes down, and what it says when it cannot."""

import argparse
import signal

import pytest
from process_harness import Process
from rclpy.node import Node

from pool_sim_ros.ros import init_ros, ros_command
from pool_sim_ros.ros.process import StartupError, without_ros_args


def parser():
    parser = argparse.ArgumentParser(prog='play_it')
    parser.add_argument('number', type=int)
    return parser


@pytest.mark.parametrize(
    ('args', 'left'),
    [
        ([], []),
        (['1', '--node', 'left'], ['1', '--node', 'left']),
        (['1', '--ros-args', '-r', '__ns:=/hall'], ['1']),
        (['--ros-args', '-p', 'a:=1', '--', '2'], ['2']),
    ],
)
def test_what_is_for_ros_is_left_out(args, left):
    assert without_ros_args(args) == left


@pytest.mark.parametrize(
    ('args', 'words'),
    [
        (['--no-such-argument'], 'the arguments cannot be read: .*--no-such-argument'),
        (['--params-file', 'nowhere.yaml'], 'the parameter file nowhere.yaml cannot be opened'),
        (['-r', 'no rule'], 'the arguments cannot be read: .*no rule'),
    ],
)
def test_what_ros_cannot_read_is_explained_in_one_line(args, words):
    with pytest.raises(StartupError, match=words) as error:
        init_ros(['--ros-args', *args])
    assert '\n' not in str(error.value)


def test_a_list_of_several_types_comes_with_a_hint(tmp_path):
    file = tmp_path / 'mixed.yaml'
    file.write_text('/**:\n  ros__parameters:\n    balls:\n      masses: [1, 0.5]\n')
    with pytest.raises(StartupError, match='decimal point'):
        init_ros(['--ros-args', '--params-file', str(file)])


def test_a_command_runs_while_ros_is_up(domain):
    seen = []

    @ros_command('play_it', parser)
    def main(context, options):
        node = Node('player', context=context)
        seen.append((context, context.ok(), options.number, node.get_fully_qualified_name()))
        node.destroy_node()
        return 5

    assert main(['3', '--ros-args', '-r', '__ns:=/hall']) == 5
    [(context, was_up, number, name)] = seen
    assert was_up and not context.ok()
    assert (number, name) == (3, '/hall/player')


def failing(error):
    @ros_command('play_it', parser, ZeroDivisionError, interrupted='play_it: given up')
    def main(context, options):
        failing.context = context
        if error is None:
            Node('player', context=context)
        raise error

    return main


@pytest.mark.parametrize(
    ('error', 'args', 'status', 'told'),
    [
        (ZeroDivisionError('by 0'), [], 1, 'play_it: by 0\n'),
        (KeyboardInterrupt(), [], 130, 'play_it: given up\n'),
        (None, ['--ros-args', '-r', '__node:=not a name'], 1, 'not a name'),
        (None, ['--ros-args', '-r', '__ns:=/not a name'], 1, 'not a name'),
    ],
)
def test_whatever_happens_ros_goes_down_and_it_is_told_in_one_line(
    domain, capsys, error, args, status, told
):
    assert failing(error)(['3', *args]) == status
    err = capsys.readouterr().err
    assert told in err and err.startswith('play_it: ') and err.count('\n') == 1
    assert not failing.context.ok()


def test_an_error_that_nobody_expects_takes_ros_down_too(domain):
    with pytest.raises(OSError):
        failing(OSError())(['3'])
    assert not failing.context.ok()


def test_wrong_usage_brings_no_ros_up(domain):
    failing.context = None
    with pytest.raises(SystemExit):
        failing(None)(['three'])
    assert failing.context is None


WAIT_FOR_A_SIGNAL = """
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from pool_sim_ros.ros import init_ros, shut_down_on_signals

context = init_ros([])
shut_down_on_signals(context)
executor = SingleThreadedExecutor(context=context)
executor.add_node(Node('waiter', context=context))
print('waiting')
try:
    executor.spin()
except Exception:
    assert not context.ok()
print('down' if not context.ok() else 'up')
"""


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_a_signal_shuts_ros_down_and_does_nothing_else(domain, tmp_path, number):
    file = tmp_path / 'waiter.py'
    file.write_text(WAIT_FOR_A_SIGNAL)
    with Process(file) as process:
        process.wait_for('waiting')
        process.signal(number)
        process.signal(number)  # as an impatient user does
        assert process.wait() == 0, process.stderr
        assert process.stdout == 'waiting\ndown\n'


LEAVE = """
import threading
from pool_sim_ros.ros import leave_at_once

threading.Thread(target=threading.Event().wait).start()
print('leaving', end='')
leave_at_once(3)
"""


def test_the_process_is_left_though_a_thread_is_busy(domain, tmp_path):
    file = tmp_path / 'leaver.py'
    file.write_text(LEAVE)
    with Process(file) as process:
        assert process.wait() == 3
        assert process.stdout == 'leaving'


def test_errors_of_a_node_that_cannot_be_made_are_told_and_others_are_not_hidden(capsys):
    def main(error):
        @ros_command('play_it', parser)
        def run(context, options):
            raise error

        return run(['3'])

    where = ', at /project/src/participant.cpp:364, at /project/src/rcl/node.c:252'
    assert main(RuntimeError(f'error creating node: No security\nhere{where}')) == 1
    assert capsys.readouterr().err == 'play_it: ROS cannot make a node: No security here\n'
    with pytest.raises(RuntimeError, match='a mistake of ours'):
        main(RuntimeError('a mistake of ours'))
