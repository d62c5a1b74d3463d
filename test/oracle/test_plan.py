"""A plan as a sequence, and as words."""

import numpy as np

from pool_sim_ros.oracle import Failure, Plan, RankedShot


def shot(chance, cue=None):
    nothing = np.zeros((1, 2))
    failures = (Failure('ball 9 ends elsewhere', 0.25), Failure('ball 9 does not move', 0.05))
    interval = chance - 0.01, chance + 0.01
    place = np.array([2.0, 0.0])
    return RankedShot(
        place, None, cue, 2.0, 30.0, chance, *interval, nothing, nothing, np.zeros(1), failures, 100
    )


def test_a_plan_is_a_sequence_of_shots_best_first():
    shots = [shot(0.7), shot(0.5)]
    plan = Plan(shots, 330_000, False)
    assert list(plan) == shots == list(plan[:2]) and plan[1].chance == 0.5 and len(plan) == 2
    assert repr(plan) == '<Plan: 2 shots of 330,000 played, best chance 0.700>'


def test_it_is_printed_as_a_table():
    head, first, second, end = str(
        Plan([shot(0.7, {'side': 0.25, 'above': -0.1}), shot(0.5)], 330_000, True)
    ).splitlines()
    assert '#  speed  azimuth' in head
    assert first.split()[:7] == ['1', '2.00', '30.00', '0.25', '-0.10', '70.0', '%']
    assert 'ball 9 ends elsewhere 25 %; ball 9 does not move 5 %' in second
    assert end == '330,000 shots played, cut by time.'


def test_none_found_is_an_answer():
    plan = Plan([], 330_000, False)
    assert not plan and str(plan) == 'None found: 330,000 shots played.'
    assert repr(plan) == '<Plan: 0 shots of 330,000 played>'
