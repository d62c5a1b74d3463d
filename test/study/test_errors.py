"""The error of a sweep."""

import pool_sim_ros.study as study
from pool_sim_ros.study.errors import SweepError


def test_it_is_public_and_an_error_of_the_run():
    assert study.SweepError is SweepError and issubclass(SweepError, RuntimeError)
