import json
import math
from dataclasses import replace

import numpy as np
import pytest
from fakes import Glide

from pool_sim_ros.me212.shots import cue_velocity
from pool_sim_ros.physics import (
    Ball,
    ShotCancelled,
    ShotTooLong,
    Table,
    report_table,
    simulate,
)
from pool_sim_ros.simulator import job as job_module
from pool_sim_ros.simulator import shot_in_hand
from pool_sim_ros.simulator.parameter_table import default_values
from pool_sim_ros.simulator.settings import build_settings
from pool_sim_ros.simulator.shot_request import Code, Phase
from pool_sim_ros.simulator.simulation import Simulation

SETTINGS = replace(build_settings(default_values()), report_integrator='event')


@pytest.fixture
def simulation():
    return Simulation(SETTINGS)


def compute(simulation, job):
    return simulation.computed(job, job.run())


def frames_until_done(simulation):
    frames, responses = [], []
    while not responses:
        frame, responses = simulation.next_frame()
        frames.append(frame)
    return frames, responses


def test_a_report_shot_is_accepted_played_and_done(simulation):
    response, job = simulation.request('{"id": "a", "shot": 2}')
    velocity = cue_velocity(2, report_table())
    assert (response.phase, response.code, response.id) == (Phase.ACCEPTED, Code.OK, 'a')
    assert (response.shot, response.velocity, response.integrator) == (2, velocity, 'event')
    assert response.final_positions is None and response.t_start is None
    simulation.next_frame()
    assert compute(simulation, job) == []
    frames, [done] = frames_until_done(simulation)

    shot = simulate(report_table(), velocity)
    assert (done.phase, done.code, done.id, done.shot) == (Phase.DONE, Code.OK, 'a', 2)
    assert done.t_start == pytest.approx(frames[0].stamp * 1e-9, abs=1e-12)
    assert done.t_end == pytest.approx(done.t_start + shot.duration, abs=1e-12)
    assert done.events == len(shot.events)
    assert list(done.final_positions) == list(report_table().labels)
    assert np.array_equal(list(done.final_positions.values()), shot.final_positions)
    x, y = shot.final_positions[0] / 0.0254
    assert done.final_positions_in['C'] == [round(x, 2), round(y, 2)]
    assert np.array_equal(frames[-1].positions, shot.final_positions)
    json.loads(done.to_json())


def test_a_strike_goes_on_from_where_the_balls_lie_and_a_report_shot_from_the_start(simulation):
    _, job = simulation.request('2')
    compute(simulation, job)
    frames, _ = frames_until_done(simulation)
    ends = frames[-1].positions

    response, job = simulation.strike((0.5, 0.2, 0.0), (0.0, 0.0, 0.0))
    assert response.phase is Phase.ACCEPTED and response.shot is None
    assert np.array_equal(job.positions, ends)
    compute(simulation, job)
    frames_until_done(simulation)

    _, job = simulation.request('1')
    assert np.array_equal(job.positions, report_table().positions)
    compute(simulation, job)
    frame, _ = simulation.next_frame()
    assert frame.started and np.array_equal(frame.positions, report_table().positions)


def test_integrators_are_those_of_the_parameters():
    simulation = Simulation(build_settings(default_values()))
    response, job = simulation.request('3')
    assert response.integrator == job.integrator == 'time_slice'
    assert job.time_slice == 1e-6
    simulation.reset()
    response, job = simulation.request('{"velocity": [1, 0]}')
    assert response.integrator == job.integrator == 'event'


def test_new_settings_count_from_the_next_strike(simulation):
    _, job = simulation.request('{"velocity": [1, 0]}')
    table = replace(SETTINGS.table, e_cue_ball=0.5)
    simulation.settings = replace(SETTINGS, table=table, integrator='time_slice')
    assert job.table.e_cue_ball == 0.7
    compute(simulation, job)
    frames_until_done(simulation)
    response, job = simulation.request('{"velocity": [1, 0]}')
    assert job.table.e_cue_ball == 0.5
    assert response.integrator == 'time_slice'


