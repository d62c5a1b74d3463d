"""The command `oracle`: it starts, says so, and ends at once; each mistake is one line."""

import pytest
from process_harness import Process, node_process

from pool_sim_ros.ros import oracle_interface


def test_it_is_ready_beside_a_simulator_and_ends_with_ctrl_c(domain):
    names = ['--ros-args', '-r', '__ns:=/hall']
    with (
        node_process(*names, '-r', '__node:=left'),
        Process('cli.oracle', '--node', 'left', '--threads', '1', *names) as oracle,
    ):
        oracle.wait_for('ready: /hall/left, 11 balls')
        oracle.interrupt()
        assert oracle.wait() == 0, oracle.stderr
        assert 'Traceback' not in oracle.stderr


def test_it_ends_at_once_where_there_is_no_simulator(domain):
    with Process('cli.oracle', '--ros-args', '-r', '__node:=lonely') as oracle:
        oracle.signal(15)
        assert oracle.wait() in (0, -15), oracle.stderr
        assert 'Traceback' not in oracle.stderr


@pytest.mark.parametrize(
    'args', [['--threads', '0'], ['--threads', 'x'], ['--node', '1'], ['more']]
)
def test_wrong_usage_is_explained(domain, args):
    with Process('cli.oracle', *args) as oracle:
        assert oracle.wait() == 2
        assert 'usage: oracle' in oracle.stderr and 'Traceback' not in oracle.stderr


def test_help_lists_the_topics(domain):
    with Process('cli.oracle', '--help') as oracle:
        assert oracle.wait() == 0
        for topic in oracle_interface.TOPICS:
            assert topic.private in oracle.stdout


def test_a_scheduler_that_does_not_answer_is_one_line(domain):
    pytest.importorskip('distributed')
    with Process('cli.oracle', '--ros-args', '-p', 'scheduler:=nonsense') as oracle:
        assert oracle.wait() == 1
        told = oracle.stderr.strip().splitlines()[-1]
        assert "scheduler: 'nonsense' does not answer" in told
        assert 'Traceback' not in oracle.stderr
