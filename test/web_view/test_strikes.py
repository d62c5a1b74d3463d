"""The latest strike: computed as the simulator computes it, or not shown."""

import asyncio

import numpy as np
import pytest
from spin_tables import spin_table

from pool_sim_ros.physics import REPORT_TIME_SLICE, report_table, simulate
from pool_sim_ros.web_view.strikes import Strikes

TABLE = report_table()
SPIN = spin_table([(1.0, 0.5), (0.5, 0.5)])
ACCEPTED = {
    'id': 'a',
    'phase': 'accepted',
    'shot': None,
    'velocity': [-4.0, 0.1],
    'integrator': 'event',
    'as_printed': None,
}


def strikes(time_slice=None):
    """Return strikes, and the list of what they tell."""
    told = []

    async def ask():
        return time_slice

    return Strikes(told.append, ask), told


def run(made, table, response):
    asyncio.run(made.accepted(table, response))


def finish(made, ends, request_id='a'):
    response = {'id': request_id, 'final_positions': ends, 't_start': 2.0}
    asyncio.run(made.done(TABLE, response))


def test_a_frame_of_the_shot_itself_is_not_taken_for_its_start():
    made, told = strikes()
    made.saw(1.0, TABLE.positions)
    made.saw(1.1, TABLE.positions)
    made.saw(2.1, TABLE.positions + 0.001)  # it came before the answer
    run(made, TABLE, ACCEPTED)
    assert np.array_equal(made.start, TABLE.positions) and len(told) == 1


def test_balls_that_were_put_elsewhere_just_before_the_strike_start_there():
    made, told = strikes()
    places = TABLE.positions + 0.01
    made.saw(1.0, TABLE.positions)
    made.saw(1.1, TABLE.positions)
    made.saw(1.9, places)
    made.saw(2.1, places + 0.001)
    run(made, TABLE, ACCEPTED)
    shot = simulate(TABLE, (-4.0, 0.1), positions=places)
    finish(made, dict(zip(TABLE.labels, shot.final_positions.tolist(), strict=True)))
    assert np.array_equal(made.start, places)
    assert told[1] is None and told[2]['ends'] == shot.final_positions.tolist()


def test_a_shot_begins_where_the_balls_rested():
    made, told = strikes()
    places = TABLE.positions + 0.01
    made.saw(1.0, places)
    run(made, TABLE, ACCEPTED)
    shot = simulate(TABLE, (-4.0, 0.1), positions=places)
    assert told[0]['ends'] == shot.final_positions.tolist()
    assert np.array_equal(made.start, places)
    assert told[0]['exact'] is None


def test_a_shot_of_the_report_begins_at_the_start_layout_and_has_an_exact_twin():
    made, told = strikes()
    made.saw(1.0, TABLE.positions + 0.01)
    response = {'shot': 3, 'as_printed': True, 'integrator': 'time_slice', 'velocity': [-5.0, 0.0]}
    run(made, TABLE, ACCEPTED | response)
    assert told[0]['start'] == TABLE.positions.tolist()
    assert told[0]['exact']['reason']


def test_another_slice_is_asked_for():
    made, told = strikes(1e-4)
    made.saw(1.0, TABLE.positions)
    run(made, TABLE, ACCEPTED | {'integrator': 'time_slice'})
    coarse, fine = (
        simulate(TABLE, (-4.0, 0.1), integrator='time_slice', time_slice=time_slice)
        for time_slice in (1e-4, REPORT_TIME_SLICE)
    )
    assert told[0]['ends'] == coarse.final_positions.tolist() != fine.final_positions.tolist()


def test_spin_counts_where_balls_spin():
    made, told = strikes()
    made.saw(1.0, SPIN.positions)
    run(made, SPIN, ACCEPTED | {'spin': [0.0, 60.0, 20.0]})
    shot = simulate(SPIN, (-4.0, 0.1), spins=(0.0, 60.0, 20.0))
    assert told[0]['ends'] == shot.final_positions.tolist()


def test_nothing_is_told_before_the_balls_were_seen():
    made, told = strikes()
    run(made, TABLE, ACCEPTED)
    assert told == [] and made.start is None


@pytest.mark.parametrize('velocity', [[np.nan, 0.0], [1e300, 0.0]])
def test_what_no_simulator_accepts_is_not_told(velocity):
    made, told = strikes()
    made.saw(1.0, TABLE.positions)
    run(made, TABLE, ACCEPTED | {'velocity': velocity})
    assert told == []


def test_a_shot_that_ended_elsewhere_is_withdrawn():
    made, told = strikes()
    made.saw(1.0, TABLE.positions)
    run(made, TABLE, ACCEPTED)
    ends = dict(zip(TABLE.labels, told[0]['ends'], strict=True))
    finish(made, ends)
    assert len(told) == 1
    finish(made, {}, 'another')
    assert len(told) == 1
    finish(made, ends | {'9': [0.5, 0.5]})
    assert told[1] is None and told[-1] is None and made.start is None


def test_a_shot_that_is_preempted_while_it_is_computed_is_not_told():
    async def use():
        made, told = strikes()
        made.saw(1.0, TABLE.positions)
        task = asyncio.create_task(made.accepted(TABLE, ACCEPTED))
        await asyncio.sleep(0)
        made.forget()
        await task
        return told

    assert asyncio.run(use()) == []
