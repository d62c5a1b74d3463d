"""What a page may say."""

import json

import pytest

from pool_sim_ros.web_view.commands import LONGEST, Command, parse_command


@pytest.mark.parametrize(
    ('fields', 'command'),
    [
        ({'do': 'aim', 'velocity': [-4, 0.5]}, Command('aim', {'velocity': [-4.0, 0.5]})),
        ({'do': 'strike', 'velocity': [-4.0, 0.0]}, Command('strike', {'velocity': [-4.0, 0.0]})),
        ({'do': 'shot', 'number': 3}, Command('shot', 3)),
        ({'do': 'pause', 'paused': True}, Command('pause', True)),
        ({'do': 'speed', 'factor': 0.25}, Command('speed', 0.25)),
        ({'do': 'speed', 'factor': 0}, Command('speed', 0.0)),
        (
            {'do': 'strike', 'velocity': [1, 2], 'spin': [0, 50, -1]},
            Command('strike', {'velocity': [1.0, 2.0], 'spin': [0.0, 50.0, -1.0]}),
        ),
        (
            {'do': 'aim', 'cue': {'speed': 2, 'azimuth': 179.94, 'side': 0.2}},
            Command('aim', {'cue': {'speed': 2.0, 'azimuth': 179.94, 'side': 0.2}}),
        ),
        ({'do': 'place', 'places': {'9': [1, 0.5]}}, Command('place', {'9': [1.0, 0.5]})),
        ({'do': 'undo'}, Command('undo')),
        ({'do': 'help', 'goal': {'ball': '9'}}, Command('help', {'ball': '9'})),
        ({'do': 'step'}, Command('step')),
        ({'do': 'reset'}, Command('reset')),
    ],
)
def test_commands(fields, command):
    assert parse_command(json.dumps(fields)) == command


@pytest.mark.parametrize(
    ('text', 'word'),
    [
        ('', 'JSON'),
        ('{', 'JSON'),
        ('[' * 1000, 'JSON'),
        ('3', 'object'),
        ('[]', 'object'),
        ('{}', 'do must be'),
        ('{"do": "quit"}', 'do must be'),
        ('{"do": ["aim"]}', 'do must be'),
        ('{"do": "step", "paused": true}', 'nothing'),
        ('{"do": "shot"}', 'number'),
        ('{"do": "shot", "number": "1"}', 'integer'),
        ('{"do": "shot", "number": true}', 'integer'),
        ('{"do": "shot", "number": 1.0}', 'integer'),
        ('{"do": "shot", "number": 1, "velocity": [1, 2]}', 'number'),
        ('{"do": "pause", "paused": 1}', 'true or false'),
        ('{"do": "speed", "factor": -1}', 'factor'),
        ('{"do": "speed", "factor": NaN}', 'factor'),
        ('{"do": "speed", "factor": 1e999}', 'factor'),
        ('{"do": "aim", "velocity": [1]}', 'velocity'),
        ('{"do": "aim", "velocity": [1, 2, 3]}', 'velocity'),
        ('{"do": "aim", "velocity": [1, null]}', 'velocity'),
        ('{"do": "aim", "velocity": [1, NaN]}', 'velocity'),
        ('{"do": "aim", "velocity": "12"}', 'velocity'),
        ('{"do": "strike", "velocity": [true, 0]}', 'velocity'),
        ('{"do": "strike", "velocity": [1' + '0' * 400 + ', 0]}', 'velocity'),
        ('{"do": "aim", "spin": [1, 2, 3]}', 'velocity and spin'),
        ('{"do": "aim", "velocity": [1, 2], "spin": [1, 2]}', 'spin must be three'),
        ('{"do": "aim", "velocity": [1, 2], "cue": {}}', 'nothing else'),
        ('{"do": "aim", "cue": {"speed": 1}}', 'azimuth'),
        ('{"do": "aim", "cue": {"speed": 1, "azimuth": 2, "power": 3}}', 'elevation'),
        ('{"do": "aim", "cue": {"speed": 1, "azimuth": "2"}}', 'azimuth must be a number'),
        ('{"do": "place", "places": []}', 'places'),
        ('{"do": "place", "places": {}}', 'places'),
        ('{"do": "place", "places": {"9": [1, NaN]}}', 'places'),
        ('{"do": "help"}', 'goal'),
        ('{"do": "help", "goal": "9"}', 'goal must be an object'),
        ('{"do": "undo", "places": {"9": [1, 1]}}', 'nothing'),
        ('{"do": "step"}' + ' ' * LONGEST, 'characters'),
    ],
)
def test_anything_else_is_refused_in_words(text, word):
    with pytest.raises(ValueError, match=word) as error:
        parse_command(text)
    assert '\n' not in str(error.value)
