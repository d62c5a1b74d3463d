"""How far a sweep has come."""

import pytest

from pool_sim_ros.study.tally import Tally

pytest.importorskip('tqdm')


def test_a_bar_shows_shots_and_the_time_left(capsys):
    with Tally(1000, 400, True) as tally:
        tally.say('a line')
        tally.add(600)
    shown = capsys.readouterr().err
    assert 'a line' in shown and '100%' in shown and '1.00k/1.00k' in shown and 'shots' in shown


def test_nobody_needs_to_see_it(capsys):
    with Tally(1000, 0, False) as tally:
        tally.say('a line')
        tally.add(1000)
    assert capsys.readouterr().err == ''
