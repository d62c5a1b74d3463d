"""Many tables as one environment."""

import warnings

import gymnasium
import numpy as np
import pytest
from gymnasium.error import ResetNeeded
from gymnasium.utils.env_checker import data_equivalence
from gymnasium.utils.performance import benchmark_vector_step
from gymnasium.vector import AutoresetMode

from pool_sim_ros.study import PlaceVectorEnv

MODES = ['NextStep', 'SameStep', 'Disabled']
TASKS = {
    'PoolSim/Place-v0': dict(starts=64, within=0.6),
    'PoolSim/Pot-v0': dict(starts=64, table='8ft'),
}


def steps(envs, count, seed=5):
    """Return all that an environment gives in so many steps, with resets where they are due."""
    envs.action_space.seed(1)
    found = [envs.reset(seed=seed)]
    for _ in range(count):
        found.append(envs.step(envs.action_space.sample()))
        over = found[-1][2] | found[-1][3]
        if envs.metadata['autoreset_mode'] is AutoresetMode.DISABLED and over.any():
            found.append(envs.reset(options={'reset_mask': over}))
    return found


@pytest.mark.parametrize('mode', MODES)
@pytest.mark.parametrize('name', TASKS)
def test_it_gives_bit_for_bit_what_gymnasiums_own_makes_of_single_ones(name, mode):
    limit = 3
    given = TASKS[name] | dict(max_episode_steps=limit)
    own = gymnasium.make_vec(name, 5, autoreset_mode=mode, **given)
    theirs = gymnasium.make_vec(
        name, 5, 'sync', vector_kwargs={'autoreset_mode': AutoresetMode(mode)}, **given
    )
    assert own.observation_space == theirs.observation_space
    assert own.action_space == theirs.action_space
    pairs = list(zip(steps(own, 20), steps(theirs, 20), strict=True))
    ended = sum(found[2].sum() for found, _ in pairs if len(found) == 5)
    assert ended > 0 or name != 'PoolSim/Place-v0'
    for k, (found, expected) in enumerate(pairs):
        assert data_equivalence(found, expected, exact=True), f'step {k}: {found} {expected}'


@pytest.mark.parametrize('name', TASKS)
def test_an_environment_does_the_same_among_1_64_and_4096(name):
    given = TASKS[name] | dict(max_episode_steps=2)
    actions = np.random.default_rng(2).uniform(-1.0, 1.0, (4, 4096, 4))
    rows = {}
    for count in (1, 64, 4096):
        envs = gymnasium.make_vec(name, count, **given)
        found = [envs.reset(seed=9)[0]]
        width = envs.single_action_space.shape[0]
        for k in range(4):
            found += envs.step(actions[k, :count, :width])[:4]
        rows[count] = found
    for few, many in ((1, 64), (64, 4096)):
        for one, other in zip(rows[few], rows[many], strict=False):
            assert one.tobytes() == other[:few].tobytes()


@pytest.mark.parametrize('mode', MODES)
def test_gymnasiums_checks_of_vectors_find_nothing(mode):
    """`make_vec` warns of missing metadata, the benchmark resets as each mode asks for."""
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        envs = gymnasium.make_vec(
            'PoolSim/Place-v0', 4, autoreset_mode=mode, max_episode_steps=2, starts=64
        )
        assert envs.spec.id == 'PoolSim/Place-v0' and envs.metadata['autoreset_mode'].value == mode
        assert benchmark_vector_step(envs, 0, seed=0) > 0
        envs.close(), envs.close()


def test_what_is_returned_stays_as_it_was():
    envs = PlaceVectorEnv(4, 2, starts=64)
    given = [envs.reset(seed=0)[0]]
    copies = [given[0].copy()]
    for _ in range(4):
        found = envs.step(np.full((4, 2), 0.6))
        arrays = [*found[:4], *found[4].values()]
        given += arrays
        copies += [array.copy() for array in arrays]
    assert all((one == other).all() for one, other in zip(given, copies, strict=True))


