"""What a command says of a package that is not installed."""

import sys

import pytest

from pool_sim_ros.console import CommandError, missing_line, require


@pytest.mark.parametrize(
    ('modules', 'line'),
    [
        (['rosbags'], 'needs rosbags, not installed here: pip install rosbags'),
        (
            ['aiohttp'],
            'needs aiohttp, not installed here: '
            'apt install python3-aiohttp, or pip install aiohttp',
        ),
        (
            ['imageio_ffmpeg', 'yaml'],
            'needs imageio-ffmpeg, pyyaml, not installed here: pip install imageio-ffmpeg pyyaml',
        ),
        (
            ['tqdm', 'yaml'],
            'needs tqdm, pyyaml, not installed here: '
            'apt install python3-tqdm python3-yaml, or pip install tqdm pyyaml',
        ),
    ],
)
def test_it_says_how_to_install_what_is_missing(modules, line):
    assert missing_line(modules) == line


@pytest.mark.parametrize('module', ['rclpy', 'std_msgs', 'visualization_msgs'])
def test_what_comes_with_ros_is_not_looked_for_on_pypi(module):
    line = missing_line([module])
    assert module in line and 'setup.sh of ROS 2' in line
    assert f'pip install {module}' not in line


def test_what_is_there_is_no_trouble():
    require('json', 'pytest')


def test_what_is_not_there_is_named_and_the_rest_is_not():
    with pytest.raises(CommandError, match='^needs no_such_module, no_other, not installed here: '):
        require('json', 'no_such_module', 'no_other')


def test_what_somebody_has_blocked_is_missing(monkeypatch):
    monkeypatch.setitem(sys.modules, 'aiohttp', None)
    with pytest.raises(CommandError, match='^needs aiohttp, '):
        require('aiohttp')
