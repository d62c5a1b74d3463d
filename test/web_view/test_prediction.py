"""What is drawn while somebody aims."""

import json

import numpy as np
import pytest
from spin_tables import spin_table

from pool_sim_ros.physics import cue_strike, report_table, simulate
from pool_sim_ros.web_view.prediction import predict

TABLE = report_table()
SPIN = spin_table([(1.0, 0.5), (0.5, 0.5)])


def test_it_starts_where_the_balls_are_and_is_json():
    places = TABLE.positions + 0.01
    prediction = predict(TABLE, places, {'velocity': [-1.0, 0.0]})
    assert prediction['start'] == places.tolist()
    assert prediction['segments'][0][:4] == [0.0, 0.0, *places[0]]
    assert prediction['asked'] == {'velocity': [-1.0, 0.0]}
    assert json.loads(json.dumps(prediction)) == prediction


def test_a_cue_gives_what_cue_strike_gives():
    cue = {'speed': 2.0, 'azimuth': 179.94, 'side': 0.2, 'above': -0.3}
    velocity, spin = cue_strike(SPIN, **cue)
    prediction = predict(SPIN, SPIN.positions, {'cue': cue})
    shot = simulate(SPIN, velocity, spins=spin)
    assert prediction['velocity'] == velocity.tolist() and prediction['spin'] == spin.tolist()
    assert prediction['ends'] == shot.final_positions.tolist()


def test_a_spin_is_used():
    struck = {'velocity': [-2.0, 0.0], 'spin': [0.0, 60.0, 20.0]}
    shot = simulate(SPIN, struck['velocity'], spins=struck['spin'])
    assert predict(SPIN, SPIN.positions, struck)['ends'] == shot.final_positions.tolist()


@pytest.mark.parametrize(
    ('table', 'positions', 'strike', 'words'),
    [
        (TABLE, np.tile([1.0, 0.5], (11, 1)), {'velocity': [1.0, 0.0]}, 'overlap'),
        (TABLE, TABLE.positions, {'cue': {'speed': 1.0, 'azimuth': 0.0}}, 'motion disc'),
        (SPIN, SPIN.positions, {'cue': {'speed': 1.0, 'azimuth': 0.0, 'side': 0.6}}, 'miscue|side'),
    ],
)
def test_what_cannot_be_struck_is_refused(table, positions, strike, words):
    with pytest.raises(ValueError, match=words):
        predict(table, positions, strike)
