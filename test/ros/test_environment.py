"""What ROS is given from outside: each fault is one line, and ROS is not started with it."""

import os
import subprocess
import sys

import pytest
from bounded_process import assert_one_line, run_bounded
from thinned import every, soak

from pool_sim_ros.ros import environment
from pool_sim_ros.ros.environment import (
    DEEPEST,
    LARGEST_DOMAIN,
    MAX_FILE,
    MOST_ITEMS,
    StartupError,
    check_arguments,
    check_environment,
)


@pytest.fixture
def home(tmp_path):
    folder = tmp_path / 'home'
    folder.mkdir()
    return {'HOME': str(folder)}


def fault(environment):
    with pytest.raises(StartupError) as error:
        check_environment(environment)
    assert '\n' not in str(error.value) and len(str(error.value)) < 300
    return str(error.value)


@pytest.mark.parametrize('domain', ['', '0', '7', ' 7', '+7', '101', str(LARGEST_DOMAIN)])
def test_a_domain_that_there_is(home, domain):
    check_environment(home | {'ROS_DOMAIN_ID': domain})


@pytest.mark.parametrize(
    'domain', ['abc', '500', '233', '-1', '1.0', '0x1', '7x', '1 2', '9' * 5000]
)
def test_a_domain_that_there_is_not(home, domain):
    words = fault(home | {'ROS_DOMAIN_ID': domain})
    assert words.startswith('ROS_DOMAIN_ID must be a whole number from 0 to 232')
    assert repr(domain[:30])[:-1] in words


def test_a_middleware_that_is_not_installed(home, tmp_path):
    check_environment(home | {'RMW_IMPLEMENTATION': 'rmw_fastrtps_cpp'})
    words = fault(home | {'RMW_IMPLEMENTATION': 'rmw_nothing_cpp'})
    assert 'rmw_nothing_cpp' in words and 'rmw_fastrtps_cpp' in words
    index = tmp_path / 'share' / 'ament_index' / 'resource_index' / 'rmw_typesupport'
    index.mkdir(parents=True)
    (index / 'rmw_nothing_cpp').touch()
    check_environment(
        home | {'RMW_IMPLEMENTATION': 'rmw_nothing_cpp', 'AMENT_PREFIX_PATH': f'/x:{tmp_path}'}
    )


@pytest.mark.parametrize('name', ['RCUTILS_LOGGING_USE_STDOUT', 'RCUTILS_COLORIZED_OUTPUT'])
def test_a_switch_is_0_or_1(home, name):
    for value in ('', '0', '1'):
        check_environment(home | {name: value})
    assert fault(home | {name: 'yes'}) == f"{name} must be 0 or 1, not 'yes'"


def test_where_the_logs_go_is_made_or_told(home, tmp_path):
    assert 'HOME is not set' in fault({})
    assert 'HOME is not set' in fault({'ROS_LOG_DIR': '~/log'})
    check_environment({'ROS_LOG_DIR': str(tmp_path / 'a' / 'b')})
    check_environment({'ROS_HOME': str(tmp_path / 'c')})
    check_environment(home | {'ROS_LOG_DIR': '~/logs'})
    check_environment(home)
    for folder in ('a/b', 'c/log', 'home/logs', 'home/.ros/log'):
        assert (tmp_path / folder).is_dir()
    (tmp_path / 'file').touch()
    for bad in (tmp_path / 'file', tmp_path / 'file' / 'log', '/proc/nowhere', '/dev/null', 'a\0b'):
        words = fault(home | {'ROS_LOG_DIR': str(bad)})
        assert words.startswith('ROS cannot keep its logs in ') and 'set ROS_LOG_DIR' in words


def test_security_needs_keys(home):
    asked = home | {'ROS_SECURITY_ENABLE': 'true', 'ROS_SECURITY_STRATEGY': 'Enforce'}
    assert 'ROS_SECURITY_KEYSTORE is not set' in fault(asked)
    check_environment(asked | {'ROS_SECURITY_KEYSTORE': '/keys'})
    check_environment(asked | {'ROS_SECURITY_STRATEGY': 'Permissive'})


def arguments_with(text, tmp_path, name='table.yaml'):
    file = tmp_path / name
    file.write_text(text)
    return ['1', '--ros-args', '-p', 'a:=1', '--params-file', str(file)]


