"""The command-line client `shot`."""

import os
import pty
import subprocess
import sys
import time

import pytest
from process_harness import Process, node_process

from pool_sim_ros.cli.shot import _Parser
from pool_sim_ros.me212.log import format_position, format_shot_head
from pool_sim_ros.physics import cue_strike, pool_table, report_table, simulate

QUICK = {'real_time_factor': 20.0}


def other_simulator(real_time_factor=0.01):
    """Start one under another name than the one that most tests share, where shots last long."""
    names = ['--ros-args', '-r', '__node:=other']
    return node_process(*names, real_time_factor=real_time_factor)


STRIKE_OTHER = ['--velocity', '-1', '0', '--node', 'other']
PATIENT = ['--timeout', '60']


@pytest.fixture(scope='module')
def simulator(domain):
    with node_process(**QUICK) as process:
        yield process


def test_shots_are_printed_in_the_form_of_the_log(simulator):
    table = report_table()
    with Process('cli.shot', '1', *PATIENT) as shot:
        assert shot.wait() == 0, shot.stderr
        accepted, _, log = shot.stdout.partition('\n')
        assert 'accepted' in accepted and '-4.000' in accepted and 'time_slice' in accepted
        assert log.startswith(format_shot_head(1, (-4.0, 0.0)))
        assert '\n        Ball 10: [16.85, 41.25] (in)\n' in log
        assert log.count('(in)') == len(table.balls)
        assert '\r' not in shot.stdout and shot.stderr == ''
    ends = simulate(table, (-4.0, 0.0), integrator='time_slice').final_positions
    with Process('cli.shot', '--velocity', '-2', '0.5', *PATIENT) as shot:
        assert shot.wait() == 0, shot.stderr
        end = simulate(table, (-2.0, 0.5), positions=ends).final_positions
        assert format_position('C', end[0]) in shot.stdout
        assert 'integrator event' in shot.stdout


def test_a_node_of_another_name_in_a_namespace(domain):
    names = ['--ros-args', '-r', '__ns:=/hall']
    with (
        node_process(*names, '-r', '__node:=left', **QUICK),
        Process('cli.shot', '3', '--node', 'left', *PATIENT, *names) as shot,
    ):
        assert shot.wait() == 0, shot.stderr


@pytest.mark.parametrize(
    ('args', 'words'),
    [
        (['5'], 'UNKNOWN_SHOT'),
        (['--velocity', '99', '0'], 'TOO_FAST'),
        (['--velocity', '0', '0'], 'BAD_VELOCITY'),
    ],
)
def test_a_rejection_is_one_clear_line_and_status_1(simulator, args, words):
    with Process('cli.shot', *args, *PATIENT) as shot:
        assert shot.wait() == 1
        assert words in shot.stderr and shot.stderr.count('\n') == 1
        assert shot.stdout == ''


def test_no_node_is_one_clear_line_and_status_1(domain):
    with Process('cli.shot', '1', '--node', '/nobody', '--timeout', '0.2') as shot:
        assert shot.wait() == 1
        assert '/nobody' in shot.stderr and shot.stderr.count('\n') == 1


def test_a_node_that_dies_in_the_middle_is_one_clear_line_and_status_1(domain):
    with other_simulator() as node:
        with Process('cli.shot', *STRIKE_OTHER, '--timeout', '15') as shot:
            shot.wait_for('accepted')
            node.signal(9)
            assert shot.wait() == 1
            assert 'silent' in shot.stderr and shot.stderr.count('\n') == 1


@pytest.mark.soak
def test_a_node_that_is_restarted_in_the_middle_is_one_clear_line_and_status_1(domain):
    with other_simulator() as node:
        with Process('cli.shot', *STRIKE_OTHER, '--timeout', '100') as shot:
            shot.wait_for('accepted')
            node.signal(9)
            node.wait()
            with other_simulator():
                assert shot.wait() == 1
            assert 'restarted' in shot.stderr and shot.stderr.count('\n') == 1


def test_ctrl_c_is_one_clear_line(domain):
    with other_simulator():
        with Process('cli.shot', *STRIKE_OTHER, *PATIENT) as shot:
            shot.wait_for('accepted')
            shot.interrupt()
            assert shot.wait() == 130, shot.stderr
            assert shot.stderr.count('\n') == 1


