"""A simulation of a table with pockets, on which balls slide, roll, spin and fall."""

import json

import numpy as np
import pytest

from pool_sim_ros.physics import EventKind, cue_strike, simulate
from pool_sim_ros.simulator.command_log import CommandLog
from pool_sim_ros.simulator.frame import COLLISION_COLUMNS, SPIN_COLUMNS
from pool_sim_ros.simulator.health import ENERGY_ROUNDING, energy_rise
from pool_sim_ros.simulator.log_reader import read_log
from pool_sim_ros.simulator.parameter_values import values_from
from pool_sim_ros.simulator.replay import replay_frames
from pool_sim_ros.simulator.settings import build_settings
from pool_sim_ros.simulator.shot_request import Code, Phase
from pool_sim_ros.simulator.simulation import Simulation

BREAK = {'speed': 9.0, 'azimuth': 180.3, 'side': 0.1, 'above': 0.2}
"""A break that loses the cue ball and another one."""

KIND, A, B = (COLLISION_COLUMNS.index(name) for name in ('kind', 'a', 'b'))


@pytest.fixture(scope='module')
def settings():
    return build_settings(values_from({'table.preset': '7ft'}))


def ask(simulation, **fields):
    """Send a request; return its responses so far, and the frames until all rest, with the rest."""
    response, job = simulation.request(json.dumps(fields))
    responses, frames = [response, *simulation.more_responses()], []
    if job is not None:
        responses += simulation.computed(job, job.run())
    while not (simulation.at_rest and frames):
        frame, more = simulation.next_frame()
        frames.append(frame)
        responses += more
    return responses, frames


@pytest.fixture(scope='module')
def broken(settings):
    """A simulation after the break, with its responses and frames."""
    simulation = Simulation(settings)
    return simulation, *ask(simulation, id='break', cue=BREAK)


def test_a_break_is_played_as_the_physics_play_it(settings, broken):
    _, (accepted, done), frames = broken
    velocity, spin = cue_strike(settings.table, **BREAK)
    shot = simulate(settings.table, velocity, spins=spin)
    assert accepted.velocity == tuple(velocity) and accepted.spin == tuple(spin)
    assert accepted.cue == BREAK and done.phase is Phase.DONE
    assert np.array_equal(frames[-1].positions, shot.final_positions)
    times = np.arange(len(frames) - 1) / 60
    shown = np.array([frame.positions for frame in frames[:-1]])
    np.testing.assert_allclose(shown, shot.positions(times), rtol=0, atol=1e-8)
    moving = np.array([frame.velocities for frame in frames[:-1]])
    assert moving.shape[2] == len(SPIN_COLUMNS)
    np.testing.assert_allclose(moving[:, :, 2:], shot.spins(times), rtol=0, atol=1e-5)
    assert not frames[-1].velocities.any()
    fell = [i for i in shot.events['a'][shot.events['kind'] == EventKind.POCKETED]]
    assert list(frames[-1].pocketed) == fell and 0 in fell and len(fell) == 2
    labels = settings.table.labels
    assert done.pocketed == {
        labels[i]: pocket for i, pocket in enumerate(shot.pocketed) if pocket >= 0
    }


def test_collisions_are_contacts_and_falls_and_nothing_else(settings, broken):
    _, _, frames = broken
    rows = np.concatenate([frame.collisions for frame in frames])
    assert set(rows[:, KIND]) == {0, 1, 3}
    assert np.array_equal(rows[:, 0], np.arange(len(rows)))
    fell = rows[rows[:, KIND] == 3]
    assert tuple(fell[:, A].astype(int)) == frames[-1].pocketed
    before = frames[0]
    for frame in frames[1:]:
        new = frame.pocketed[len(before.pocketed) :]
        caught = frame.collisions[frame.collisions[:, KIND] == 3]
        assert frame.pocketed[: len(before.pocketed)] == before.pocketed
        assert new == tuple(caught[:, A].astype(int))
        for ball, pocket in caught[:, [A, B]].astype(int):
            assert np.array_equal(frame.positions[ball], settings.table.pockets[pocket, :2])
        before = frame


