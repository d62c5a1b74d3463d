"""How every command starts, fails and stops."""

import signal
import subprocess
import sys
import time

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


class Interrupted:
    """An interrupt arrives while it goes, as often as told."""

    left = 0

    def __del__(self):
        if Interrupted.left:
            Interrupted.left -= 1
            signal.raise_signal(signal.SIGINT)
            time.sleep(0)  # here Python raises it


@pytest.mark.parametrize('times', [1, 3])
def test_an_interrupt_that_cannot_be_raised_comes_again(capsys, times):
    def run(args):
        Interrupted.left = times
        end = time.monotonic() + 60
        while time.monotonic() < end:
            Interrupted()

    before = sys.unraisablehook
    try:
        assert command(run, interrupted='play_it: given up')([]) == INTERRUPTED
    finally:
        sys.unraisablehook = before
    assert (Interrupted.left, capsys.readouterr()) == (0, ('', 'play_it: given up\n'))


def test_what_else_cannot_be_raised_is_told_as_ever(monkeypatch):
    class Bad:
        def __del__(self):
            raise BadTableError

    told = []
    monkeypatch.setattr(sys, 'unraisablehook', lambda lost: told.append(lost.exc_type))
    assert command(lambda args: Bad() and None)([]) == 0
    assert told == [BadTableError]


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


@pytest.mark.parametrize('name', ['rclpy', 'rclpy.node', 'std_msgs.msg', 'no_such_module'])
def test_a_missing_package_is_one_line_and_status_1(capsys, name):
    def run(args):
        raise ModuleNotFoundError(f'No module named {name!r}', name=name)

    assert command(run)([]) == 1
    out, err = capsys.readouterr()
    assert out == '' and err.startswith(f'play_it: needs {name.partition(".")[0]}, not installed')
    assert err.count('\n') == 1


@pytest.mark.parametrize('error', [ImportError, ModuleNotFoundError])
@pytest.mark.parametrize('name', ['pool_sim_ros', 'pool_sim_ros.no_such_room'])
def test_a_missing_module_of_our_own_is_not_hidden(error, name):
    def run(args):
        raise error('No module', name=name)

    with pytest.raises(error):
        command(run)([])


@pytest.mark.parametrize(('name', 'words'), [('rclpy._rclpy', 'rclpy'), (None, 'a package')])
def test_a_package_that_cannot_be_loaded_is_one_line_and_status_1(capsys, name, words):
    def run(args):
        raise ImportError('librcl.so: no such file\nsource ROS first', name=name)

    assert command(run)([]) == 1
    told = f'play_it: {words} cannot be loaded: librcl.so: no such file source ROS first\n'
    assert capsys.readouterr() == ('', told)


def test_an_interrupt_while_modules_are_loaded_is_told_like_any_other(tmp_path):
    slow = tmp_path / 'slow_module.py'
    slow.write_text(
        'import os, signal, time\nos.kill(os.getpid(), signal.SIGINT)\ntime.sleep(60)\n'
    )
    code = (
        'import signal, sys\n'
        'signal.signal(signal.SIGINT, signal.default_int_handler)\n'
        f'sys.path.insert(0, {str(tmp_path)!r})\n'
        'from pool_sim_ros.console import console_command\n'
        'def run(args): import slow_module\n'
        'sys.exit(console_command("play_it", interrupted="play_it: given up")(run)([]))'
    )
    done = subprocess.run([sys.executable, '-c', code], capture_output=True, timeout=60, text=True)
    assert (done.returncode, done.stderr) == (INTERRUPTED, 'play_it: given up\n')


INTERRUPTED_HALFWAY = """
import pool_sim_ros.console as console

class Half:
    def __init__(self):
        raise KeyboardInterrupt
    def __del__(self):
        self.never_made.close()

@console.console_command('play_it')
def main(args):
    Half()

raise SystemExit(main([]))
"""


def test_what_was_interrupted_while_it_was_made_does_not_complain_when_it_goes():
    """An executor of rclpy does; `KeyboardInterrupt` holds it until it is dealt with."""
    ended = subprocess.run(
        [sys.executable, '-c', INTERRUPTED_HALFWAY], capture_output=True, text=True, timeout=60
    )
    assert (ended.returncode, ended.stdout, ended.stderr) == (INTERRUPTED, '', '')
