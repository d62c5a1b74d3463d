"""A table as it is given, and what the kernels get of it. Bad values are in `test_bad_input`."""

import dataclasses
import pickle

import numpy as np
import pytest
from tables import LAWS, random_table, table_of, under

from pool_sim_ros.physics import Ball, Table
from pool_sim_ros.physics.boundary import Rectangle
from pool_sim_ros.physics.motion import DISC, RESTS, DiscTable

ARRAYS = ('positions', 'radii', 'masses', 'is_cue', 'balls_at_rest')


def test_arrays_say_what_the_balls_say():
    table = random_table(np.random.default_rng(1), 7)
    assert table.labels == tuple(str(k) for k in range(7))
    for k, ball in enumerate(table.balls):
        assert tuple(table.positions[k]) == ball.position
        assert (table.radii[k], table.masses[k]) == (ball.radius, ball.mass)
        assert table.is_cue[k] == ball.is_cue


@pytest.mark.parametrize('name', ARRAYS)
def test_arrays_are_made_once_and_cannot_be_changed(name):
    table = table_of([(0.5, 0.5), (1.0, 0.5)])
    array = getattr(table, name)
    assert getattr(table, name) is array
    with pytest.raises(ValueError, match='read-only'):
        array[0] = array[1]


def test_what_the_kernels_know():
    for law in LAWS:
        table = random_table(np.random.default_rng(2), 3, law)
        assert table.for_kernels == DiscTable(
            boundary=Rectangle(table.length, table.width),
            deceleration=table.mu_ball_surface * table.gravity,
            mu_ball_ball=table.mu_ball_ball,
            mu_ball_cushion=table.mu_ball_cushion,
            e_cue_ball=table.e_cue_ball,
            e_ball_ball=table.e_ball_ball,
            e_ball_cushion=table.e_ball_cushion,
            coulomb=law == 'coulomb',
            cue_ball=0,
        )
        # numba compiles anew for another type of any of these.
        assert [type(value) for value in table.for_kernels] == [
            Rectangle,
            *[float] * 6,
            bool,
            int,
        ]


@pytest.mark.parametrize(('cues', 'expected'), [((), -1), ((0,), 0), ((2,), 2), ((1, 2), 1)])
def test_the_number_of_the_cue_ball(cues, expected):
    table = table_of([(0.5, 0.5), (1.0, 0.5), (1.5, 0.5)])
    balls = [dataclasses.replace(ball, is_cue=k in cues) for k, ball in enumerate(table.balls)]
    assert under(table, balls=balls).for_kernels.cue_ball == expected


def test_the_records_of_the_balls():
    table = random_table(np.random.default_rng(3), 5)
    records = table.balls_at_rest
    assert records.dtype == DISC and len(records) == 5
    np.testing.assert_array_equal(records['x'], table.positions[:, 0])
    np.testing.assert_array_equal(records['y'], table.positions[:, 1])
    np.testing.assert_array_equal(records['radius'], table.radii)
    np.testing.assert_allclose(records['inverse_mass'] * table.masses, 1.0, rtol=1e-15)
    assert records['is_cue'].tolist() == [1, 0, 0, 0, 0]
    assert np.all(records['phase'] == RESTS)
    for name in ('ux', 'uy', 'speed', 'since', 'changes', 'repeats', 'rounds'):
        assert not records[name].any()
    assert np.all(records['next_contact_time'] == np.inf)
    assert np.all(records['last_contact_time'] == -np.inf)


def test_a_record_takes_no_more_than_two_cache_lines():
    assert DISC.itemsize <= 2 * 64


def test_numbers_may_be_given_in_any_type():
    ball = Ball('1', np.float32(0.5), 1, np.array([1, 2]), color=[0, 0, 1], is_cue=1)
    assert (ball.mass, ball.radius, ball.position) == (0.5, 1.0, (1.0, 2.0))
    assert ball.color == (0.0, 0.0, 1.0) and ball.is_cue is True
    table = Table(np.int64(9), 5, iter([ball]))
    assert (table.length, table.width) == (9.0, 5.0) and table.balls == (ball,)


def test_tables_are_equal_by_value_and_can_be_sent():
    table = table_of([(0.5, 0.5), (1.0, 0.5)])
    assert table == table_of([(0.5, 0.5), (1.0, 0.5)])
    assert table != under(table, e_ball_ball=0.5)
    assert len({table, table_of([(0.5, 0.5), (1.0, 0.5)])}) == 1
    table.positions, table.for_kernels  # noqa: B018, to have them cached
    sent = pickle.loads(pickle.dumps(table))
    assert sent == table
    np.testing.assert_array_equal(sent.positions, table.positions)
