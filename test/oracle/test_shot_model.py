"""One tracked shot: its first guess, and its residuals beside the shot itself."""

import numpy as np
import pytest
from tables import table_of

from pool_sim_ros.oracle import Track
from pool_sim_ros.oracle.shot_model import ShotModel, with_values
from pool_sim_ros.physics import simulate

TABLE = table_of([(0.5, 0.5), (1.0, 0.5), (1.5, 0.9)])
VELOCITY = np.array([1.5, 0.02])
TIMES = np.arange(-10, 60) / 60
NOISE = 5e-4


def track_of(noise=0.0, seed=1):
    seen = simulate(TABLE, VELOCITY).positions(np.maximum(TIMES, 0.0))
    return Track(TIMES, seen + noise * np.random.default_rng(seed).standard_normal(seen.shape))


def test_the_truth_leaves_nothing():
    model = ShotModel(TABLE, track_of(), NOISE)
    assert model.moves.tolist() == [0, 1]
    truth = np.concatenate([VELOCITY, TABLE.positions[:2].ravel()])
    assert len(model.guess) == len(truth)
    np.testing.assert_allclose(model.residuals(TABLE, truth, 1.0), 0.0, atol=1e-6)


def test_what_is_left_of_noise_is_the_noise():
    track = track_of(NOISE)
    model = ShotModel(TABLE, track, NOISE)
    truth = np.concatenate([VELOCITY, TABLE.positions[:2].ravel()])
    left = model.residuals(TABLE, truth, 1.0)
    assert left.shape == (len(TIMES) * 3 * 2,) and 0.9 < left.std() < 1.1


def test_the_first_guess_is_near():
    model = ShotModel(TABLE, track_of(NOISE), NOISE)
    np.testing.assert_allclose(model.guess[:2], VELOCITY, atol=0.12)
    np.testing.assert_allclose(model.guess[2:], TABLE.positions[:2].ravel(), atol=2e-3)


def test_a_share_is_of_the_frames_after_the_strike():
    model = ShotModel(TABLE, track_of(), NOISE)
    assert len(model.residuals(TABLE, model.guess, 0.5)) == (10 + 30) * 6
    assert len(model.residuals(TABLE, model.guess, 0.01)) == (10 + 5) * 6


def test_a_ball_that_was_not_seen_differs_by_nothing():
    seen = track_of().positions.copy()
    seen[40:, 0] = np.nan
    model = ShotModel(TABLE, Track(TIMES, seen), NOISE)
    left = model.residuals(TABLE, model.guess, 1.0).reshape(-1, 3, 2)
    assert np.isfinite(left).all() and not left[40:, 0].any() and left[40:, 1].any()


def test_tracks_that_say_nothing():
    positions = track_of().positions
    with pytest.raises(ValueError, match='track: 2 balls must be 3'):
        ShotModel(TABLE, Track(TIMES, positions[:, :2]), NOISE)
    with pytest.raises(ValueError, match='track: 4 frames after the strike must be at least 5'):
        ShotModel(TABLE, Track(TIMES[:14], positions[:14]), NOISE)
    hidden = positions.copy()
    hidden[:, 2] = np.nan
    with pytest.raises(ValueError, match="track: ball '2' is in no frame"):
        ShotModel(TABLE, Track(TIMES, hidden), NOISE)


def test_coefficients_are_put_into_a_table():
    other = with_values(TABLE, {'e_ball_cushion': 0.5, 'mu_ball_surface': 0.2})
    assert (other.e_ball_cushion, other.mu_ball_surface) == (0.5, 0.2)
    assert other.balls == TABLE.balls
