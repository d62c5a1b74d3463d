"""Commands that take part in ROS: with it, without it, and with one that is broken."""

import argparse
import subprocess
import sys

import pytest

from pool_sim_ros.ros.command import before_ros_args, ros_command, with_home


def parser():
    parser = argparse.ArgumentParser(prog='play_it', description='Play it.')
    parser.add_argument('number', type=int)
    return parser


@pytest.fixture
def without_ros(monkeypatch):
    """Hide rclpy from whoever imports it from now on."""
    for name in [name for name in sys.modules if name.partition('.')[0] == 'rclpy']:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.delitem(sys.modules, 'pool_sim_ros.ros.process', raising=False)
    monkeypatch.setitem(sys.modules, 'rclpy', None)


def command():
    @ros_command('play_it', parser)
    def main(context, options):
        raise AssertionError('there is no ROS to run it with')

    return main


def test_without_ros_it_still_explains_itself(without_ros, capsys):
    for args, status in ((['--help'], 0), (['three'], 2), (['3', '--fast'], 2)):
        with pytest.raises(SystemExit) as error:
            command()(args)
        assert error.value.code == status
        out, err = capsys.readouterr()
        assert 'usage: play_it' in (out if status == 0 else err)


@pytest.mark.parametrize('more', [[], ['--ros-args', '-r', '__ns:=/hall']])
def test_without_ros_it_says_what_is_missing_in_one_line(without_ros, capsys, more):
    assert command()(['3', *more]) == 1
    out, err = capsys.readouterr()
    assert out == '' and err.startswith('play_it: needs rclpy, not installed here: ')
    assert err.count('\n') == 1


def test_a_ros_that_cannot_be_loaded_is_told_in_one_line(tmp_path):
    broken = tmp_path / 'rclpy'
    broken.mkdir()
    (broken / '__init__.py').write_text(
        'text = "librcl.so: cannot open shared object file\\nsource ROS first"\n'
        'raise ImportError(text, name="rclpy._rclpy")\n'
    )
    code = (
        'import argparse, sys\n'
        f'sys.path.insert(0, {str(tmp_path)!r})\n'
        'from pool_sim_ros.ros import ros_command\n'
        'sys.exit(ros_command("play_it", argparse.ArgumentParser)(lambda context, options: 0)([]))'
    )
    done = subprocess.run([sys.executable, '-c', code], capture_output=True, text=True, timeout=60)
    assert done.returncode == 1
    assert done.stderr == (
        'play_it: rclpy cannot be loaded: librcl.so: cannot open shared object file '
        'source ROS first\n'
    )


def test_a_name_that_is_too_long_with_its_namespace_is_one_line(domain, capsys):
    @ros_command('play_it', argparse.ArgumentParser)
    def main(context, options):
        from pool_sim_ros.ros import SimulatorLink, interface

        link = SimulatorLink(context, 'a' * 200, 'test')
        try:
            link.publisher(interface.SHOT_REQUEST)
        finally:
            link.close()

    assert main(['--ros-args', '-r', f'__ns:=/{"b" * 60}']) == 1
    err = capsys.readouterr().err
    assert err.startswith('play_it: ') and err.count('\n') == 1


def test_the_home_is_put_in_for_a_tilde_before_a_parameter_file_alone(monkeypatch):
    monkeypatch.setenv('HOME', '/home/anna')
    args = ['--ros-args', '--params-file', '~/table.yaml', '-r', 'chatter:=~/chatter', '~/rest']
    assert with_home(args) == [
        *['--ros-args', '--params-file', '/home/anna/table.yaml'],
        *['-r', 'chatter:=~/chatter', '~/rest'],
    ]
    assert with_home([]) == []
    assert with_home(['--params-file']) == ['--params-file']


def test_an_argument_that_is_no_utf_8_is_told_in_one_line(capsys):
    assert command()(['3', '\udcff.mcap']) == 1
    told = "play_it: the argument '\\udcff.mcap' is no UTF-8 text, which ROS asks for\n"
    assert capsys.readouterr() == ('', told)


def test_what_stands_before_the_arguments_for_ros():
    assert before_ros_args(['1', '--node', 'a', '--ros-args', '-r', 'x:=y']) == ['1', '--node', 'a']
    assert before_ros_args(['1']) == ['1']


def test_the_room_itself_needs_no_ros():
    code = (
        'import sys\n'
        'from pool_sim_ros.ros import NODE_NAME, add_simulator, ros_command\n'
        'sys.exit(" ".join({"rclpy", "numpy", "std_msgs"} & set(sys.modules)) or 0)'
    )
    done = subprocess.run([sys.executable, '-c', code], capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stderr) == (0, '')
