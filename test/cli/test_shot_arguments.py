"""The arguments that commands which play a shot have in common."""

import pytest

from pool_sim_ros.cli.shot_arguments import ShotParser


def parse(*words):
    return ShotParser('shot', 'Play a shot.').parse_args(words)


def test_a_shot_of_the_report():
    options = parse('3')
    assert (options.shot, options.velocity) == (3, None)
    assert (options.node, options.timeout) == ('pool_sim', 10.0)


def test_a_velocity_on_another_simulator():
    options = parse('--velocity', '-4', '0.5', '--node', '/hall/left', '--timeout', '60')
    assert (options.shot, options.velocity) == (None, [-4.0, 0.5])
    assert (options.node, options.timeout) == ('/hall/left', 60.0)


@pytest.mark.parametrize(
    ('words', 'explained'),
    [
        ([], 'either the number of a shot or --velocity VX VY'),
        (['1', '--velocity', '1', '0'], 'either the number of a shot or --velocity VX VY'),
        (['one'], "invalid int value: 'one'"),
        (['--velocity', '1'], 'expected 2 arguments'),
    ],
)
def test_anything_else_is_explained(capsys, words, explained):
    with pytest.raises(SystemExit) as error:
        parse(*words)
    assert error.value.code == 2
    assert explained in capsys.readouterr().err
