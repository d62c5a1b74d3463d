"""How outcomes are kept."""

import numpy as np

from pool_sim_ros.physics import Outcomes, report_table
from pool_sim_ros.study.inputs import checked_inputs
from pool_sim_ros.study.outcome_arrays import STORED, stored_array, stored_name
from pool_sim_ros.study.plan import KEPT, checked_plan
from pool_sim_ros.study.ranges import normal


def test_each_outcome_but_the_events_can_be_kept():
    assert set(STORED) == set(KEPT) == set(Outcomes._fields) - {'events', 'offsets'}
    for stored in STORED.values():
        filled = np.full(1, stored.fill, stored.dtype)
        assert np.isnan(filled[0]) if filled.dtype.kind == 'f' else filled[0] == -1


def test_what_is_drawn_about_a_row_has_a_name_of_its_own():
    table = report_table()
    inputs = checked_inputs(table, {'angle': normal([1, 2], 0.1), 'speed': normal(1, 0.1)})
    plan = checked_plan(table, inputs, None, 3, 0, None, None, None)
    assert stored_name(plan, 'angle') == 'angle_drawn' and stored_name(plan, 'speed') == 'speed'
    assert stored_array(plan, 'speed')[1]['units'] == 'm/s'
    assert stored_array(plan, 'finals')[1]['units'] == 'm'