@pytest.mark.parametrize(
    ('text', 'code'),
    [
        ('', Code.BAD_REQUEST),
        ('7', Code.UNKNOWN_SHOT),
        ('{"velocity": [0, 0]}', Code.BAD_VELOCITY),
        ('{"velocity": [12, 9.01]}', Code.TOO_FAST),
        ('{"velocity": [1e308, 1e308]}', Code.TOO_FAST),
    ],
)
def test_a_bad_request_is_rejected_and_changes_nothing(simulation, text, code):
    before, _ = simulation.next_frame()
    response, job = simulation.request(text)
    assert (response.phase, response.code, job) == (Phase.REJECTED, code, None)
    assert response.reason
    assert (response.id is None) == (code is Code.BAD_REQUEST)
    json.loads(response.to_json())
    frame, responses = simulation.next_frame()
    assert np.array_equal(frame.positions, before.positions) and responses == []
    assert not simulation.computing and not simulation.moving


def test_the_fastest_that_is_allowed_is_accepted(simulation):
    assert simulation.request('{"velocity": [15, 0]}')[0].phase is Phase.ACCEPTED


def test_a_report_shot_above_the_limit_is_too_fast(simulation):
    simulation.settings = replace(SETTINGS, max_cue_speed=2.0)
    assert simulation.request('1')[0].code is Code.TOO_FAST
    assert simulation.request('3')[0].phase is Phase.ACCEPTED


def test_busy_while_computing_and_while_moving(simulation):
    _, job = simulation.request('1')
    response, none = simulation.request('2')
    assert (response.code, none) == (Code.BUSY, None) and 'computed' in response.reason
    compute(simulation, job)
    assert simulation.strike((1.0, 0.0, 0.0), (0.0, 0.0, 0.0))[0].code is Code.BUSY
    simulation.next_frame()
    response, _ = simulation.request('2')
    assert response.code is Code.BUSY and 'moving' in response.reason
    _, [done] = frames_until_done(simulation)
    assert done.shot == 1
    assert simulation.request('2')[0].phase is Phase.ACCEPTED


@pytest.mark.parametrize('stage', ['computing', 'computed', 'moving'])
def test_a_reset_preempts_and_puts_the_balls_back(simulation, stage):
    _, job = simulation.request('2')
    compute(simulation, job)
    frames_until_done(simulation)
    accepted, job = simulation.request('{"velocity": [-3, 1]}')
    if stage != 'computing':
        compute(simulation, job)
    if stage == 'moving':
        started, _ = simulation.next_frame()
    [preempted] = simulation.reset()
    assert (preempted.phase, preempted.code) == (Phase.PREEMPTED, Code.RESET)
    assert preempted.id == accepted.id
    assert preempted.final_positions is None
    if stage == 'moving':
        assert preempted.t_start == pytest.approx(started.stamp * 1e-9)
    else:
        assert preempted.t_start is None
    frame, responses = simulation.next_frame()
    assert np.array_equal(frame.positions, report_table().positions)
    assert not frame.velocities.any() and responses == []
    assert simulation.reset() == []


def test_a_result_that_a_reset_has_overtaken_is_dropped(simulation):
    _, old = simulation.request('1')
    simulation.reset()
    accepted, new = simulation.request('2')
    assert compute(simulation, old) == []
    assert simulation.computing
    compute(simulation, new)
    _, [done] = frames_until_done(simulation)
    assert (done.id, done.shot) == (accepted.id, 2)


def test_a_shot_that_would_last_too_long_is_preempted_before_it_starts(simulation):
    simulation.settings = replace(SETTINGS, max_shot_duration=0.5)
    _, job = simulation.request('1')
    [response] = compute(simulation, job)
    assert (response.phase, response.code) == (Phase.PREEMPTED, Code.TOO_LONG)
    assert '0.5' in response.reason
    frame, _ = simulation.next_frame()
    assert not frame.velocities.any() and not frame.started
    assert simulation.request('{"velocity": [0.1, 0]}')[0].phase is Phase.ACCEPTED


def test_a_shot_that_cannot_be_computed_is_preempted(simulation):
    _, job = simulation.request('1')
    [response] = simulation.computed(job, ValueError('no such thing'))
    assert (response.phase, response.code) == (Phase.PREEMPTED, Code.FAILED)
    assert 'no such thing' in response.reason
    assert simulation.request('2')[0].phase is Phase.ACCEPTED


def test_a_shot_of_too_many_events_is_preempted(simulation):
    _, job = simulation.request('1')
    [response] = simulation.computed(job, ShotTooLong('max_events: more than 7'))
    assert (response.phase, response.code) == (Phase.PREEMPTED, Code.TOO_LONG)
    assert 'max_events' in response.reason


