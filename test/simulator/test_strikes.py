"""The strike of a request: its velocity and spin, or why there is none."""

import numpy as np
import pytest

from pool_sim_ros.physics import cue_strike
from pool_sim_ros.simulator.parameter_values import values_from
from pool_sim_ros.simulator.refusals import RefusedError
from pool_sim_ros.simulator.settings import build_settings
from pool_sim_ros.simulator.shot_request import Code, Request
from pool_sim_ros.simulator.strikes import strike_of

CUE = {'speed': 2.0, 'azimuth': 170.0, 'elevation': 3.0, 'side': 0.2, 'above': -0.3}


@pytest.fixture(scope='module')
def pool():
    return build_settings(values_from({'table.preset': '7ft'}))


@pytest.fixture(scope='module')
def report():
    return build_settings(values_from({}))


def test_a_cue_gives_what_the_physics_say(pool):
    strike = strike_of(Request(cue=CUE), pool)
    velocity, spin = cue_strike(pool.table, **CUE)
    assert np.array_equal(strike.velocity, velocity) and np.array_equal(strike.spin, spin)


def test_a_velocity_may_have_a_spin_and_a_report_shot_has_none(pool, report):
    assert strike_of(Request(velocity=(1.0, 2.0), spin=(3.0, 4.0, 5.0)), pool).spin == (3, 4, 5)
    assert strike_of(Request(velocity=(1.0, 2.0)), pool).spin == (0, 0, 0)
    assert strike_of(Request(shot=1), pool) == ((-4.0, 0.0), (0, 0, 0))
    assert strike_of(Request(shot=1), report) == ((-4.0, 0.0), None)


@pytest.mark.parametrize(
    ('request_', 'code', 'words'),
    [
        (Request(cue={**CUE, 'side': 0.6}), Code.BAD_VELOCITY, 'miscue'),
        (Request(cue={**CUE, 'elevation': 95.0}), Code.BAD_VELOCITY, 'elevation'),
        (Request(cue={**CUE, 'speed': -1.0}), Code.BAD_VELOCITY, 'speed'),
        (Request(cue={'speed': 0.0, 'azimuth': 0.0}), Code.BAD_VELOCITY, 'would not move'),
        (Request(cue={'speed': 30.0, 'azimuth': 0.0}), Code.TOO_FAST, 'max_cue_speed'),
        (Request(velocity=(16.0, 0.0)), Code.TOO_FAST, 'max_cue_speed'),
    ],
)
def test_what_is_no_strike_is_refused_with_the_reason(pool, request_, code, words):
    with pytest.raises(RefusedError, match=words) as error:
        strike_of(request_, pool)
    assert error.value.code is code and '\n' not in error.value.reason


@pytest.mark.parametrize(
    'request_', [Request(cue=CUE), Request(velocity=(1.0, 0.0), spin=(0.0, 0.0, 0.0))]
)
def test_discs_take_neither_cue_nor_spin(report, request_):
    with pytest.raises(RefusedError, match='disc') as error:
        strike_of(request_, report)
    assert error.value.code is Code.BAD_VELOCITY
