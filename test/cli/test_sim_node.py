"""The command `sim_node`: how it starts, fails and stops."""

import json
import signal

import pytest
from process_harness import node_process, start_node
from ros_harness import Observer


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM], ids=lambda n: n.name)
@pytest.mark.parametrize('computing', [False, True], ids=['at rest', 'computing'])
def test_a_signal_ends_the_node_without_a_word(ros, number, computing):
    # A shot that takes hours to compute: to wait for its end would show.
    parameters = {
        'time_slice': '0.0000001',
        'table.mu_ball_surface': 0.0001,
        'max_shot_duration': 100000.0,
    }
    with node_process(anew=not computing, **parameters) as process:
        if computing:
            observer = Observer(ros).wait_for_match()
            shot = observer.ask(shot=1)
            observer.wait_for_phase(shot, 'accepted')
            ros.spin_until(lambda: observer.state['computing'], 'the computation')
        process.signal(number)
        assert process.wait() == 0
        assert 'Traceback' not in process.stderr


GOOD = """
/**:
  ros__parameters:
    balls:
      labels: ['C', 'red']
      masses: [0.2, 0.1]
      radii: [0.05, 0.05]
      positions: [0.2, 0.3, 1.0, 0.4]
      colors: [1.0, 1.0, 1.0, 1.0, 0.0, 0.0]
"""


def test_a_parameter_file_makes_the_table(ros, tmp_path):
    file = tmp_path / 'good.yaml'
    file.write_text(GOOD)
    with node_process('--ros-args', '--params-file', str(file)):
        observer = Observer(ros).wait_for_match()
        balls = json.loads(observer.heard['table'][-1].data)['balls']
        assert [ball['label'] for ball in balls] == ['C', 'red']


@pytest.mark.parametrize(
    ('old', 'new', 'words'),
    [
        ('1.0, 0.4]', '0.25, 0.3]', ["'C'", "'red'", 'overlap']),
        ('1.0, 0.4]', '7.0, 0.4]', ["'red'", 'outside']),
        ('[0.2, 0.1]', '[0.2]', ['balls.masses', '1', '2']),
        ('[0.2, 0.1]', '[0.2, -0.1]', ["'red'", 'mass']),
        ('[0.2, 0.1]', '[]', ['balls.masses']),
        ('      masses: [0.2, 0.1]\n', '', ['balls.masses is missing']),
        ("['C', 'red']", '[1, 2]', ['balls.labels']),
        ("['C', 'red']", "['C', 1]", ['line_num 5', 'quote']),
        ('[0.2, 0.1]', '[1, 0.1]', ['line_num 6', 'decimal point']),
        ('[0.2, 0.1]', '[0.2, 0.1', ['line']),
        ('    balls:', '   balls:\n  x', ['line']),
        ('    balls:', '    table: {lenght: 2.0}\n    balls:', ['table.lenght', 'table.length']),
        ('    balls:', '    table: {e_cue_ball: 2.0}\n    balls:', ['table.e_cue_ball', '2.0']),
        ('    balls:', '    publish_rate: fast\n    balls:', ['publish_rate', "'fast'"]),
    ],
)
def test_a_bad_parameter_file_is_refused_in_one_line(domain, tmp_path, old, new, words):
    assert old in GOOD
    file = tmp_path / 'bad.yaml'
    file.write_text(GOOD.replace(old, new))
    with start_node('--ros-args', '--params-file', str(file)) as process:
        assert process.wait() == 1
        assert process.stdout == ''
        assert process.stderr.count('\n') == 1
        for word in words:
            assert word in process.stderr


@pytest.mark.parametrize(
    ('args', 'word'),
    [
        (['--ros-args', '--params-file', 'nowhere.yaml'], 'nowhere.yaml'),
        (['--ros-args', '-r', '__node:=not a name'], 'not a name'),
        (['--ros-args', '--no-such-argument'], '--no-such-argument'),
        (['--ros-args', '-p', 'table.length:=wide'], 'table.length'),
    ],
)
def test_bad_ros_arguments_are_refused_in_one_line(domain, args, word):
    with start_node(*args) as process:
        assert process.wait() == 1
        assert word in process.stderr and process.stderr.count('\n') == 1


def test_help_names_every_topic_and_parameter(domain):
    with start_node('--help') as process:
        assert process.wait() == 0
        for word in ('~/shot/request', '/clock', 'balls.positions', 'real_time_factor'):
            assert word in process.stdout


def test_a_log_that_exists_is_refused_in_one_line(domain, tmp_path):
    log = tmp_path / 'session.log'
    log.write_text('precious')
    with start_node(record=log) as process:
        assert process.wait() == 1
        assert 'record' in process.stderr and str(log) in process.stderr
        assert process.stderr.count('\n') == 1
    assert log.read_text() == 'precious'


def test_a_tilde_is_the_home_of_the_user(ros, tmp_path, monkeypatch):
    monkeypatch.setenv('HOME', str(tmp_path))
    (tmp_path / 'table.yaml').write_text(GOOD)
    with node_process('--ros-args', '--params-file', '~/table.yaml', '-p', 'record:=~/session.log'):
        observer = Observer(ros).wait_for_match()
        assert len(json.loads(observer.heard['table'][-1].data)['balls']) == 2
        assert (tmp_path / 'session.log').is_file()


def test_a_tilde_in_a_parameter_file_is_the_home_too(domain, tmp_path, monkeypatch):
    monkeypatch.setenv('HOME', str(tmp_path))
    file = tmp_path / 'record.yaml'
    file.write_text('/**:\n  ros__parameters:\n    record: "~/session.log"\n')
    with node_process('--ros-args', '--params-file', str(file)):
        assert (tmp_path / 'session.log').is_file()