def test_the_same_request_again_gets_its_latest_response_and_is_not_run(simulation):
    text = '{"id": "a", "shot": 2}'
    first, job = simulation.request(text)
    assert simulation.request(text) == (first, None)
    compute(simulation, job)
    _, [done] = frames_until_done(simulation)
    assert simulation.request(text) == (done, None)
    assert simulation.request('{"shot": 2, "id": "a"}') == (done, None)
    assert not simulation.computing


def test_a_rejection_is_repeated_too(simulation):
    bad = '{"id": "b", "shot": 9}'
    rejected, _ = simulation.request(bad)
    assert simulation.request(bad) == (rejected, None)


def test_another_request_under_a_used_id_is_rejected(simulation):
    first, job = simulation.request('{"id": "a", "shot": 2}')
    for other in ('{"id": "a", "shot": 3}', '{"id": "a", "velocity": [1, 0]}', '{"id": "a"}'):
        response, none = simulation.request(other)
        assert (response.code, response.id, none) == (Code.ID_REUSED, 'a', None)
    compute(simulation, job)
    _, [done] = frames_until_done(simulation)
    assert simulation.request('{"id": "a", "shot": 2}') == (done, None)


def test_requests_without_an_id_get_one_each(simulation):
    ids = [simulation.request('1')[0].id for _ in range(3)]
    ids.append(simulation.strike((math.nan, 0.0, 0.0), (0.0, 0.0, 0.0))[0].id)
    assert len(set(ids)) == 4 and all(ids)


def test_a_thousand_rejections_do_not_make_it_forget_the_shot_in_hand(simulation):
    text = '{"id": "a", "velocity": [0.5, 0]}'
    accepted, job = simulation.request(text)
    for number in range(1500):
        simulation.request(json.dumps({'id': f'n{number}', 'shot': 1}))
    assert simulation.request(text) == (accepted, None)
    compute(simulation, job)
    _, [done] = frames_until_done(simulation)
    assert done.id == 'a'


def test_a_thousand_requests_without_an_id_do_not_either_nor_does_a_guess_of_its_id(simulation):
    accepted, job = simulation.request('{"velocity": [0.5, 0]}')
    prefix, _, count = accepted.id.rpartition('-')
    for guess in (accepted.id, f'{prefix}-{int(count) + 1}', prefix, f'{prefix}x'):
        for text in ('"velocity": [0.5, 0]', '"shot": 1'):
            response, none = simulation.request(f'{{"id": "{guess}", {text}}}')
            assert (response.phase, response.code, none) == (Phase.REJECTED, Code.BAD_REQUEST, None)
            assert response.id == guess and prefix in response.reason
    for _ in range(1500):
        assert simulation.request('1')[0].code is Code.BUSY
    compute(simulation, job)
    _, [done] = frames_until_done(simulation)
    assert (done.id, done.phase) == (accepted.id, Phase.DONE)


def test_a_shot_without_an_id_may_follow_a_guess_of_its_id(simulation):
    first, _ = simulation.request('9')
    prefix, _, count = first.id.rpartition('-')
    simulation.request(json.dumps({'id': f'{prefix}-{int(count) + 1}', 'shot': 9}))
    accepted, job = simulation.request('2')
    for _ in range(1500):
        simulation.request('1')
    assert [response.id for response in simulation.reset()] == [accepted.id]


def test_the_computing_of_a_shot_that_is_preempted_is_cancelled():
    simulation = Simulation(build_settings({**default_values(), 'time_slice': 1e-7}))
    for give_up in (simulation.reset, simulation.close):
        _, job = simulation.request('1')
        give_up()
        with pytest.raises(ShotCancelled):
            job.run()


def test_a_shot_of_too_many_slices_is_preempted_with_that_reason(monkeypatch):
    monkeypatch.setattr(job_module, 'MOST_SLICES', 1000)
    monkeypatch.setattr(shot_in_hand, 'MOST_SLICES', 1000)
    simulation = Simulation(build_settings({**default_values(), 'time_slice': 1e-4}))
    _, job = simulation.request('1')
    [response] = compute(simulation, job)
    assert (response.phase, response.code) == (Phase.PREEMPTED, Code.TOO_LONG)
    assert '1000 slices' in response.reason and '0.1 s' in response.reason


