"""The paths that are drawn while somebody aims."""

import json

import numpy as np
import pytest
from paths import distance_to_way

from pool_sim_ros.physics import report_table, simulate
from pool_sim_ros.web_view.prediction import predict

TABLE = report_table()


@pytest.mark.parametrize('velocity', [(-4.0, 0.0), (-2.4, 0.7), (3.0, -1.0), (-9.0, 1.3)])
def test_every_ball_that_moves_keeps_to_its_path(velocity):
    shot = simulate(TABLE, velocity)
    paths = {
        path['ball']: path['points'] for path in predict(TABLE, TABLE.positions, velocity)['paths']
    }
    for ball, places in enumerate(
        shot.positions(np.linspace(0.0, shot.duration, 500)).transpose(1, 0, 2)
    ):
        if ball in paths:
            assert np.array_equal(paths[ball][0], TABLE.positions[ball])
            assert np.array_equal(paths[ball][-1], shot.final_positions[ball])
            assert max(distance_to_way(paths[ball], place) for place in places) < 1e-9
        else:
            assert np.array_equal(places, np.tile(TABLE.positions[ball], (500, 1)))


def test_it_starts_where_the_balls_are_and_is_json():
    places = TABLE.positions + 0.01
    prediction = predict(TABLE, places, (-1.0, 0.0))
    assert prediction['paths'][0]['ball'] == 0
    assert prediction['paths'][0]['points'][0] == places[0].tolist()
    assert json.loads(json.dumps(prediction)) == prediction


def test_balls_that_cannot_lie_there_are_refused():
    with pytest.raises(ValueError, match='overlap'):
        predict(TABLE, np.tile([1.0, 0.5], (11, 1)), (1.0, 0.0))
