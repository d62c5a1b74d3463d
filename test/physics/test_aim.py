"""The azimuth from one ball to another."""

import math

import numpy as np
import pytest
from tables import random_table, table_of

from pool_sim_ros.physics import aim_at, cue_strike, simulate

SQUARE = table_of([(0.5, 0.5), (1.0, 0.5), (0.5, 0.9), (0.2, 0.5), (0.5, 0.1)])


@pytest.mark.parametrize(('target', 'degrees'), [('1', 0), ('2', 90), ('3', 180), ('4', -90)])
def test_right_angles_are_exact(target, degrees):
    assert aim_at(SQUARE, '0', target) == degrees


def test_a_velocity_along_it_points_to_the_target():
    table = random_table(np.random.default_rng(71), 6)
    for one in range(6):
        for other in set(range(6)) - {one}:
            azimuth = aim_at(table, str(one), str(other))
            along = np.array([math.cos(math.radians(azimuth)), math.sin(math.radians(azimuth))])
            between = table.positions[other] - table.positions[one]
            distance = math.hypot(*between)
            np.testing.assert_allclose(distance * along, between, rtol=0, atol=1e-15 * 4)


def test_a_stroke_along_it_hits_the_target_head_on():
    table = table_of([(0.5, 0.3), (1.1, 0.7)])
    velocity, _ = cue_strike(table, 2.0, aim_at(table, '0', '1'))
    event = simulate(table, velocity).events[0]
    assert (event['kind'], event['a'], event['b']) == (0, 0, 1)
    assert [event['nx'], event['ny']] == pytest.approx(velocity / math.hypot(*velocity), abs=1e-12)


def test_balls_elsewhere():
    places = SQUARE.positions + [(0.0, 0.0), (0.0, 0.2), (0.0, 0.0), (0.0, 0.0), (0.0, 0.0)]
    assert aim_at(SQUARE, '0', '1', places) == pytest.approx(math.degrees(math.atan2(0.2, 0.5)))


@pytest.mark.parametrize(
    ('arguments', 'words'),
    [
        (('9', '1'), "label: '9' is not on the table; it has 0, 1, 2, 3, 4"),
        (('0', 'C'), "label: 'C' is not on the table"),
        (('0', 1), 'label: 1 is not on the table'),
        (('0', '0'), "target: ball '0' cannot aim at itself"),
        (('0', '1', [(0.5, 0.5)]), r'positions: shape \(1, 2\) must be \(5, 2\)'),
        (('0', '1', [(0.5, 0.5)] * 5), "positions: balls '0' and '1', at .* no line"),
        (('0', '1', [(math.nan, 0.5)] * 5), "positions: balls '0' and '1', at .nan, 0.5."),
        (('0', '1', 'there'), 'positions: .*there'),
    ],
)
def test_bad_input_is_named(arguments, words):
    with pytest.raises(ValueError, match=f'^{words}') as caught:
        aim_at(SQUARE, *arguments)
    assert '\n' not in str(caught.value)
