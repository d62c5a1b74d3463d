"""The launch file: read as XML everywhere, and really launched where ROS 2 has `launch`."""

import os
import re
import signal
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest
from waiting import PATIENCE

from pool_sim_ros.ros import NODE_NAME

PROJECT = Path(__file__).parents[1]
FILE = PROJECT / 'launch' / 'pool.launch.xml'
ROOT = ElementTree.parse(FILE).getroot()
DEFAULTS = {arg.get('name'): arg.get('default') for arg in ROOT.iter('arg')}
NODES = {node.get('exec'): node for node in ROOT.iter('node')}
"""In the order in which they are started."""


def expand(text, **arguments):
    """Return a text of the launch file as launch expands it."""
    values = DEFAULTS | arguments
    text = text.replace('$(find-pkg-share pool_sim_ros)', str(PROJECT))
    return re.sub(r'\$\(var (\w+)\)', lambda match: expand(values[match[1]]), text)


def test_every_argument_is_described_and_the_defaults_are_those_of_the_node():
    assert set(DEFAULTS) == {'params', 'name', 'namespace', 'rviz', 'page'}
    assert all(arg.get('description') for arg in ROOT.iter('arg'))
    assert (DEFAULTS['name'], DEFAULTS['namespace']) == (NODE_NAME, '')
    assert Path(expand(DEFAULTS['params'])) == PROJECT / 'config' / 'report.yaml'


def test_rviz_comes_first_so_that_nothing_runs_where_it_is_missing():
    """launch looks for a node's package when it starts the node, and ends if there is none."""
    assert list(NODES) == ['rviz2', 'web_view', 'sim_node']
    assert [NODES[name].get('if') for name in NODES] == ['$(var rviz)', '$(var page)', None]
    package = ElementTree.parse(PROJECT / 'package.xml').getroot()
    needed = {dependency.text for dependency in package.iter('exec_depend')}
    assert {'rviz2', 'ros2launch'} <= needed


def test_the_end_of_the_node_ends_everything():
    assert NODES['sim_node'].get('on_exit') == 'shutdown'


def test_the_parameter_file_goes_to_the_node_which_ends_without_it():
    """As a `param` launch would leave out a file that is not there, with a warning."""
    assert list(NODES['sim_node'].iter('param')) == []
    args = expand(NODES['sim_node'].get('args'), params='/my/table.yaml')
    assert args == '--ros-args --params-file /my/table.yaml'


@pytest.mark.parametrize('namespace', ['', '/hall', 'hall', '/hall/east'])
def test_rviz_and_page_show_the_node_of_that_name(namespace):
    named = {'name': 'left', 'namespace': namespace}
    node = NODES['sim_node']
    assert expand(node.get('name'), **named) == 'left'
    assert expand(node.get('namespace'), **named) == namespace
    (remap,) = NODES['rviz2'].iter('remap')
    layout = (PROJECT / 'config' / 'pool_table.rviz').read_text()
    assert remap.get('from') == f'/{NODE_NAME}/markers' and remap.get('from') in layout
    assert expand(remap.get('to'), **named) == f'{namespace}/left/markers'
    page = NODES['web_view']
    assert expand(page.get('args'), **named) == '--node left'
    assert expand(page.get('namespace'), **named) == namespace
    assert page.get('name') is None  # it has nodes of several names


def test_every_file_that_it_names_is_there():
    files = re.findall(r'\$\(find-pkg-share pool_sim_ros\)/([\w./]+)', FILE.read_text())
    assert files and all((PROJECT / file).is_file() for file in files)


RUN = """\
import sys
from launch import LaunchDescription, LaunchService
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import AnyLaunchDescriptionSource

file, *arguments = sys.argv[1:]
source = AnyLaunchDescriptionSource(file)
pairs = [tuple(argument.split(':=', 1)) for argument in arguments]
service = LaunchService(noninteractive=True)
service.include_launch_description(
    LaunchDescription([IncludeLaunchDescription(source, launch_arguments=pairs)])
)
sys.exit(service.run())
"""


@pytest.fixture
def launch(tmp_path, domain):
    """A function that launches the file with stand-ins for what it starts; returns what they say.

    A stand-in prints its arguments. The node then is the true one, the others sleep.
    """
    for package in ('launch', 'launch_xml', 'launch_ros'):
        pytest.importorskip(package, reason=f'{package} comes with a ROS 2 installation')
    share = tmp_path / 'prefix' / 'share'
    index = share / 'ament_index' / 'resource_index' / 'packages'
    index.mkdir(parents=True)
    (share / 'pool_sim_ros').mkdir()
    (share / 'pool_sim_ros' / 'config').symlink_to(PROJECT / 'config')

    def stand_in(package, name, then):
        (index / package).touch()
        script = tmp_path / 'prefix' / 'lib' / package / name
        script.parent.mkdir(parents=True, exist_ok=True)
        script.write_text(f'#!/bin/sh\necho "{name} gets $*"\nexec {then}\n')
        script.chmod(0o755)

    stand_in('pool_sim_ros', 'sim_node', f'{sys.executable} -m pool_sim_ros.cli.sim_node "$@"')
    stand_in('pool_sim_ros', 'web_view', 'sleep 1000')

    def run(*arguments, rviz=True, until=None):
        if rviz:
            stand_in('rviz2', 'rviz2', 'sleep 1000')
        prefixes = [str(tmp_path / 'prefix'), os.environ.get('AMENT_PREFIX_PATH', '')]
        env = os.environ | {
            'AMENT_PREFIX_PATH': os.pathsep.join(filter(None, prefixes)),
            'PYTHONPATH': os.pathsep.join(filter(None, sys.path)),
            'ROS_LOG_DIR': str(tmp_path),
            'OVERRIDE_LAUNCH_PROCESS_OUTPUT': 'screen',
        }
        process = subprocess.Popen(
            [sys.executable, '-c', RUN, str(FILE), *arguments],
            env=env,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        lines = []
        for line in process.stdout:
            lines.append(line)
            if until and until in line:
                process.send_signal(signal.SIGINT)
        process.wait(PATIENCE)
        return ''.join(lines)

    return run


def test_launched_without_rviz_nothing_is_started(launch):
    if 'rviz2' in os.environ.get('AMENT_PREFIX_PATH', '') or Path('/opt/ros').is_dir():
        pytest.skip('RViz may be installed here')
    said = launch(rviz=False)
    assert "package 'rviz2' not found" in said and 'process started' not in said


def test_launched_with_a_file_that_is_not_there_it_ends(launch, tmp_path):
    said = launch(f'params:={tmp_path}/none.yaml')
    assert f'sim_node: the parameter file {tmp_path}/none.yaml cannot be opened\n' in said
    assert 'shutting down launched system' in said and 'Traceback' not in said


def test_launched_with_names_all_parts_get_them(launch):
    said = launch('name:=left', 'namespace:=/hall', 'page:=true', until='ready')
    assert '[hall.left]: ready' in said
    assert re.search(r'web_view gets --node left .*__ns:=/hall', said)
    assert re.search(r'rviz2 gets .*/pool_sim/markers:=/hall/left/markers', said)
