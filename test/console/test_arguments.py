"""Arguments of commands: what is read as what, and what is said of the rest."""

import argparse
import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pool_sim_ros.console import Parser, arguments, count, number, path, port, positive, speed


def parse(*words):
    parser = Parser(prog='play_it')
    parser.add_argument('--pair', nargs=2, type=number)
    parser.add_argument('--speed', type=speed)
    return parser.parse_args(words)


@pytest.mark.parametrize(
    'word', ['-1', '-1.5', '-4.', '-.5', '-1e-1', '-1E+2', '-1.5e3', '-4.e0', '-.5e1', '-1_000.5']
)
def test_a_negative_number_is_no_option(word):
    assert parse('--pair', word, '0').pair == [float(word), 0.0]
    assert parse('--pair', '0', word).pair == [0.0, float(word)]


@given(st.floats(max_value=0.0, allow_nan=False, allow_infinity=False))
def test_any_negative_number_is_read_as_python_writes_it(value):
    for text in (repr(value), f'{value:e}', f'{value:g}'):
        assert parse('--pair', text, text).pair == [float(text)] * 2


@pytest.mark.parametrize('word', ['-inf', '-nan', '-Infinity', 'nan', 'inf', '1e999', '-1e999'])
def test_what_is_not_finite_is_told(capsys, word):
    with pytest.raises(SystemExit) as error:
        parse('--pair', word, '0')
    assert error.value.code == 2
    assert f"argument --pair: '{word}' is not a finite number" in capsys.readouterr().err


@pytest.mark.parametrize('word', ['-x', '-1x', '--1', '-1e', '-'])
def test_anything_else_is_no_number(capsys, word):
    with pytest.raises(SystemExit) as error:
        parse('--pair', word, '0')
    assert error.value.code == 2
    assert 'play_it: error:' in capsys.readouterr().err


@pytest.mark.parametrize(
    ('read', 'text', 'value'),
    [
        (positive, '0.5', 0.5),
        (positive, '1e-9', 1e-9),
        (speed, '0', 0.0),
        (speed, '-0', 0.0),
        (speed, '1e-3', 1e-3),
        (speed, '10000', 1e4),
        (count, '1', 1),
        (count, '330000', 330000),
        (port, '0', 0),
        (port, '65535', 65535),
    ],
)
def test_values_at_the_edge_are_taken(read, text, value):
    found = read(text)
    assert found == value and math.copysign(1.0, found) == 1.0


@pytest.mark.parametrize(
    ('read', 'text', 'words'),
    [
        (number, 'four', 'is not a number'),
        (number, '', 'is not a number'),
        (positive, '0', 'is not above 0'),
        (positive, '-1', 'is not above 0'),
        (positive, 'nan', 'is not a finite number'),
        (speed, '-1', 'is neither 0 nor from 0.001 to 10000'),
        (speed, '1e-311', 'is neither 0 nor from 0.001 to 10000'),
        (speed, '10001', 'is neither 0 nor from 0.001 to 10000'),
        (speed, 'inf', 'is not a finite number'),
        (count, '0', 'is not a whole number above 0'),
        (count, '-1', 'is not a whole number above 0'),
        (count, '1.5', 'is not a whole number above 0'),
        (count, '9' * 19, 'is not a whole number above 0'),
        (port, '65536', 'is not a port, 0 to 65535'),
        (port, '-1', 'is not a port'),
        (port, '8080.0', 'is not a port'),
        (port, '٣', 'is not a port'),
        (port, '', 'is not a port'),
        (path, '', 'the name is empty'),
        (path, 'a\nb', 'has a control character'),
    ],
)
def test_a_mistake_is_told_in_the_words_of_the_user(read, text, words):
    with pytest.raises(argparse.ArgumentTypeError, match=words) as error:
        read(text)
    for name in ('number', 'positive', 'speed', 'port', 'path'):
        assert not str(error.value).startswith(f'invalid {name}')


def test_a_mistake_names_the_option_and_no_function(capsys):
    with pytest.raises(SystemExit):
        parse('--speed', '-1')
    assert "argument --speed: '-1' is neither 0 nor" in capsys.readouterr().err


def test_the_home_of_the_user_is_put_in_for_a_tilde(monkeypatch):
    monkeypatch.setenv('HOME', '/home/anna')
    assert path('~/shot.mcap') == Path('/home/anna/shot.mcap')
    assert path('~') == Path('/home/anna')
    assert path('a/~/b') == Path('a/~/b')
    assert path('~nobody_of_this_name/b') == Path('~nobody_of_this_name/b')


def test_the_bounds_of_a_speed_are_those_of_the_node():
    from pool_sim_ros.simulator import PARAMETERS

    assert arguments.FASTEST == PARAMETERS['real_time_factor'].most
