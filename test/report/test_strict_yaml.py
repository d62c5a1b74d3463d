"""YAML from anybody: what would take time or memory without end is refused at once."""

import time
import tracemalloc

import pytest

from pool_sim_ros.report.strict_yaml import DEEPEST, read_yaml


def test_plain_yaml_is_read():
    assert read_yaml('a: [1, 2.5, x]\nb: {c: true, d: "1"}\n') == {
        'a': [1, 2.5, 'x'],
        'b': {'c': True, 'd': '1'},
    }
    assert read_yaml('') is None


@pytest.mark.parametrize('number', ['1e-6', '1.0e-06', '1E-6', '.1e-5', '+1e-6'])
def test_numbers_are_read_as_ros_reads_them(number):
    assert read_yaml(number) == 1e-6


def laughs(levels):
    """Return a text whose value has 9 ** levels strings."""
    lines = ['a0: &a0 [' + ', '.join(['lol'] * 9) + ']']
    lines += [f'a{k}: &a{k} [' + ', '.join([f'*a{k - 1}'] * 9) + ']' for k in range(1, levels)]
    return '\n'.join(lines)


NESTED = 100_000


@pytest.mark.parametrize(
    ('text', 'words'),
    [
        (laughs(12), 'aliases are not allowed, line 2'),
        ('a: &a [*a]\n', 'aliases are not allowed, line 1'),
        ('a: &a\n  b: *a\n', 'aliases are not allowed, line 2'),
        ('a: &a {b: 1}\nc:\n  <<: *a\n', 'aliases are not allowed, line 3'),
        ('[' * NESTED, 'nest.*deep|nesting depth, line 1'),
        ('{a: ' * NESTED, 'nest.*deep|nesting depth, line 1'),
        ('- ' * NESTED, 'nest.*deep|nesting depth, line 1'),
        ('a: 1\nb: 2\na: 3\n', "'a' is given twice, line 3"),
        ('a: {b: 1, b: 2}\n', "'b' is given twice, line 1"),
        ('a: ' + '1' * 5_000, 'Exceeds|limit|digits'),
        ('a: !!timestamp x', 'makes no sense'),
        ('a: !!bool x', 'makes no sense'),
        ('a: 2001-99-99', 'month'),
        ('a: !!python/object/apply:os.system [ls]', 'could not determine a constructor'),
        ('a: [1', 'line'),
        ('a: \x01', 'special characters are not allowed, line 1'),
        ('a: 1\n---\nb: 2\n', 'document'),
    ],
    ids=lambda value: repr(value)[:20],
)
def test_anything_else_is_refused_in_one_short_line_at_once(text, words):
    start = time.monotonic()
    tracemalloc.start()
    try:
        with pytest.raises(ValueError, match=words) as error:
            read_yaml(text)
        assert tracemalloc.get_traced_memory()[1] < 50_000_000
    finally:
        tracemalloc.stop()
    assert '\n' not in str(error.value) and len(str(error.value)) < 200
    assert time.monotonic() - start < 10.0


def test_as_deep_as_is_allowed_is_read():
    assert read_yaml('[' * DEEPEST + ']' * DEEPEST)


def test_a_file_of_many_balls_is_read_in_time():
    start = time.monotonic()
    text = 'positions: [' + ', '.join(f'{k}.25' for k in range(100_000)) + ']'
    assert len(read_yaml(text)['positions']) == 100_000
    assert time.monotonic() - start < 60.0
