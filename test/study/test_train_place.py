"""The example that learns: it learns, and the same from the same seed."""

import importlib.util
from pathlib import Path

import gymnasium  # noqa: F401, without it there is nothing to learn in
import numpy as np
import pytest

EXAMPLE = Path(__file__).parents[2] / 'examples' / 'train_place.py'


@pytest.fixture(scope='module')
def example():
    spec = importlib.util.spec_from_file_location('train_place', EXAMPLE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.POLICIES, module.STARTS, module.BEST = 64, 64, 8
    return module


def test_it_learns_in_ten_generations(example):
    said = []
    weights, curve = example.train(10, tell=said.append)
    assert len(curve) == len(said) == 10 and max(curve[-3:]) > curve[0] + 0.1
    again, _ = example.train(10, tell=said.append)
    assert (weights == again).all()


def test_the_aim_of_a_policy_is_beside_the_ball(example):
    """The ghost ball: straight from the cue ball to two radii behind the ball."""
    cue, ball, place = np.array([0.5, 0.3]), np.array([1.0, 0.5]), np.array([1.5, 0.9])
    gap = 0.1143
    onward = (place - ball) / np.linalg.norm(place - ball)
    expected = ball - gap * onward - cue
    weights = np.array([[-gap, 0.0, 0.7, 0.0, 0.0, 0.0]])
    ((action,),) = example.act(np.concatenate([cue, ball, place])[np.newaxis], weights)
    assert action == pytest.approx(0.7 * expected / np.linalg.norm(expected))
