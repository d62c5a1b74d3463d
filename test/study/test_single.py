"""One table as an environment of gymnasium."""

import warnings

import gymnasium
import numpy as np
import pytest
from gymnasium.error import ResetNeeded
from gymnasium.utils.env_checker import check_env

from pool_sim_ros.physics import report_table, simulate
from pool_sim_ros.study import PlaceEnv

NAMES = ['PoolSim/Place-v0', 'PoolSim/Pot-v0']


@pytest.mark.parametrize('name', NAMES)
def test_gymnasiums_checks_find_nothing(name):
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        env = gymnasium.make(name, starts=64)
        check_env(env.unwrapped)
        env.close()


def test_a_step_is_a_shot():
    env = PlaceEnv(starts=16, speed=4.0)
    seen, _ = env.reset(seed=3)
    after, reward, ended, cut, info = env.step(np.array([-0.75, 0.25]))
    shot = simulate(report_table(), (-3.0, 1.0), positions=seen[:22].reshape(11, 2))
    assert (after[:22].reshape(11, 2) == shot.final_positions).all()
    assert (after[22:] == seen[22:]).all() and cut is False
    assert info['duration'] == shot.duration
    place = seen[22:]
    moved = [np.hypot(*(where[18:20] - place)) for where in (seen, after)]
    assert reward == pytest.approx(moved[0] - moved[1] + ended, abs=1e-12)


def test_a_seed_begins_its_row_of_episodes_anew():
    env = PlaceEnv(starts=1000)

    def starts(seed):
        return [env.reset(seed=seed)[0].tolist(), env.reset()[0].tolist()]

    first = starts(7)
    assert first[0] != first[1] and starts(7) == first and starts(8) != first


def test_without_a_seed_two_environments_differ():
    seen = {tuple(PlaceEnv(starts=10_000).reset()[0]) for _ in range(4)}
    assert len(seen) > 1


def test_an_episode_is_cut_after_ten_shots():
    env = gymnasium.make('PoolSim/Place-v0', starts=16)
    env.reset(seed=0)
    cuts = [env.step(np.zeros(2))[3] for _ in range(10)]
    assert cuts == [False] * 9 + [True]


def test_a_bad_action_changes_nothing():
    env, twin = PlaceEnv(starts=16), PlaceEnv(starts=16)
    env.reset(seed=1), twin.reset(seed=1)
    for bad in ([np.nan, 0.0], [1.0], 'x'):
        with pytest.raises(ValueError, match='^action: '):
            env.step(bad)
    assert (env.step([0.5, 0.5])[0] == twin.step([0.5, 0.5])[0]).all()


def test_before_a_reset_and_after_the_end_there_is_no_shot():
    end = simulate(report_table(), (-4.0, 0.0)).final_positions[9]
    env = PlaceEnv(starts=report_table().positions, place=end, speed=4.0)
    with pytest.raises(ResetNeeded):
        env.step([0.0, 0.0])
    env.reset()
    assert env.step([-1.0, 0.0])[2] is True
    with pytest.raises(ResetNeeded):
        env.step([0.0, 0.0])