def test_parameter_files_are_looked_at_before_ros_reads_them(tmp_path):
    check_arguments(arguments_with('/**: {a: [1.0, 2.0]}\n', tmp_path))
    check_arguments(['--params-file', 'nowhere.yaml', '--ros-args', '--', '--params-file', 'x'])
    for text, words in (
        ('[' * (DEEPEST + 1), 'nested too deeply'),
        ('{a: ' * (DEEPEST + 1), 'nested too deeply'),
        ('1,' * MOST_ITEMS + '\n', 'commas and lines'),
        ('x' * (MAX_FILE + 1), f'at most {MAX_FILE}'),
    ):
        arguments = arguments_with(text, tmp_path)
        with pytest.raises(StartupError, match=f'the parameter file {arguments[-1]} .*{words}'):
            check_arguments(arguments)
    with pytest.raises(StartupError, match='the argument .* is nested too deeply'):
        check_arguments(['--ros-args', '-p', 'a:=' + '[' * 1000])
    os.mkfifo(tmp_path / 'pipe')
    for file, words in (
        (tmp_path / 'pipe', 'not a regular file'),
        (tmp_path, 'Is a directory'),
        (tmp_path / 'none', 'No such file'),
        ('/dev/zero', 'not a regular file'),
    ):
        with pytest.raises(StartupError, match=f'the parameter file {file} .*{words}'):
            check_arguments(['--ros-args', '--params-file', str(file)])


def test_it_needs_nothing_of_ros():
    run = f'runpy.run_path({environment.__file__!r})'
    code = f'import runpy, sys; {run}; sys.exit("rclpy" in sys.modules)'
    assert subprocess.run([sys.executable, '-c', code], timeout=60, check=False).returncode == 0


SHOT = ('cli.shot', '1', '--timeout', '1')
SECURE = {'ROS_SECURITY_ENABLE': 'true', 'ROS_SECURITY_STRATEGY': 'Enforce'}


COMMANDS = [SHOT, ('cli.sim_node',), ('web_view', '--port', '0')]
FAULTS = [
    ({'HOME': None}, ['HOME is not set']),
    ({'ROS_LOG_DIR': '/proc/nowhere'}, ['/proc/nowhere', 'ROS_LOG_DIR']),
    ({'ROS_DOMAIN_ID': 'abc'}, ['ROS_DOMAIN_ID', "'abc'"]),
    ({'ROS_DOMAIN_ID': '500'}, ['ROS_DOMAIN_ID', '232', "'500'"]),
    ({'RCUTILS_COLORIZED_OUTPUT': 'x'}, ['RCUTILS_COLORIZED_OUTPUT']),
    ({'RMW_IMPLEMENTATION': 'rmw_nothing_cpp'}, ['RMW_IMPLEMENTATION', 'rmw_nothing_cpp']),
    (SECURE, ['ROS_SECURITY_KEYSTORE']),
    (SECURE | {'ROS_SECURITY_KEYSTORE': '/nowhere'}, ['SECURITY', '/nowhere/enclaves']),
    ({'ROS_STATIC_PEERS': 'no such host'}, ['cannot make a node', 'no such host']),
]


@pytest.mark.parametrize(
    ('fault', 'command'),
    every(3, FAULTS, COMMANDS),
    ids=lambda value: ' '.join(value[0])[:40] if isinstance(value[0], dict) else value[0],
)
def test_a_command_says_in_one_line_why_ros_cannot_start(domain, fault, command):
    """Each fault with one of the commands; with all of them in the soak."""
    environment, words = fault
    process = run_bounded(*command, **environment)
    assert_one_line(process, (1, 2), *words)
    assert 'arguments' not in process.stderr and 'Traceback' not in process.stderr


@pytest.mark.parametrize('command', [('cli.play', '--port', '0'), ('cli.demo', '--speed', '0')])
@pytest.mark.parametrize('variables', [{'HOME': None}, {'ROS_DOMAIN_ID': '500'}])
def test_what_starts_commands_looks_before_it_starts_them(domain, command, variables):
    assert_one_line(run_bounded(*command, **variables), [1], *variables)


def test_security_that_the_middleware_has_not_is_told(domain, tmp_path):
    (tmp_path / 'enclaves').mkdir()
    process = run_bounded(*SHOT, **SECURE, ROS_SECURITY_KEYSTORE=tmp_path)
    assert_one_line(process, [1], 'shot: ', 'cannot make a node', 'security')


@pytest.mark.parametrize(
    ('text', 'words'),
    [
        ('a: &a [*a]', 'alias'),
        ('time_slice: ' + '9' * 400, 'time_slice'),
        ('a: ' + '{b: ' * 200_000, 'deeply'),
        ('table: {length: [true]}', 'table.length'),
        ('\0', 'cannot be read'),
        *soak(
            ('a: &a [1.0]\nb: *a', 'alias'),
            ('time_slice: true', 'time_slice'),
            ('a: ' + '[' * 200_000, 'deeply'),
            ('a: [' + '1.5, ' * 500_000 + '1.5]', 'commas'),
        ),
    ],
    ids=lambda value: repr(value)[:20],
)
def test_a_foreign_parameter_file_is_refused_in_one_line(domain, tmp_path, text, words):
    file = tmp_path / 'table.yaml'
    lines = ''.join(f'    {line}\n' for line in text.splitlines())
    file.write_text(f'/**:\n  ros__parameters:\n{lines}')
    process = run_bounded('cli.sim_node', '--ros-args', '--params-file', file)
    assert_one_line(process, [1], words)
