"""Many random shots of balls that spin: each ends, keeps the balls apart and gains no energy."""

import zlib

import numpy as np
import pytest
from spin_shots import KINDS
from spin_soundness import assert_batch_sound

BATCH = 1000


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


@pytest.mark.soak
@pytest.mark.parametrize('kind', KINDS)
def test_a_million_random_shots(kind, capsys):
    played = most = number = 0
    while played < 1_000_000:
        shots, events = play(kind, [number])
        played, most, number = played + shots, max(most, events), number + 1
    with capsys.disabled():
        print(f'\n{played} shots, {kind}: at most {most} events')