def test_wrappers_of_gymnasium_work_on_it():
    envs = gymnasium.wrappers.vector.RecordEpisodeStatistics(PlaceVectorEnv(4, 2, starts=64))
    envs.reset(seed=0)
    infos = [envs.step(np.full((4, 2), 0.6))[4] for _ in range(2)]
    assert infos[1]['episode']['l'].tolist() == [2, 2, 2, 2]


def test_seeds_may_be_given_one_by_one():
    one, other = PlaceVectorEnv(3, starts=1000), PlaceVectorEnv(3, starts=1000)
    assert (one.reset(seed=4)[0] == other.reset(seed=[4, 5, 6])[0]).all()
    assert (one.reset(seed=4)[0] == other.reset(seed=np.arange(4, 7))[0]).all()
    kept = other.reset(seed=[4, None, 6])[0]
    expected = one.reset()[0]
    assert (kept[1] == expected[1]).all() and (kept[::2] != expected[::2]).any(axis=1).all()
    free = PlaceVectorEnv(3, starts=1000).reset(seed=[4, None, 6])[0]
    assert (free[0] == other.reset(seed=4)[0][0]).all()


@pytest.mark.parametrize('seed', [[1, 2], [1, 2, -3], [1, 2, 0.5], -1, 2.5, 'abc', True])
def test_what_is_no_seed_is_refused_and_changes_nothing(seed):
    envs, twin = PlaceVectorEnv(3, starts=64), PlaceVectorEnv(3, starts=64)
    envs.reset(seed=0), twin.reset(seed=0)
    with pytest.raises(ValueError, match='^seed: '):
        envs.reset(seed=seed)
    assert (envs.reset()[0] == twin.reset()[0]).all()


@pytest.mark.parametrize(
    'mask', [[True, False, False], np.ones(3), np.ones(2, bool), np.zeros(3, bool)]
)
def test_what_is_no_mask_is_refused(mask):
    envs = PlaceVectorEnv(3, starts=64)
    envs.reset(seed=0)
    with pytest.raises(ValueError, match='^reset_mask: must be an array of 3 bool'):
        envs.reset(options={'reset_mask': mask})


def test_bad_actions_change_nothing():
    envs, twin = PlaceVectorEnv(3, 2, starts=64), PlaceVectorEnv(3, 2, starts=64)
    good = np.full((3, 2), 0.6)
    envs.reset(seed=0), twin.reset(seed=0)
    for _ in range(5):
        for bad in (good[:2], np.full((3, 2), np.nan), None):
            with pytest.raises(ValueError, match='^action: '):
                envs.step(bad)
        assert data_equivalence(envs.step(good), twin.step(good), exact=True)


def test_before_a_reset_and_where_nobody_reset_the_end_there_is_no_step():
    envs = PlaceVectorEnv(3, 1, 'Disabled', starts=64)
    with pytest.raises(ResetNeeded, match='no episode has begun'):
        envs.step(np.zeros((3, 2)))
    with pytest.raises(ValueError, match='no episode has begun yet'):
        envs.reset(options={'reset_mask': np.array([True, False, False])})
    envs.reset(seed=0)
    envs.step(np.zeros((3, 2)))
    with pytest.raises(ResetNeeded, match='environment 0 is at its end'):
        envs.step(np.zeros((3, 2)))


@pytest.mark.parametrize(('count', 'limit'), [(0, None), (-1, None), (1, 0), (2.5, None), (1, 'x')])
def test_numbers_that_cannot_be_are_refused(count, limit):
    with pytest.raises(ValueError, match='must be a whole number, at least 1$'):
        PlaceVectorEnv(count, limit, starts=64)


def test_a_mode_and_options_that_are_none_are_refused():
    with pytest.raises(ValueError, match="^autoreset_mode: 'no' must be one of 'NextStep', "):
        PlaceVectorEnv(1, None, 'no', starts=64)
    with pytest.raises(ValueError, match='^options: 5 must be a dict$'):
        PlaceVectorEnv(1, starts=64).reset(options=5)
