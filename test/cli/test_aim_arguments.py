"""What `aim` is told becomes goals and noise; what makes no sense is explained."""

import pytest

from pool_sim_ros.cli.aim_arguments import AimParser, noise_of, parts_of
from pool_sim_ros.oracle import Goal, Noise


def parsed(line):
    return AimParser().parse_args(line.split())


@pytest.mark.parametrize(
    ('line', 'parts'),
    [
        ('--ball 9 --to 0.3 0.2', [{'ball': '9', 'to': [0.3, 0.2], 'within': 0.1}]),
        ('--ball 9 --to -1e-3 -4. --within 1', [{'ball': '9', 'to': [-0.001, -4], 'within': 1}]),
        ('--ball 9 --pot', [{'ball': '9', 'pocket': 'any'}]),
        ('--ball 9 --pot any', [{'ball': '9', 'pocket': 'any'}]),
        (
            '--ball 9 --pot 3 --cue-to 1 1 --keep C --avoid 8 --avoid 7',
            [
                {'ball': '9', 'pocket': 3},
                {'cue_to': [1.0, 1.0], 'within': 0.1},
                {'avoid': '8'},
                {'avoid': '7'},
                {'keep': 'C'},
            ],
        ),
        ('--first-hit 1 --touches 2', [{'first_hit': '1'}, {'touches': '2'}]),
        ('--goal {"first_hit":"1"}', [{'first_hit': '1'}]),
    ],
)
def test_goals(line, parts):
    assert parts_of(parsed(line)) == parts
    Goal(all=parts)


@pytest.mark.parametrize(
    ('line', 'noise'),
    [
        ('', Noise.preset('fastfiz')),
        ('--noise sjtu --scale 2', 2.0 * Noise.preset('sjtu')),
        ('--noise none --camera 0.01', Noise(camera=0.01)),
    ],
)
def test_noise(line, noise):
    assert noise_of(parsed(f'--touches 1 {line}')) == noise


@pytest.mark.parametrize(
    ('line', 'words'),
    [
        ('', 'say what the shot is to do'),
        ('--ball 9', '--ball goes with --to X Y or --pot'),
        ('--to 1 1', '--ball goes with'),
        ('--pot 3', '--ball goes with'),
        ('--ball 9 --pot x', "'x' is neither the number of a pocket nor 'any'"),
        ('--ball 9 --pot -1', "argument --pot: '-1'"),
        ('--ball 9 --to 1 nan', "'nan' is not a finite number"),
        ('--touches 1 --within 0', 'is not above 0'),
        ('--touches 1 --noise mine', 'invalid choice'),
        ('--touches 1 --scale 0', 'is not above 0'),
        ('--touches 1 --shots 0', "'0' is not a whole number above 0"),
        ('--touches 1 --seconds -1', 'is not above 0'),
        ('--goal 5', "'5' is no JSON object"),
        ('--goal [', "'[' is no JSON object"),
    ],
)
def test_what_makes_no_sense_is_explained(line, words, capsys):
    with pytest.raises(SystemExit) as ended:
        parsed(line)
    assert ended.value.code == 2 and words in capsys.readouterr().err
