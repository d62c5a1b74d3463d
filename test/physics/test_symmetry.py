"""An image of a table gives the image of the motion; the numbering of the balls is no matter."""

import dataclasses

import numpy as np
import pytest
from tables import LAWS, random_shots, table_of

from pool_sim_ros.physics import simulate


def mirror_x(table, places):
    return np.array([table.length, 0.0]) + places * [-1.0, 1.0]


def mirror_y(table, places):
    return np.array([0.0, table.width]) + places * [1.0, -1.0]


def half_turn(table, places):
    return mirror_x(table, mirror_y(table, places))


def quarter_turn(table, places):
    return np.stack([table.width - places[:, 1], places[:, 0]], axis=1)


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('image', [mirror_x, mirror_y, half_turn, quarter_turn])
def test_an_image_of_the_table_gives_the_image_of_the_motion(image, law):
    for table, velocities in random_shots(46, 8, law, balls=4, fastest=1.5, mu_ball_surface=0.2):
        places = image(table, table.positions)
        balls = [
            dataclasses.replace(b, position=p) for b, p in zip(table.balls, places, strict=True)
        ]
        size = (table.length, table.width)
        length, width = size[::-1] if image is quarter_turn else size
        image_table = dataclasses.replace(table, balls=balls, length=length, width=width)
        image_velocities = image(table, velocities) - image(table, np.zeros_like(velocities))
        expected = image(table, simulate(table, velocities).final_positions)
        found = simulate(image_table, image_velocities).final_positions
        # The images' rounding differs, and every contact multiplies it.
        assert np.abs(found - expected).max() < 1e-9


def test_the_order_of_the_balls_does_not_matter_under_coulomb():
    rng = np.random.default_rng(47)
    shots = random_shots(48, 12, 'coulomb', balls=5, fastest=1.5, mu_ball_surface=0.2)
    for table, velocities in shots:
        order = rng.permutation(5)
        shuffled = dataclasses.replace(table, balls=[table.balls[k] for k in order])
        expected = simulate(table, velocities).final_positions[order]
        found = simulate(shuffled, velocities[order]).final_positions
        assert np.abs(found - expected).max() < 1e-9


@pytest.mark.parametrize('gap', [0.0, 1e-3])
def test_a_symmetric_hit_stays_symmetric_under_coulomb(gap):
    """A ball between two others, all mirror images of themselves about y = 0.5."""
    half = 0.05 + gap / 2
    table = table_of([(0.5, 0.5), (0.9, 0.5 + half), (0.9, 0.5 - half)], ball_friction='coulomb')
    shot = simulate(table, (2.0, 0.0), until=0.45)
    x, y = shot.final_positions.T
    assert shot.events[shot.events['kind'] == 0].size >= 2
    assert abs(y[0] - 0.5) < 1e-12
    assert abs(x[1] - x[2]) < 1e-12
    assert abs((y[1] - 0.5) + (y[2] - 0.5)) < 1e-12


@pytest.mark.parametrize('e', [1.0, 0.95, 0.5])
def test_four_balls_that_meet_in_the_middle_stay_symmetric_under_coulomb(e):
    """Four balls that run at the centre at once, from four sides."""
    table = table_of(
        [(0.7, 0.5), (1.3, 0.5), (1.0, 0.8), (1.0, 0.2)],
        ball_friction='coulomb',
        e_cue_ball=e,
        e_ball_ball=e,
    )
    velocities = [(1.0, 0.0), (-1.0, 0.0), (0.0, -1.0), (0.0, 1.0)]
    shot = simulate(table, velocities, until=0.4)
    offsets = shot.final_positions - [1.0, 0.5]
    assert shot.events[shot.events['kind'] == 0].size >= 4
    for k, (ux, uy) in enumerate([(-1, 0), (1, 0), (0, 1), (0, -1)]):
        assert offsets[k] @ [ux, uy] == pytest.approx(offsets[0] @ [-1, 0], abs=1e-12)
        assert abs(offsets[k] @ [-uy, ux]) < 1e-12


@pytest.mark.parametrize('e', [1.0, 0.9, 0.5])
def test_separate_contacts_of_one_instant_come_before_what_they_cause(e):
    """Four touching balls, the outer two driven inwards: both outer contacts, then the inner."""
    places = [(0.5 + 0.1 * k, 0.5) for k in range(4)]
    table = table_of(places, e_cue_ball=e, e_ball_ball=e, ball_friction='coulomb')
    shot = simulate(table, [(1.0, 0.0), (0.0, 0.0), (0.0, 0.0), (-1.0, 0.0)], until=1e-3)
    along = shot.final_velocities[:, 0]
    assert np.abs(along + along[::-1]).max() < 1e-9
    assert along[3] > 0.1


def test_the_order_of_balls_that_touch_does_not_matter_under_coulomb():
    rng = np.random.default_rng(54)
    cells = [
        (0.05 + 0.1 * i + 0.05 * (j % 2), 0.05 + j * 0.05 * 3**0.5)
        for i in range(3)
        for j in (0, 1)
    ]
    for _ in range(20):
        velocities = rng.normal(size=(len(cells), 2))
        table = table_of(cells, ball_friction='coulomb', e_cue_ball=0.8, e_ball_ball=0.8)
        order = rng.permutation(len(cells))
        shuffled = dataclasses.replace(table, balls=[table.balls[k] for k in order])
        expected = simulate(table, velocities, until=1e-6).final_velocities[order]
        found = simulate(shuffled, velocities[order], until=1e-6).final_velocities
        assert np.abs(found - expected).max() < 1e-9
