"""Arguments that commands have in common."""

import argparse

import pytest

from pool_sim_ros.ros import NODE_NAME, add_simulator, add_timeout


@pytest.fixture
def parser():
    parser = argparse.ArgumentParser()
    add_simulator(parser)
    add_timeout(parser)
    return parser


def test_what_is_not_given(parser):
    options = parser.parse_args([])
    assert (options.node, options.timeout) == (NODE_NAME, 10.0)


def test_what_is_given(parser):
    options = parser.parse_args(['--node', '/hall/left', '--timeout', '2.5'])
    assert (options.node, options.timeout) == ('/hall/left', 2.5)


@pytest.mark.parametrize('args', [['--node', '1st'], ['--timeout', '0'], ['--timeout', 'nan']])
def test_what_cannot_be(parser, args, capsys):
    with pytest.raises(SystemExit) as ended:
        parser.parse_args(args)
    assert ended.value.code == 2 and args[0] in capsys.readouterr().err
