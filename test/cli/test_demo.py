"""`python -m pool_sim_ros.cli.demo`."""

import io

from process_harness import Process

from pool_sim_ros.cli import demo
from pool_sim_ros.console.progress import ProgressLine
from pool_sim_ros.me212.log import published_final_positions


def test_all_positions_equal_the_print(domain):
    with Process('cli.demo', '--speed', '0') as process:
        assert process.wait() == 0, process.stderr
        assert process.stdout.endswith('44 of 44 positions equal the print.\n')
        assert process.stdout.count('as printed') == 44 and 'NOT' not in process.stdout
        assert 'Attitude to closest ball: -178.298 deg\n' in process.stdout


class OffByAHundredth:
    """A client whose simulator puts one ball elsewhere than the report."""

    def play(self, shot, **_):
        places = dict(published_final_positions()[shot])
        places['7'] = (places['7'][0] + 0.01, places['7'][1])
        return {
            'velocity': (1.0, 0.0),
            'final_positions': {k: (x * 0.0254, y * 0.0254) for k, (x, y) in places.items()},
            'final_positions_in': {k: [x, y] for k, (x, y) in places.items()},
        }


def test_a_position_that_differs_is_marked_and_not_counted(capsys):
    line = ProgressLine(io.StringIO())
    assert demo._play(OffByAHundredth(), line, 2, published_final_positions()[2]) == 10
    out = capsys.readouterr().out
    assert 'Ball  7: [ 7.61, 21.49] (in)   NOT as printed: [ 7.60, 21.49]' in out


def test_a_node_that_does_not_start_is_told(domain, monkeypatch, capsys):
    monkeypatch.setattr(demo.sys, 'executable', '/bin/false')
    assert demo.main(['--speed', '0']) == 1
    assert 'ended' in capsys.readouterr().err


def test_help(domain):
    with Process('cli.demo', '--help') as process:
        assert process.wait() == 0
        assert '--speed' in process.stdout


def test_a_speed_that_is_none_is_told_before_anything_starts(domain):
    for word in ('-1', 'nan', '1e300'):
        with Process('cli.demo', '--speed', word) as process:
            assert process.wait() == 2
            assert process.stdout == ''
            assert f"argument --speed: '{word}' is " in process.stderr.splitlines()[-1]