@pytest.mark.parametrize('args', [[], ['1', '--velocity', '1', '0'], ['one'], ['--velocity', '1']])
def test_wrong_usage_is_explained(domain, args):
    with Process('cli.shot', *args) as shot:
        assert shot.wait() == 2
        assert 'usage: shot' in shot.stderr and 'Traceback' not in shot.stderr


def test_help(domain):
    with Process('cli.shot', '--help') as shot:
        assert shot.wait() == 0
        assert '--velocity' in shot.stdout and '--node' in shot.stdout


def test_a_terminal_shows_progress(domain):
    terminal, slave = pty.openpty()
    args = ['3', '--node', 'other', *PATIENT]
    with other_simulator(0.2), Process('cli.shot', *args, stdout=slave) as shot:
        os.close(slave)
        written = b''
        try:
            while chunk := os.read(terminal, 4096):
                written += chunk
        except OSError:  # how a closed terminal ends
            pass
        os.close(terminal)
        assert shot.wait() == 0, shot.stderr
    assert b'1 ball moves' in written
    assert b'Ball 10: [19.78, 26.81] (in)' in written


def test_the_client_needs_no_physics(domain):
    code = 'import sys, pool_sim_ros.cli.shot; sys.exit("numba" in sys.modules)'
    command = [sys.executable, '-c', code]
    assert subprocess.run(command, timeout=60, check=False).returncode == 0


@pytest.fixture(scope='module')
def pool(domain):
    names = ['--ros-args', '-r', '__node:=pool']
    with node_process(*names, **{'table.preset': '7ft', 'real_time_factor': 20.0}) as process:
        yield process


def on_pool(*args):
    """Return what the command prints that is given these words for a 7-foot table."""
    with Process('cli.shot', *args, '--node', 'pool', *PATIENT) as shot:
        assert shot.wait() == 0, shot.stderr
        assert shot.stderr == ''
        return shot.stdout


def test_a_cue_is_described_by_numbers_of_which_some_are_negative(pool):
    velocity, spin = cue_strike(
        pool_table('7ft'), speed=2.0, azimuth=180.0, side=0.2, above=-0.3, elevation=2.0
    )
    given = ['--cue', '2.0', '180', '--side', '0.2', '--above', '-0.3', '--elevation', '2']
    accepted, _, log = on_pool(*given).partition('\n')
    assert f'[{velocity[0]:.3f}, {velocity[1]:.3f}] m/s' in accepted
    assert f'spin [{", ".join(f"{w:.2f}" for w in spin)}] rad/s' in accepted
    assert log.count('(in)') == 16


def test_the_table_is_driven_without_other_tools(pool):
    assert 'start layout' in on_pool('reset')
    assert on_pool('pause') == 'paused\n'
    first = int(on_pool('step').removeprefix('at tick '))
    assert int(on_pool('step').removeprefix('at tick ')) == first + 1
    placed = on_pool('place', '9', '0.9', '0.3', 'C', '1.4', '0.5')
    assert placed == 'ball 9 at [0.9, 0.3] m, ball C at [1.4, 0.5] m\n'
    assert on_pool('resume') == 'playing\n'
    out = on_pool('--velocity', '-1', '0', '--spin', '0', '-20', '1e1')
    assert 'spin [0.00, -20.00, 10.00] rad/s' in out
    on_pool('reset')
    out = on_pool('--cue', '9', '180.3', '--side', '0.1', '--above', '0.2')
    assert out.rstrip().splitlines()[-1] == '    In pockets: C in 0, 15 in 0'


@pytest.mark.parametrize(
    ('args', 'words'),
    [
        (['step'], 'set_paused first'),
        (['place', '9', '0', '0'], 'BAD_LAYOUT'),
        (['place', 'x', '0.5', '-0.3'], 'BAD_LAYOUT'),
        (['--cue', '2', '180', '--side', '0.7'], 'miscue'),
        (['--cue', '99', '180'], 'TOO_FAST'),
    ],
)
def test_what_the_table_refuses_is_one_clear_line_and_status_1(pool, args, words):
    with Process('cli.shot', *args, '--node', 'pool', *PATIENT) as shot:
        assert shot.wait() == 1
        assert words in shot.stderr and shot.stderr.count('\n') == 1 and shot.stdout == ''


