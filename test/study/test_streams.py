"""Random numbers by seed and episode."""

import numpy as np

from pool_sim_ros.study.streams import draws, mixed


def plain_splitmix(state):
    """SplitMix64's output, with Python's whole numbers."""
    word = 2**64 - 1
    z = ((state ^ (state >> 30)) * 0xBF58476D1CE4E5B9) & word
    z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & word
    return z ^ (z >> 31)


def test_it_is_splitmix64():
    states = [0, 1, 2**63, 2**64 - 1, 0x9E3779B97F4A7C15]
    expected = [plain_splitmix(state) for state in states]
    assert mixed(np.array(states, np.uint64)).tolist() == expected
    # The first number of java.util.SplittableRandom(0), published with the algorithm.
    assert expected[-1] == 0xE220A8397B1DCDAF


def test_what_one_draws_does_not_depend_on_the_others():
    seeds = mixed(np.arange(1000, dtype=np.uint64))
    episodes = np.arange(1000, dtype=np.uint64) % np.uint64(7)
    found = draws(seeds, episodes, 97)
    alone = [int(draws(seeds[k : k + 1], episodes[k : k + 1], 97)[0]) for k in range(1000)]
    assert found.tolist() == alone


def test_seeds_and_episodes_that_are_neighbours_draw_evenly():
    """Chi squared of 64 cells; 63 is its mean, 11.2 its standard deviation."""
    seeds, episodes = np.meshgrid(np.arange(200), np.arange(200))
    seeds = mixed(seeds.ravel().astype(np.uint64))
    found = draws(seeds, episodes.ravel().astype(np.uint64), 64)
    counts = np.bincount(found, minlength=64)
    squared = ((counts - 625.0) ** 2 / 625.0).sum()
    assert len(counts) == 64 and 63 - 5 * 11.2 < squared < 63 + 5 * 11.2
