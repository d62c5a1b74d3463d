"""How every command starts, fails and stops."""

import subprocess
import sys

import pytest

from pool_sim_ros.console import INTERRUPTED, CommandError, console_command


class BadTableError(Exception):
    pass


def command(run, *errors, **options):
    return console_command('play_it', *errors, **options)(run)


@pytest.mark.parametrize(('returned', 'status'), [(None, 0), (0, 0), (1, 1), (7, 7)])
def test_what_it_returns_is_the_exit_status(returned, status):
    assert command(lambda args: returned)([]) == status


def test_its_arguments_are_those_of_the_process_unless_given(monkeypatch):
    heard = []
    main = command(heard.append)
    monkeypatch.setattr(sys, 'argv', ['play_it', '--fast', '3'])
    main()
    main(['--slow'])
    main([])
    assert heard == [['--fast', '3'], ['--slow'], []]


@pytest.mark.parametrize('error', [BadTableError('the table is round'), CommandError('no table')])
def test_what_is_expected_to_fail_is_one_line_and_status_1(capsys, error):
    def run(args):
        raise error

    assert command(run, BadTableError)([]) == 1
    out, err = capsys.readouterr()
    assert (out, err) == ('', f'play_it: {error}\n')


def test_what_is_not_expected_is_not_hidden():
    def run(args):
        raise BadTableError

    with pytest.raises(BadTableError):
        command(run)([])


def interrupted(args):
    raise KeyboardInterrupt


def test_an_interrupt_has_the_status_of_shells_and_is_told_if_wanted(capsys):
    assert command(interrupted)([]) == INTERRUPTED == 130
    assert capsys.readouterr() == ('', '')
    assert command(interrupted, interrupted='play_it: given up')([]) == INTERRUPTED
    assert capsys.readouterr() == ('', 'play_it: given up\n')
    assert command(interrupted, interrupt_status=0)([]) == 0


def test_wrong_usage_keeps_the_status_of_argparse():
    def run(args):
        sys.exit(2)

    with pytest.raises(SystemExit) as error:
        command(run)([])
    assert error.value.code == 2


def test_it_is_named_and_described_as_the_function_is():
    @console_command('play_it')
    def main(args: list[str]) -> None:
        """Play it."""

    assert (main.__name__, main.__doc__) == ('main', 'Play it.')


def test_the_room_needs_neither_ros_nor_physics():
    code = (
        'import sys, pool_sim_ros.console\n'
        'sys.exit(" ".join({"rclpy", "numpy", "numba"} & set(sys.modules)) or 0)'
    )
    assert subprocess.run([sys.executable, '-c', code], timeout=60, check=False).returncode == 0
