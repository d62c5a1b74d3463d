"""Why a result is not played."""

import numpy as np

from pool_sim_ros.physics import ShotTooLong, report_table, simulate
from pool_sim_ros.simulator.job import make_job
from pool_sim_ros.simulator.parameter_values import values_from
from pool_sim_ros.simulator.settings import build_settings
from pool_sim_ros.simulator.shot_in_hand import why_not_played
from pool_sim_ros.simulator.shot_request import Code


def test_an_error_and_a_shot_that_was_cut_say_what_happened():
    settings = build_settings(values_from({'max_shot_duration': 0.5}))
    job = make_job(settings, None, (-1.0, 0.0), np.array(settings.table.positions))
    for error, code in ((ShotTooLong('so many'), Code.TOO_LONG), (ValueError('no'), Code.FAILED)):
        assert why_not_played(error, job, settings) == (
            code,
            f'the shot could not be computed: {error}',
        )
    cut = simulate(report_table(), (-1.0, 0.0), until=0.5)
    code, reason = why_not_played(cut, job, settings)
    assert code is Code.TOO_LONG and 'max_shot_duration, 0.5 s' in reason