def test_nothing_moves_in_a_shot_of_no_length(simulation):
    _, job = simulation.request('{"velocity": [1, 0]}')
    positions = report_table().positions
    simulation.computed(job, Glide(positions, (0.0, 0.0), 0.0))
    frames, [done] = frames_until_done(simulation)
    assert len(frames) == 1 and done.phase is Phase.DONE


def test_shot_4_needs_a_second_ball():
    table = Table(2.0, 1.0, [Ball('C', 0.2, 0.05, (0.5, 0.5), is_cue=True)])
    simulation = Simulation(replace(SETTINGS, table=table))
    response, job = simulation.request('4')
    assert (response.code, job) == (Code.UNKNOWN_SHOT, None)
    assert 'alone' in response.reason
    assert simulation.request('1')[0].phase is Phase.ACCEPTED


def test_only_a_report_shot_is_as_printed_and_only_with_the_settings_of_the_report():
    report = build_settings(default_values())
    assert Simulation(report).request('1')[0].as_printed is True
    assert Simulation(SETTINGS).request('1')[0].as_printed is False
    assert Simulation(report).request('{"velocity": [-4, 0]}')[0].as_printed is None


def test_any_strike_can_follow_the_printed_shots():
    simulation = Simulation(build_settings(default_values()))
    for shot in (1, 2, 3, 4):
        _, job = simulation.request(str(shot))
        compute(simulation, job)
        frames_until_done(simulation)
        _, job = simulation.request('{"velocity": [-2.0, 0.3]}')
        assert compute(simulation, job) == []
        frames_until_done(simulation)


def test_balls_are_placed_while_they_rest(simulation):
    positions = report_table().positions * [1.0, 0.98]
    assert simulation.place(positions) is None
    expected = positions.copy()
    positions[:] = 0.0
    frame, _ = simulation.next_frame()
    assert np.array_equal(frame.positions, expected)
    _, job = simulation.request('{"velocity": [1, 0]}')
    assert np.array_equal(job.positions, expected)


def test_what_is_no_layout_changes_nothing(simulation):
    positions = report_table().positions
    assert '10 positions' in simulation.place(positions[:10])
    assert 'overlap' in simulation.place(np.ones((11, 2)))
    frame, _ = simulation.next_frame()
    assert np.array_equal(frame.positions, positions)


@pytest.mark.parametrize(
    'frame_id', ['map', '/table', 'Table', 'table ', 'x' * 1_000_000], ids=range(5)
)
def test_balls_are_not_placed_in_a_frame_of_others(simulation, frame_id):
    positions = report_table().positions * [1.0, 0.98]
    refusal = simulation.place(positions, frame_id)
    assert repr(frame_id[:50])[:-1] in refusal and "must be 'table', or empty" in refusal
    assert len(refusal) < 200
    for own in ('table', ''):
        assert simulation.place(positions, own) is None


def test_balls_are_not_placed_while_a_shot_is_in_hand(simulation):
    positions = report_table().positions * [1.0, 0.98]
    _, job = simulation.request('1')
    assert 'computed' in simulation.place(positions)
    compute(simulation, job)
    assert 'moving' in simulation.place(positions)
    frames_until_done(simulation)
    assert simulation.place(positions) is None


def test_a_result_is_taken_once(simulation):
    _, job = simulation.request('2')
    result = job.run()
    assert simulation.computed(job, result) == [] == simulation.computed(job, result)
    _, [done] = frames_until_done(simulation)
    assert done.phase is Phase.DONE
    assert simulation.computed(job, result) == []
    assert simulation.at_rest and not simulation.moving


def test_ticks_and_stamps_go_on_and_looking_ahead_moves_nothing(simulation):
    assert (simulation.tick, simulation.next_tick, simulation.stamp) == (0, 0, 0)
    _, job = simulation.request('2')
    assert simulation.computing and not simulation.at_rest
    compute(simulation, job)
    block = simulation.look_ahead()
    assert block.moving and not simulation.moving
    frame, _ = simulation.next_frame()
    assert frame.started and frame.block is block and simulation.moving
    simulation.next_frame()
    assert (simulation.tick, simulation.next_tick, simulation.stamp) == (1, 2, 16_666_666)


def test_an_unreadable_request_has_no_id_to_be_remembered_by(simulation):
    assert [simulation.request('nonsense')[0].id for _ in range(2)] == [None, None]
