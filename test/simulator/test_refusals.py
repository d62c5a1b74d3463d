from pool_sim_ros.simulator.refusals import RefusedError
from pool_sim_ros.simulator.shot_request import Code


def test_a_refusal_has_a_code_and_says_why():
    error = RefusedError(Code.BUSY, 'the balls are moving')
    assert (error.code, error.reason, str(error)) == (Code.BUSY, *['the balls are moving'] * 2)
