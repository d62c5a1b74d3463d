import os
import signal
import subprocess
import sys
import time
from importlib.util import find_spec
from pathlib import Path

import pytest
from film_reader import frame_times
from page_reader import Page
from process_harness import Process

from pool_sim_ros.report import command

PROJECT = Path(__file__).parents[2]
LOG = PROJECT / 'test' / 'me212' / 'data' / 'published_output.log'
PATIENCE = 120.0


def start(*args, code=None):
    """Start the command, or some code, in a session of its own, as a terminal would."""
    paths = [str(PROJECT), *filter(None, [os.environ.get('PYTHONPATH')])]
    program = ['-c', code] if code else ['-m', 'pool_sim_ros.report']
    return subprocess.Popen(
        [sys.executable, *program, *map(str, args)],
        env={**os.environ, 'PYTHONPATH': os.pathsep.join(paths)},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def finish(process):
    """Wait for its end and return (status, standard output, standard error)."""
    try:
        out, err = process.communicate(timeout=PATIENCE)
    finally:
        if process.poll() is None:
            process.kill()
            process.communicate()
    return process.returncode, out, err


def run(*args, cwd=None):
    """Run the command to its end."""
    with Process('report', *args, folder=cwd) as process:
        status = process.wait()
    return status, process.stdout, process.stderr


def all_files(folder):
    return sorted(str(p.relative_to(folder)) for p in folder.rglob('*') if p.is_file())


@pytest.fixture(scope='module')
def made(tmp_path_factory):
    """A folder with everything for shot 3, and what the command said."""
    folder = tmp_path_factory.mktemp('made')
    return folder / 'report', run('--shots', 3, cwd=folder)


def test_the_log_is_the_published_one_character_for_character(tmp_path):
    status, out, err = run('--log-only', '--out', tmp_path)
    assert (status, err) == (0, '')
    assert (tmp_path / 'output.log').read_bytes() == LOG.read_bytes()
    assert all_files(tmp_path) == ['output.log']
    assert '44 of 44 end positions equal the printed ones' in out


def test_everything_is_written_to_report_by_default(made):
    folder, (status, out, err) = made
    assert (status, err) == (0, '')
    assert all_files(folder) == [
        'images/Part_1_construction.png',
        'images/Part_1_setup.png',
        'images/Simulation_3_end.png',
        'images/Simulation_3_start.png',
        'images/Table_layout.png',
        'output.log',
        'positions.csv',
        'report.html',
        'videos/collision_3.mp4',
        'videos/combinedCollisions.mp4',
    ]
    assert '11 of 11 end positions equal the printed ones' in out


def test_the_log_of_some_shots_has_those_and_the_head(made):
    folder, _ = made
    parts = LOG.read_text().split('\n\n')
    assert (folder / 'output.log').read_text() == f'{parts[0]}\n\n{parts[3]}\n\n'


def test_every_link_on_the_page_leads_somewhere(made):
    folder, _ = made
    page = Page((folder / 'report.html').read_text())
    assert 'images/Simulation_3_end.png' in page.links
    assert 'videos/collision_3.mp4' in page.links
    for link in page.links:
        if link.startswith('#'):
            assert f'id="{link[1:]}"' in (folder / 'report.html').read_text()
        else:
            assert (folder / link).is_file(), link


def test_the_combined_film_of_one_shot_is_its_film(made):
    folder, _ = made
    alone, combined = (
        frame_times(folder / f'videos/{name}.mp4') for name in ('collision_3', 'combinedCollisions')
    )
    # Shot 3 ends after 1.41 s: 85 frames until all rest, the one at t = 0, and one second.
    assert len(alone) == 86 + 60
    assert combined == alone


def test_another_table_without_films(tmp_path):
    table = tmp_path / 'one.yaml'
    table.write_text(
        '/**:\n  ros__parameters:\n    report_integrator: event\n    balls:\n'
        "      labels: ['X']\n      masses: [0.2]\n      radii: [0.03]\n"
        '      positions: [1.0, 0.5]\n      colors: [0.0, 0.0, 0.0]\n'
    )
    args = ('--table', table, '--out', tmp_path / 'out', '--no-videos')
    status, out, err = run(*args)
    assert (status, out) == (1, '')
    assert err == 'report: shot 4: the cue ball is alone on this table; there is no nearest ball\n'
    assert not (tmp_path / 'out').exists()
    status, out, err = run(*args, '--shots', 1, 2)
    assert (status, err) == (0, '')
    assert 'printed nothing for this table' in out
    log = (tmp_path / 'out' / 'output.log').read_text()
    first = 'Not the run that the report printed: another table, integrator event\n\nSimulation 1:'
    assert log.startswith(first)
    assert not (tmp_path / 'out' / 'videos').exists()


def test_a_table_with_any_labels_is_drawn(tmp_path):
    pytest.importorskip('latex2mathml', reason='pip install latex2mathml')
    labels = [
        r'C',
        r'\0\x1b[8m',
        r'a\nb',
        r'\u202e',
        r'\U0001F600',
        r'$\\frac',
        r'</svg>',
    ]
    count, quoted = len(labels), ', '.join(f'"{label}"' for label in labels)
    table = tmp_path / 'weird.yaml'
    table.write_text(
        '/**:\n  ros__parameters:\n    report_integrator: event\n    balls:\n'
        f'      labels: [{quoted}]\n'
        f'      masses: {[0.2] * count}\n      radii: {[0.03] * count}\n'
        f'      positions: {[0.12 * (1 + i // 2) for i in range(2 * count)]}\n'
        f'      colors: {[0.5] * 3 * count}\n'
    )
    status, out, err = run(
        *('--table', table, '--out', tmp_path / 'out', '--no-videos', '--shots', 4), cwd=tmp_path
    )
    assert (status, err) == (0, ''), err
    assert 'report.html' in out


def test_half_a_character_is_none_to_ros_either(tmp_path):
    """libyaml, which ROS reads with, refuses it; so one line says so here."""
    table = tmp_path / 'half.yaml'
    table.write_text('/**:\n  ros__parameters:\n    balls:\n      labels: ["\\ud800"]\n')
    status, out, err = run('--table', table, '--out', tmp_path / 'out', '--log-only', cwd=tmp_path)
    assert status == 1 and out == '' and err.count('\n') == 1 and 'line 4' in err


def test_a_tilde_is_the_home_of_the_user(tmp_path, monkeypatch):
    monkeypatch.setenv('HOME', str(tmp_path))
    status, _, err = run('--log-only', '--shots', 3, '--out', '~/made', cwd=tmp_path)
    assert (status, err) == (0, '')
    assert all_files(tmp_path) == ['made/output.log']


def test_the_integrator_can_be_chosen(tmp_path):
    status, out, err = run('--log-only', '--integrator', 'event', '--out', tmp_path)
    assert (status, err) == (0, '')
    log = (tmp_path / 'output.log').read_text()
    assert log.startswith('Not the run that the report printed: integrator event\n\nClosest ball')
    # The exact ends of shot 4, of which the print is one of two accidental branches.
    assert 'Ball  1: [30.42, 20.58] (in)' in log
    assert 'not of this run' in out


MISTAKES = [
    (['--out', '/proc/report'], 1, 'cannot write /proc/report/output.log: '),
    (['--out', '/dev/null'], 1, '/dev/null is not a folder'),
    (['--table', 'none.yaml'], 1, 'cannot read none.yaml: No such file or directory'),
    (['--shots', '5'], 2, 'invalid choice: 5'),
    (['--out', ''], 2, 'argument --out: the name is empty'),
    (['--table', ''], 2, 'argument --table: the name is empty'),
    (['--shots'], 2, 'expected at least one argument'),
    (['--integrator', 'euler'], 2, "invalid choice: 'euler'"),
    (['extra'], 2, 'unrecognized arguments: extra'),
]


@pytest.mark.parametrize(('args', 'status', 'words'), MISTAKES)
def test_mistakes_are_told_in_one_line(tmp_path, monkeypatch, capsys, args, status, words):
    monkeypatch.chdir(tmp_path)
    try:
        ended = command.main([*args, '--log-only'])
    except SystemExit as end:
        ended = end.code
    assert_told(tmp_path, (ended, *capsys.readouterr()), status, words)


@pytest.mark.parametrize(('args', 'status', 'words'), MISTAKES[2:4])
def test_so_are_they_to_a_user(tmp_path, args, status, words):
    assert_told(tmp_path, run(*args, '--log-only', cwd=tmp_path), status, words)


def assert_told(folder, found, status, words):
    ended, out, err = found
    assert (ended, out) == (status, '')
    assert words in err.splitlines()[-1]
    assert 'Traceback' not in err
    assert status == 2 or len(err.splitlines()) == 1
    assert all_files(folder) == []


def test_a_full_disk_is_told_in_one_line_and_leaves_nothing_half_written(tmp_path):
    folder = tmp_path / 'small'
    folder.mkdir()
    mount = ['mount', '-t', 'tmpfs', '-o', 'size=600k', 'tmpfs', str(folder)]
    try:
        mounted = subprocess.run(mount, capture_output=True).returncode == 0
    except OSError:
        mounted = False
    if not mounted:
        pytest.skip('only root may mount the small disk that this needs')
    try:
        status, _, err = run('--shots', 3, '--out', folder)
        whole = all_files(folder)
    finally:
        subprocess.run(['umount', str(folder)], check=True)
    assert status == 1
    assert 'No space left on device' in err
    assert len(err.splitlines()) == 1
    assert 'output.log' in whole
    assert 'report.html' not in whole
    assert not any(name.endswith('.part') for name in whole)


@pytest.mark.parametrize(('number', 'group'), [(signal.SIGINT, True), (signal.SIGTERM, False)])
def test_an_interrupt_while_a_film_is_made_leaves_only_whole_files(tmp_path, number, group):
    process = start('--shots', 1, '--out', tmp_path)
    deadline = time.monotonic() + PATIENCE
    while not list(tmp_path.glob('videos/.collision_1.mp4.*.part')):
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < deadline
        time.sleep(0.01)
    if group:
        # As Ctrl-C in a terminal: all processes of the group get it.
        os.killpg(process.pid, number)
    else:
        process.send_signal(number)
    status, out, err = finish(process)
    assert status == 130
    assert err == '\nreport: interrupted; the files that are there are whole\n'
    assert list((tmp_path / 'videos').iterdir()) == []
    assert 'images/Simulation_1_end.png' in all_files(tmp_path)
    assert 'report.html' not in all_files(tmp_path)


def test_a_missing_package_is_told_before_the_work_begins(tmp_path, monkeypatch, capsys):
    def find(name):
        return None if name in ('matplotlib', 'imageio_ffmpeg') else find_spec(name)

    monkeypatch.setattr(command, 'find_spec', find)
    assert command.main(['--out', str(tmp_path)]) == 1
    assert capsys.readouterr().err == (
        'report: needs matplotlib, imageio-ffmpeg, not installed here: '
        'pip install matplotlib imageio-ffmpeg\n'
    )
    assert all_files(tmp_path) == []
    assert command.main(['--out', str(tmp_path), '--log-only', '--shots', '3']) == 0


def test_help_loads_nothing_heavy_and_nothing_here_loads_ros():
    code = (
        'import sys, pool_sim_ros.report.command as command\n'
        'try: command.main(["--help"])\n'
        'except SystemExit: pass\n'
        'print("MODULES", *sys.modules)\n'
        'from pool_sim_ros.report import outputs, page, positions, comparison, table_file\n'
        'print("MODULES", *sys.modules)\n'
    )
    status, out, err = finish(start(code=code))
    assert (status, err) == (0, '')
    text, light, full = out.split('MODULES')
    for option in ('--out', '--shots', '--integrator', '--table', '--no-videos', '--log-only'):
        assert option in text
    assert not {'numpy', 'numba', 'matplotlib', 'yaml', 'tqdm'} & set(light.split())
    assert {'numba', 'matplotlib'} <= set(full.split())
    assert not {'rclpy', 'rcl_interfaces', 'std_msgs'} & set(full.split())
    assert 'matplotlib.pyplot' not in full.split()
