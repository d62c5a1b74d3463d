import math
from dataclasses import replace

import numpy as np
import pytest

from pool_sim_ros.me212 import published_final_positions
from pool_sim_ros.report.played import (
    ShotError,
    aim,
    log_of,
    log_remark,
    moved_balls,
    play_shots,
    verdict,
)


def test_deviations_name_all_that_differs(settings, other_settings):
    assert settings.deviations == []
    assert replace(settings, time_slice=1e-5).deviations == ['slices of 1e-05 s']
    assert other_settings.deviations == ['another table', 'integrator event']
    # Colours move nothing.
    balls = [replace(ball, color=(0.5, 0.5, 0.5)) for ball in settings.table.balls]
    assert replace(settings, table=replace(settings.table, balls=balls)).deviations == []


def test_the_verdict_counts(settings, shots):
    assert verdict(settings, [shots[2]]).startswith('11 of 11 ')


def test_the_log_remarks_on_every_run_but_the_report_s(settings):
    assert log_remark(settings) is None
    exact = replace(settings, report_integrator='event')
    assert log_remark(exact) == 'Not the run that the report printed: integrator event'


def test_the_log_of_some_shots_has_its_head_and_those(settings, shots):
    parts = log_of(settings, [shots[2], shots[4]]).split('\n\n')
    assert [part.partition(':')[0] for part in parts] == [
        'Closest ball to Cue ball',
        'Simulation 2',
        'Simulation 4',
        '',
    ]


@pytest.mark.parametrize('number', [1, 2, 3, 4])
def test_the_report_s_shots_end_where_it_printed(shots, number):
    assert shots[number].printed == published_final_positions()[number]
    assert shots[number].equal_to_print == 11


def test_a_ball_elsewhere_is_not_counted(shots):
    printed = dict(shots[1].printed)
    x, y = printed['3']
    printed['3'] = (x + 0.01, y)
    assert replace(shots[1], printed=printed).equal_to_print == 10
    assert replace(shots[1], printed=None).equal_to_print == 0


def test_shot_4_is_aimed_at_the_nearest_ball(settings):
    table = settings.table
    label, angle = aim(table)
    cue, *others = table.balls
    nearest = min(others, key=lambda ball: math.dist(ball.position, cue.position))
    assert label == nearest.label
    dx, dy = np.subtract(nearest.position, cue.position)
    assert math.tan(angle) == pytest.approx(dy / dx)
    assert aim(replace(table, balls=table.balls[:1])) is None


def test_moved_balls_are_those_that_were_ever_elsewhere(shots):
    for shot in shots.values():
        times = np.linspace(0.0, shot.trajectory.duration, 200)
        places = shot.trajectory.positions(times)
        moved = np.flatnonzero(np.any(places != places[0], axis=(0, 2)))
        assert moved_balls(shot.trajectory).tolist() == moved.tolist()


def test_a_shot_without_a_target_is_told(settings):
    alone = replace(settings, table=replace(settings.table, balls=settings.table.balls[:1]))
    with pytest.raises(ShotError, match='^shot 4: the cue ball is alone'):
        list(play_shots(alone, [4]))


def test_a_shot_that_outlasts_the_limit_is_told(settings):
    short = replace(settings, report_integrator='event', max_shot_duration=0.5)
    with pytest.raises(ShotError, match='^shot 1: .* longer than max_shot_duration, 0.5 s$'):
        list(play_shots(short, [1]))
