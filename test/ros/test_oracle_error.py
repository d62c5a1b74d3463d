"""An error of the oracle has a code for programs and one line for people."""

from pool_sim_ros.console import CommandError
from pool_sim_ros.ros.oracle_error import OracleCode, OracleError


def test_code_and_reason_make_the_line():
    error = OracleError(OracleCode.MOVING, 'the balls are moving')
    assert (error.code, error.reason) == ('MOVING', 'the balls are moving')
    assert str(OracleError('MOVING', 'x')) == 'MOVING: x' and isinstance(error, CommandError)


def test_a_code_of_an_enumeration_is_shown_as_its_value():
    assert str(OracleError(OracleCode.MOVING, 'x')) == 'MOVING: x'