def test_orientations_are_those_of_the_physics_and_do_not_jump(settings, broken):
    _, (accepted, _), frames = broken
    shot = simulate(settings.table, accepted.velocity, spins=accepted.spin)
    turned = np.array([frame.orientations for frame in frames])
    np.testing.assert_allclose(np.linalg.norm(turned, axis=2), 1.0, rtol=0, atol=1e-12)
    assert np.all(np.sum(turned[1:] * turned[:-1], axis=2) >= 0.0)
    right = shot.orientations(np.append(np.arange(len(frames) - 1) / 60, shot.duration))
    # Either sign is the same orientation; ticks are rounded down to ns, at up to 400 rad/s.
    cosines = np.abs(np.sum(turned * right, axis=2))
    assert 2.0 * np.sqrt(np.max(np.maximum(2.0 - 2.0 * cosines, 0.0))) < 1e-5


def test_energy_does_not_rise_in_a_break(settings, broken):
    _, (accepted, _), _ = broken
    shot = simulate(settings.table, accepted.velocity, spins=accepted.spin)
    assert energy_rise(shot) <= ENERGY_ROUNDING


def test_the_cue_ball_in_a_pocket_is_not_struck_until_it_is_placed(settings):
    simulation = Simulation(settings)
    _, frames = ask(simulation, id='break', cue=BREAK)
    before, fell = frames[-1], list(simulation.pocketed)
    assert 'C' in fell
    for what in ({'velocity': [1.0, 0.0]}, {'cue': BREAK}):
        [rejected], _ = ask(simulation, **what)
        assert (rejected.phase, rejected.code) == (Phase.REJECTED, Code.CUE_POCKETED)
        assert "'C'" in rejected.reason and 'place' in rejected.reason
    (accepted, done), [frame] = ask(simulation, id='p', place={'C': [1.4, 0.5]})
    assert (accepted.phase, done.phase, done.code) == (Phase.ACCEPTED, Phase.DONE, Code.OK)
    assert done.t_start == done.t_end == frame.stamp / 1e9  # it is shown at the tick it names
    assert done.final_positions['C'] == [1.4, 0.5] and list(done.pocketed) == ['15']
    assert np.array_equal(frame.positions[0], [1.4, 0.5])
    assert np.array_equal(frame.positions[1:], before.positions[1:])
    assert np.array_equal(frame.orientations[0], [0, 0, 0, 1])
    assert np.array_equal(frame.orientations[1:], before.orientations[1:])
    assert simulation.pocketed == [label for label in fell if label != 'C']
    (_, done), frames = ask(simulation, velocity=[-1.0, 0.1], spin=[0.0, 30.0, 10.0])
    assert done.phase is Phase.DONE and done.spin == (0.0, 30.0, 10.0)
    turned = frames[0].orientations[1:]
    np.testing.assert_allclose(turned, before.orientations[1:], rtol=0, atol=1e-15)
    simulation.reset()
    frame, _ = simulation.next_frame()
    assert np.array_equal(frame.orientations, [[0, 0, 0, 1]] * 16) and simulation.pocketed == []


def test_a_request_to_place_is_carried_out_once_under_its_id(settings):
    simulation = Simulation(settings)
    text = json.dumps({'id': 'p', 'place': {'9': [0.8, 0.4], 'C': [1.4, 0.5]}})
    accepted, job = simulation.request(text)
    assert accepted.phase is Phase.ACCEPTED and job is None
    [done] = simulation.more_responses()
    simulation.reset()
    assert simulation.request(text) == (done, None)  # told again, not done again
    assert simulation.more_responses() == []
    assert np.array_equal(simulation.next_frame()[0].positions, settings.table.positions)
    assert simulation.request('{"id": "p", "place": {"9": [0.8, 0.5]}}')[0].code is Code.ID_REUSED


