import numpy as np

from pool_sim_ros.simulator.frame import (
    COLLISION_COLUMNS,
    NO_COLLISIONS,
    VELOCITY_COLUMNS,
    Block,
    Frame,
)

POSITIONS = np.arange(12.0).reshape(3, 2, 2)
VELOCITIES = POSITIONS + 100.0


def block(moving):
    stamps = [70, 80, 90]
    return Block(7, 10, stamps, POSITIONS, VELOCITIES, [NO_COLLISIONS] * 3, moving, moving)


def test_a_frame_shows_the_row_of_its_block():
    for index in range(3):
        frame = Frame(block(True), index, 7 + index, NO_COLLISIONS)
        assert frame.stamp == 10 * frame.tick
        assert np.array_equal(frame.positions, POSITIONS[index])
        assert np.array_equal(frame.velocities, VELOCITIES[index])


def test_balls_move_in_a_shot_until_the_frame_that_finishes_it():
    assert Frame(block(True), 0, 7, NO_COLLISIONS).moving
    assert not Frame(block(True), 2, 9, NO_COLLISIONS, finished=True).moving
    assert not Frame(block(False), 0, 7, NO_COLLISIONS).moving


def test_the_columns_are_those_that_readers_know():
    assert COLLISION_COLUMNS == ('seq', 't', 'kind', 'a', 'b', 'x', 'y', 'nx', 'ny', 'speed')
    assert VELOCITY_COLUMNS == ('vx', 'vy')
    assert NO_COLLISIONS.shape == (0, len(COLLISION_COLUMNS))
