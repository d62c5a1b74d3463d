"""Many random shots of balls that spin: each ends, keeps the balls apart and gains no energy."""

import zlib

import numpy as np
import pytest
from spin_shots import KINDS
from spin_soundness import assert_batch_sound, assert_sound, depth_in_balls, depth_in_cushions
from spinning import RADIUS, spinning_table

from pool_sim_ros.physics import compile_kernels, pool_table

BATCH = 1000


@pytest.fixture(scope='module', autouse=True)
def compiled():
    """Lest the time to compile counts as that of an endless shot."""
    compile_kernels(pool_table('7ft'))


def play(kind, numbers, shots=BATCH, closely=2):
    """Play batches of a kind by number; return how many shots, and the most events of one."""
    played = most = 0
    for number in numbers:
        rng = np.random.default_rng([zlib.crc32(kind.encode()), number])
        batch = KINDS[kind](rng, number, shots)
        played += len(batch.velocities)
        looks = rng.exponential(1.0, 1) if shots == BATCH else rng.exponential(1.0, 2)
        most = max(most, assert_batch_sound(batch, looks, closely))
    return played, most


@pytest.mark.parametrize('kind', KINDS)
def test_a_few_random_shots(kind):
    played, _ = play(kind, range(10), 20)
    assert played > 150


HELD = {
    'impulse': (
        (4.984568991271335, -6.125406737717927),
        (2223.673235250689, 1153.9042559976015, 79.09349963939852),
        [
            (1.2334210535186234, 0.6219962477595515),
            (1.247698141918893, 0.6773341845372349),
            (0.5642911748078577, 0.028575),
            (0.6524236346509734, 0.6904747739349031),
            (1.952625, 0.028575000000000007),
            (1.8068380398474224, 0.3959026888680315),
            (1.7158568676909607, 0.028575),
            (1.477044459153062, 0.4963138651389266),
        ],
    ),
    'han': (
        (-3.4262873451877103, 0.0),
        (-1908.639528731545, 991.8044972048943, 439.5024450409597),
        [
            (1.2963841987398321, 0.9259427954557614),
            (0.5403425142034465, 0.962025),
            (1.952625, 0.3217355638151705),
            (1.823051108344555, 0.962025),
            (1.3535341987398322, 0.9259427954557614),
        ],
    ),
}
"""Shots among the random ones in which a fast spin holds two balls at a cushion for seconds."""


@pytest.mark.parametrize('model', HELD)
def test_what_is_held_for_seconds_ends_within_the_events(model):
    velocity, spin, places = HELD[model]
    shot = assert_sound(spinning_table(places, cushion_model=model), velocity, spin)
    assert len(shot.events) > 1000


def test_the_checks_see_what_is_wrong():
    """Through a rail, behind one, in a nose, in another ball."""
    table = pool_table('7ft')
    x, y, nose = table.cushions.noses[2]
    wrong = [(0.5, RADIUS - 2e-9), (0.5, -0.2), (x, y + nose + RADIUS - 2e-9), (-0.05, 0.05)]
    assert (depth_in_cushions(table, np.array(wrong)) > 1.5e-9).all()
    right = [(0.5, RADIUS), (x, y + nose + RADIUS), (0.0301, 0.0301)]
    assert (depth_in_cushions(table, np.array(right)) < 1e-12).all()
    pair = np.array([[(0.5, 0.5), (0.5 + 2 * RADIUS - 2e-9, 0.5), (np.nan, np.nan)]])
    assert depth_in_balls(table, pair)[0] == pytest.approx(2e-9, rel=1e-3)


@pytest.mark.soak
@pytest.mark.parametrize('kind', KINDS)
def test_a_million_random_shots(kind, capsys):
    played = most = number = 0
    while played < 1_000_000:
        shots, events = play(kind, [number])
        played, most, number = played + shots, max(most, events), number + 1
    with capsys.disabled():
        print(f'\n{played} shots, {kind}: at most {most} events')