@pytest.mark.parametrize(
    ('places', 'words'),
    [
        ({'8': [0.6, 0.3], '9': [0.61, 0.3]}, 'overlap'),
        ({'9': [1.4859, 0.4953]}, 'overlap'),
        ({'9': [0.02, 0.5]}, 'outside'),
        ({'9': [0.0, 0.0]}, 'pocket 0'),
        ({'9': [-0.2, 0.5]}, 'outside'),
        ({'99': [0.5, 0.5]}, '"99"'),
        ({'9': [0.5, float('nan')]}, 'not finite'),
        ({'9': [1e308, 0.5]}, 'outside'),
    ],
)
def test_a_ball_that_cannot_lie_there_is_refused_and_nothing_changes(settings, places, words):
    simulation = Simulation(settings)
    [rejected], [frame] = ask(simulation, place=places)
    assert (rejected.phase, rejected.code) == (Phase.REJECTED, Code.BAD_LAYOUT)
    assert words in rejected.reason and '\n' not in rejected.reason
    assert np.array_equal(frame.positions, settings.table.positions)


def test_no_ball_is_placed_while_balls_move_or_a_shot_is_computed(settings):
    simulation = Simulation(settings)
    _, job = simulation.request('{"velocity": [-1.0, 0.0]}')
    assert simulation.request('{"place": {"9": [0.3, 0.4]}}')[0].code is Code.BUSY
    simulation.computed(job, job.run())
    simulation.next_frame()
    assert simulation.request('{"place": {"9": [0.3, 0.4]}}')[0].code is Code.BUSY


def test_a_twist_has_a_spin_here(settings):
    simulation = Simulation(settings)
    accepted, job = simulation.strike((1.0, 0.0, 0.0), (1.0, 2.0, 3.0))
    assert accepted.spin == job.spin == (1.0, 2.0, 3.0)
    bad, _ = Simulation(settings).strike((1.0, 0.0, 0.0), (1.0, float('inf'), 3.0))
    assert bad.code is Code.BAD_VELOCITY and 'spin' in bad.reason
    bad, _ = Simulation(settings).strike((1.0, 0.0, 0.5), (0.0, 0.0, 0.0))
    assert bad.code is Code.BAD_VELOCITY and 'linear.z' in bad.reason


def test_all_positions_may_put_balls_into_pockets_and_a_game_goes_on_from_there(settings):
    simulation = Simulation(settings)
    positions = settings.table.positions.copy()
    positions[3] = settings.table.pockets[4, :2] + 0.01
    assert simulation.place(positions) is None
    assert simulation.pocketed == ['3']
    _, frames = ask(simulation, cue={'speed': 1.0, 'azimuth': 90.0})
    assert frames[-1].pocketed[0] == 3
    assert np.array_equal(frames[-1].positions[3], settings.table.pockets[4, :2])


def test_a_session_is_replayed_bit_for_bit(settings, tmp_path):
    path = tmp_path / 'session.log'
    simulation, frames = Simulation(settings, log=CommandLog(str(path), settings)), []
    for fields in (
        {'cue': BREAK},
        {'place': {'C': [1.4, 0.5]}},
        {'velocity': [-2.0, 0.3], 'spin': [10.0, -20.0, 30.0]},
        {'place': {'C': [1.3, 0.5], '2': [1.0, 0.2]}},
        {'shot': 2},
        {'cue': {'speed': 3.0, 'azimuth': 77.0, 'above': -0.4}},
    ):
        responses, shown = ask(simulation, **fields)
        assert responses[-1].phase is Phase.DONE, responses[-1].reason
        frames += shown
    simulation.close()
    again = list(replay_frames(*read_log(path)))
    assert len(again) == len(frames)
    for frame, other in zip(frames, again, strict=True):
        for name in ('positions', 'velocities', 'orientations', 'collisions'):
            assert np.array_equal(getattr(frame, name), getattr(other, name)), frame.tick
        assert set(frame.pocketed) == set(other.pocketed)