@pytest.mark.parametrize(
    ('args', 'words'),
    [
        (['place'], 'LABEL X Y'),
        (['place', '9', '0.5'], 'LABEL X Y'),
        (['place', '9', '0.5', 'nan'], 'finite'),
        (['place', '9', '0', '0', '9', '1', '1'], 'twice'),
        (['reset', '1'], 'too much'),
        (['1', '2'], 'too much'),
        (['rest'], 'reset, pause, resume, step or place'),
        (['step', '--velocity', '1', '0'], 'does not go with step'),
        (['--velocity', '1', '0', '--side', '0.1'], 'goes with --cue'),
        (['--cue', '1', '0', '--spin', '1', '0', '0'], 'goes with --velocity'),
        (['--cue', '1', '0', '--velocity', '1', '0'], 'either'),
        (['--cue', '1'], '--cue'),
    ],
)
def test_what_does_not_go_together_is_explained(capsys, args, words):
    with pytest.raises(SystemExit) as end:
        _Parser().parse_args(args)
    assert end.value.code == 2 and words in capsys.readouterr().err


def test_options_and_actions_come_in_any_order():
    for words in (['place', '9', '-1', '2'], ['--node', 'x', 'place', '9', '-1', '2']):
        assert _Parser().parse_args(words).places == {'9': (-1.0, 2.0)}
    options = _Parser().parse_args(['place', '--node', 'x', 'C', '1', '2', '9', '.5', '1e-1'])
    assert options.places == {'C': (1.0, 2.0), '9': (0.5, 0.1)} and options.node == 'x'


@pytest.mark.parametrize('args', [['5'], ['--velocity', '0', '0']])
def test_what_no_node_plays_fails_at_once_without_one(domain, args):
    started = time.monotonic()
    with Process('cli.shot', *args, '--node', '/nobody', '--timeout', '600') as shot:
        assert shot.wait() == 1
        assert shot.stderr.startswith('shot: rejected (') and shot.stderr.count('\n') == 1
    assert time.monotonic() - started < 60


@pytest.mark.parametrize('words', [['-1e-1', '0'], ['-4.', '0'], ['0', '-5e-1']])
def test_negative_numbers_of_every_notation_are_played(simulator, words):
    with Process('cli.shot', '--velocity', *words, *PATIENT) as shot:
        assert shot.wait() == 0, shot.stderr
        x, y = map(float, words)
        assert f'cue velocity [{x:.3f}, {y:.3f}] m/s' in shot.stdout


def test_a_reader_that_goes_ends_it_without_a_traceback(simulator):
    """As in `shot 1 | head -1`."""
    command = [sys.executable, '-m', 'pool_sim_ros.cli.shot', '3', *PATIENT]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as shot:
        assert shot.stdout.readline().startswith(b'accepted')
        shot.stdout.close()
        assert shot.stderr.read() == b''
        assert shot.wait(60) == 141


LABEL = '\N{CIRCLED DIGIT ONE}'


def test_a_label_that_the_locale_cannot_print_is_printed_as_an_escape(domain, tmp_path):
    file = tmp_path / 'table.yaml'
    file.write_text(
        '/**:\n  ros__parameters:\n    balls:\n'
        f"      labels: ['C', '{LABEL}']\n      masses: [0.2, 0.2]\n      radii: [0.03, 0.03]\n"
        '      positions: [0.5, 0.5, 1.0, 0.5]\n      colors: [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]\n'
    )
    names = ['--ros-args', '-r', '__node:=other', '--params-file', str(file)]
    env = os.environ | {'PYTHONIOENCODING': 'ascii', 'LC_ALL': 'C'}
    command = [sys.executable, '-m', 'pool_sim_ros.cli.shot', *STRIKE_OTHER, *PATIENT]
    with node_process(*names, real_time_factor=20.0):
        done = subprocess.run(command, capture_output=True, env=env, timeout=120, check=False)
    assert (done.returncode, done.stderr) == (0, b'')
    assert rb'\u2460' in done.stdout
