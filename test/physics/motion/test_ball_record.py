import numpy as np

from pool_sim_ros.physics.boundary import Rectangle, pocketed_boundary
from pool_sim_ros.physics.motion import BALL, RESTS, BallTable
from pool_sim_ros.physics.motion.ball_record import spheres_at_rest
from pool_sim_ros.physics.pool_tables import pool_table_dimensions


def records(positions, boundary):
    n = len(positions)
    return spheres_at_rest(
        np.array(positions), np.full(n, 0.03), np.full(n, 0.25), np.arange(n) == 0, boundary
    )


def test_a_ball_takes_three_cache_lines_and_others_need_only_the_first():
    assert BALL.itemsize <= 3 * 64
    ends = {name: offset + field.itemsize for name, (field, offset) in BALL.fields.items()}
    assert max(ends[n] for n in ('x', 'y', 'vx', 'vy', 'ax', 'ay', 'since', 'phase')) <= 64
    assert max(ends[n] for n in ('next_contact_time', 'cell_exit_time', 'radius')) <= 128


def test_at_first_all_rest_where_they_lie():
    found = records([(0.2, 0.3), (0.5, 0.6)], Rectangle(2.0, 1.0))
    assert found.dtype == BALL
    assert found[['x', 'y']].tolist() == [(0.2, 0.3), (0.5, 0.6)]
    assert found['inverse_mass'].tolist() == [4.0, 4.0] and (found['radius'] == 0.03).all()
    assert found['is_cue'].tolist() == [1, 0]
    assert (found['phase'] == RESTS).all() and (found['pocket'] == -1).all()
    for name in ('phase_end', 'next_contact_time', 'cell_exit_time'):
        assert (found[name] == np.inf).all()
    assert (found['last_contact_time'] == -np.inf).all()
    for name in ('vx', 'vy', 'ax', 'ay', 'wx', 'wy', 'wz', 'since', 'changes'):
        assert not found[name].any()


def test_a_ball_in_the_circle_of_a_pocket_is_nowhere():
    given = pool_table_dimensions('7ft')
    boundary = pocketed_boundary(
        (given.length, given.width),
        np.array(given.cushions.segments),
        np.array(given.cushions.noses),
        np.array(given.pockets),
        given.ball_radius,
    )
    found = records([(0.5, 0.5), (0.0, 0.0), tuple(given.pockets[4, :2])], boundary)
    assert found['pocket'].tolist() == [-1, 0, 4]
    assert found['x'].tolist() == [0.5, np.inf, np.inf]
    assert found['y'].tolist() == [0.5, np.inf, np.inf]


def test_the_kernels_table_names_its_boundary_first():
    assert BallTable._fields[:5] == ('boundary', 'slide', 'roll', 'spin', 'radius')
