"""Every command where ROS, or another package, is not installed."""

import os
import subprocess
import sys

import pytest

COMMANDS = {
    'sim_node': ('cli.sim_node', []),
    'shot': ('cli.shot', ['1']),
    'record_shot': ('cli.record_shot', ['1']),
    'replay': ('cli.replay', ['session.log']),
    'web_view': ('web_view.command', []),
    'oracle': ('cli.oracle', []),
    'aim': ('cli.aim', ['--ball', '9', '--to', '0.3', '0.2']),
    'demo': ('cli.demo', []),
    'play': ('cli.play', []),
    'report': ('report.command', []),
}
"""What a user calls a command -> its module, and arguments that it takes."""

ROS = [
    'rclpy',
    'std_msgs',
    'geometry_msgs',
    'visualization_msgs',
    'rcl_interfaces',
    'rosgraph_msgs',
]

BLOCK = """\
import sys
from importlib import import_module

for name in [name for name in sys.modules if name.partition('.')[0] in {missing}]:
    del sys.modules[name]
sys.modules.update(dict.fromkeys({missing}))
sys.exit(import_module('pool_sim_ros.{module}').main({args}))
"""


def run(command, missing, args=None, cwd=None):
    """Run a command in a process that has not some modules; return status, output, errors."""
    module, usual = COMMANDS[command]
    args = usual if args is None else args
    code = BLOCK.format(missing=missing, module=module, args=args)
    done = subprocess.run(
        [sys.executable, '-c', code],
        capture_output=True,
        text=True,
        timeout=120,
        cwd=cwd,
        check=False,
        env=os.environ | {'PYTHONPATH': os.pathsep.join(filter(None, sys.path))},
    )
    return done.returncode, done.stdout, done.stderr


@pytest.mark.parametrize('command', sorted(COMMANDS))
def test_help_needs_no_ros(command):
    status, out, err = run(command, [*ROS, 'aiohttp', 'rosbags'], ['--help'])
    assert (status, err) == (0, '')
    assert out.startswith('usage: ') and command in out


@pytest.mark.parametrize('command', sorted(COMMANDS))
def test_wrong_usage_is_explained_without_ros(command):
    status, out, err = run(command, ROS, [*COMMANDS[command][1], '--no-such-option'])
    assert (status, out) == (2, '')
    assert 'unrecognized arguments: --no-such-option' in err and 'Traceback' not in err


@pytest.mark.parametrize('command', sorted(set(COMMANDS) - {'report'}))
def test_without_ros_one_line_says_what_is_missing(command, tmp_path):
    status, out, err = run(command, ROS, cwd=tmp_path)
    assert (status, out) == (1, '')
    assert err.startswith(f'{command}: needs rclpy, not installed here: source the setup.sh of ROS')
    assert err.count('\n') == 1


@pytest.mark.parametrize(
    ('command', 'missing'),
    [
        ('web_view', 'aiohttp'),
        ('play', 'aiohttp'),
        ('record_shot', 'rosbags'),
        ('report', 'latex2mathml'),
        ('report', 'matplotlib'),
        ('sim_node', 'visualization_msgs'),
        ('sim_node', 'numba'),
        ('shot', 'numpy'),
        ('oracle', 'sensor_msgs'),
    ],
)
def test_any_other_package_is_named_the_same_way(domain, command, missing, tmp_path):
    status, out, err = run(command, [missing], cwd=tmp_path)
    assert (status, out) == (1, '')
    assert err.startswith(f'{command}: needs {missing}, not installed here: ')
    assert err.count('\n') == 1 and 'pool_sim_ros[' not in err
    assert list(tmp_path.iterdir()) == []


def test_the_report_needs_no_ros(tmp_path):
    status, out, err = run('report', ROS, ['--log-only', '--shots', '3', '--out', str(tmp_path)])
    assert (status, err) == (0, '')
    assert (tmp_path / 'output.log').is_file()
