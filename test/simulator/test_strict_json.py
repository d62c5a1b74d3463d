"""JSON from anybody: read as `json` reads it, or refused in one line."""

import json
import math

import pytest

from pool_sim_ros.simulator.strict_json import MOST_DIGITS, read_json, read_json_object


@pytest.mark.parametrize(
    'value',
    [
        {'a': [1, -2.5, 1e-300, True, None, 'x'], 'b': {'a': 1}},
        [],
        'é \u2028 \U0001f3b1',
        10**MOST_DIGITS - 1,
    ],
)
def test_what_json_writes_is_read_back(value):
    assert read_json(json.dumps(value)) == value
    assert read_json(json.dumps(value, ensure_ascii=False)) == value


def test_a_whole_number_of_many_digits_is_a_float_in_no_time():
    number = read_json('1' + '0' * 30)
    assert number == 1e30 and type(number) is float
    assert read_json('[' + '9' * 400 + ']') == [math.inf]
    assert read_json('-' + '9' * 1_000_000) == -math.inf


@pytest.mark.parametrize(
    ('text', 'words'),
    [
        ('', 'not JSON: Expecting value, column 1'),
        ('{', 'not JSON'),
        ('{"a": 1} x', 'not JSON: Extra data'),
        ('\ufeff{}', 'not JSON'),
        ('{"a": 1, "b": 2, "a": 1}', '"a" is given twice'),
        ('[{"b": {"a": 1, "a": 2}}]', '"a" is given twice'),
        ('[' * 1_000_000, 'nested too deeply'),
        ('{"a":' * 1_000_000, 'nested too deeply'),
        (r'["\ud83c"]', 'half a character'),
        (r'{"\udfb1": 1}', 'half a character'),
        ('{"a": "\ud83c"}', 'half a character'),
    ],
    ids=lambda value: repr(value)[:20],
)
def test_anything_else_is_refused_in_one_short_line(text, words):
    with pytest.raises(ValueError, match=words) as error:
        read_json(text)
    assert '\n' not in str(error.value) and len(str(error.value)) < 200


@pytest.mark.parametrize('text', ['5', '[]', 'null', '"x"', 'NaN', 'true'])
def test_what_is_no_object_is_refused_as_one(text):
    with pytest.raises(ValueError, match='not a JSON object'):
        read_json_object(text)
    assert read_json_object('{"a": 1}') == {'a': 1}
