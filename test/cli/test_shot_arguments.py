"""The arguments that commands which play a shot have in common."""

import pytest

from pool_sim_ros.cli.shot_arguments import ShotParser, check_shot, what_to_play
from pool_sim_ros.console import CommandError


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


@pytest.mark.parametrize('words', [('-1e-1', '0'), ('-4.', '0'), ('0', '-.5'), ('-2E+0', '-1_0.5')])
def test_every_negative_number_is_a_velocity(words):
    assert parse('--velocity', *words).velocity == [float(word) for word in words]


@pytest.mark.parametrize(
    ('words', 'explained'),
    [
        (['--velocity', 'nan', '0'], "--velocity: 'nan' is not a finite number"),
        (['--velocity', '0', 'inf'], "--velocity: 'inf' is not a finite number"),
        (['--velocity', '-inf', '0'], "--velocity: '-inf' is not a finite number"),
        (['--velocity', '1e999', '0'], "--velocity: '1e999' is not a finite number"),
        (['--velocity', 'fast', '0'], "--velocity: 'fast' is not a number"),
        (['1', '--timeout', '-1'], "--timeout: '-1' is not above 0"),
        (['1', '--timeout', '0'], "--timeout: '0' is not above 0"),
        (['1', '--timeout', 'nan'], "--timeout: 'nan' is not a finite number"),
        (['1', '--timeout', 'inf'], "--timeout: 'inf' is not a finite number"),
        (['1', '--node', ''], "--node: '' is not the name of a node"),
        (['1', '--node', 'a b'], "--node: 'a b' is not the name of a node"),
        (['1', '--node', '/'], "--node: '/' is not the name of a node"),
    ],
)
def test_a_bad_value_is_explained_before_ros_is_asked(capsys, words, explained):
    with pytest.raises(SystemExit) as error:
        parse(*words)
    assert error.value.code == 2
    assert f'argument {explained}' in capsys.readouterr().err.splitlines()[-1]


@pytest.mark.parametrize(
    ('words', 'told'),
    [
        (['5'], r'^rejected \(UNKNOWN_SHOT\): there is no shot "5"; the report has 1 to 4$'),
        (['0'], 'UNKNOWN_SHOT'),
        (['-1'], 'UNKNOWN_SHOT'),
        (['99999999999999999999'], 'UNKNOWN_SHOT'),
        (['--velocity', '0', '-0.'], 'BAD_VELOCITY'),
    ],
)
def test_what_no_simulator_plays_is_told_without_one(words, told):
    with pytest.raises(CommandError, match=told):
        check_shot(parse(*words))


@pytest.mark.parametrize(
    ('words', 'what'),
    [
        (['3'], {'shot': 3}),
        (['--velocity', '-1', '0'], {'velocity': [-1, 0]}),
        (
            ['--velocity', '0', '0', '--spin', '0', '-4.', '1'],
            {'velocity': [0, 0], 'spin': [0, -4, 1]},
        ),
        (['--cue', '2', '-90'], {'cue': {'speed': 2, 'azimuth': -90}}),
        (
            ['--cue', '2', '180', '--side', '0', '--above', '-.3', '--elevation', '5'],
            {'cue': {'speed': 2, 'azimuth': 180, 'side': 0, 'above': -0.3, 'elevation': 5}},
        ),
    ],
)
def test_what_is_given_is_what_is_asked_for(words, what):
    assert what_to_play(parse(*words)) == what
    check_shot(parse(*words))


@pytest.mark.parametrize(
    'words',
    [
        ['1', '--cue', '2', '180'],
        ['1', '--spin', '0', '0', '1'],
        ['--spin', '0', '0', '1'],
        ['1', '--side', '0.1'],
        ['--velocity', '1', '0', '--above', '0.1'],
    ],
)
def test_what_does_not_go_together_is_wrong_usage(capsys, words):
    with pytest.raises(SystemExit) as error:
        parse(*words)
    assert error.value.code == 2 and 'shot: error: ' in capsys.readouterr().err


@pytest.mark.parametrize('words', [['1'], ['4'], ['--velocity', '-1e-1', '0']])
def test_what_some_simulator_plays_is_left_to_it(words):
    check_shot(parse(*words))
