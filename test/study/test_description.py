"""A plan, as its dataset tells of it, and back."""

import dataclasses
import json

import numpy as np
import pytest

from pool_sim_ros.physics import report_table
from pool_sim_ros.study.description import (
    LAYOUTS,
    attributes,
    coordinate_rows,
    description,
    difference,
    plan_of,
)
from pool_sim_ros.study.inputs import checked_inputs
from pool_sim_ros.study.plan import checked_plan
from pool_sim_ros.study.ranges import normal, uniform

TABLE = report_table()


def plan(table=TABLE, positions=None, seed=0, keep=None, samples=2, **inputs):
    given = {'angle': [0.1, 0.2], 'speed': uniform(1, 2), **inputs}
    return checked_plan(
        table, checked_inputs(table, given), positions, samples, seed, keep, None, None
    )


def read_again(made):
    rows = {**coordinate_rows(made), LAYOUTS: made.layouts}
    return plan_of(json.loads(json.dumps(attributes(made))), rows.__getitem__)


@pytest.mark.parametrize(
    'given',
    [{}, {'angle': normal([1, 3], 0.1)}, {'positions': TABLE.positions}, {'e_ball_ball': 0.1}]
    + [{'positions': np.stack([TABLE.positions] * 2), 'keep': ['failed']}],
)
def test_a_plan_that_is_read_again_is_the_same(given):
    made = plan(**given)
    again = read_again(made)
    assert description(again) == description(made) and again.sizes == made.sizes
    region = made.region(0)
    for name in made.inputs:
        assert again.values(name, region).tobytes() == made.values(name, region).tobytes()


@pytest.mark.parametrize(
    ('other', 'said'),
    [
        (plan(seed=1), 'its seed is another'),
        (plan(table=dataclasses.replace(TABLE, gravity=9.0)), 'its table is another'),
        (plan(keep=['failed']), 'its keep are another'),
        (plan(samples=3), 'its samples are another'),
        (
            plan(angle=[0.1, 0.3]),
            'angle is 2 values from 0.1 to 0.2 there and 2 values from 0.1 to 0.3',
        ),
        (plan(speed=2.0), 'speed is uniform'),
        (plan(jitter=0.001), 'jitter is not in it'),
    ],
)
def test_a_difference_is_told_in_words(other, said):
    assert said in difference(description(plan()), description(other))
    assert difference(description(plan()), description(plan())) is None


@pytest.mark.parametrize('attrs', [{}, {'sweep': '{'}, {'sweep': '{}', 'table': '{}'}])
def test_what_no_sweep_made(attrs):
    with pytest.raises(ValueError):
        plan_of(attrs, {}.__getitem__)
