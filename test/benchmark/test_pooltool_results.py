"""Balls that spin end as pooltool's do, where its spacing is imitated; speed is not asked here."""

import pytest
from benchmark.pooltool_results import CASES, compare
from benchmark.spaced import play_spaced

PRECISION = 1e-9
"""m: rounding, grown by the contacts of a shot outside breaks."""

BREAK_PRECISION = 1e-5
"""The same where a break's many contacts make it grow."""

FEW = 40

SAME_MODELS = [case for case in CASES if case.cushion_model != 'mathavan']
"""pooltool integrates `mathavan` in steps that are too coarse for slow balls."""


@pytest.mark.parametrize('case', SAME_MODELS, ids=lambda case: case.what)
def test_contacts_pockets_and_final_places(pooltool, case):
    [found] = compare(pooltool, case, (play_spaced,), FEW)
    assert found.contacts == found.pocketed == found.shots - found.pushed_in, found.unlike
    if 'break' in case.name:
        assert found.contacts >= 0.8 * found.shots and max(found.apart) < BREAK_PRECISION
    else:
        assert found.pushed_in == 0 and max(found.apart) < PRECISION
