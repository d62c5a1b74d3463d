"""The exact result of a shot of the report beside its print."""

import re

import numpy as np
import pytest

from pool_sim_ros.me212 import cue_velocity
from pool_sim_ros.physics import INCH, report_table, simulate
from pool_sim_ros.web_view.exact import exact_fields

TABLE = report_table()


@pytest.mark.parametrize('number', [1, 2, 3, 4])
def test_the_reason_names_the_ball_that_is_farthest_off(number):
    velocity = cue_velocity(number, TABLE)
    printed, exact = simulate(TABLE, velocity, integrator='time_slice'), simulate(TABLE, velocity)
    fields = exact_fields(TABLE, number, printed)
    assert fields['ends'] == exact.final_positions.tolist()
    off = np.linalg.norm(printed.final_positions - exact.final_positions, axis=1) / INCH
    reason = fields['reason']
    label, distance = re.match(r'Ball (\S+) ends (.+?) from the exact result: ', reason).groups()
    assert label == TABLE.labels[off.argmax()]
    if distance == 'less than 0.0001 in':
        assert off.max() < 0.0001
    else:
        assert float(distance.removesuffix(' in')) == pytest.approx(off.max(), rel=0.5)
    assert ('rounding' in reason) == (number == 4)
    assert reason.count('. ') == 0 and reason.endswith('.')
