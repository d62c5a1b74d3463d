"""What a shot is played in is put back as it was, whatever happened in it."""

import dataclasses

import numpy as np
import pytest
from benchmark.workloads import dense_table
from numba import njit
from one_shot import play_one
from tables import random_layout, random_table, random_velocity, table_of

from pool_sim_ros.physics import report_table
from pool_sim_ros.physics.event_driven.layout import place
from pool_sim_ros.physics.event_driven.state import clearance, copied, new_state, reset, start_of
from pool_sim_ros.physics.log import new_log
from pool_sim_ros.physics.outcomes import BAD_LAYOUT, PLAYED, TOO_MANY_EVENTS


@njit
def put_back(state, start, layout):
    reset(state, start, False)
    return place(state, start, layout)


@njit
def put_all_back(state, start):
    reset(state, start, True)


def begun(table):
    state = new_state(table.for_kernels, table.balls_at_rest, new_log(2000, 2000))
    return state, start_of(state)


def bits_of(state):
    """Return all that a shot depends on. Room that is written before it is read does not count."""
    grid, n = state.grid, len(state.balls)
    kept = [*(state.balls[name].tobytes() for name in state.balls.dtype.names)]
    kept += [grid.first.tobytes(), grid.following.tobytes(), grid.few.rows[:3].tobytes()]
    kept += [grid.few.moving[-1:].tobytes() if grid.few.rows.shape[1] else b'']
    kept += [state.queue['t'][n:].tobytes(), state.queue['t'][1].tobytes()]
    kept += [state.group.by_ball['index'].tobytes(), state.log.counts.tobytes()]
    return kept


def play(state, start, velocities, layout, until=np.inf, most=2000):
    ends = np.empty((2, len(layout), 2))
    velocities = np.array(velocities, dtype=float).reshape(-1, 2)
    return play_one(state, start, velocities, layout, (until, most), ends)[0]


TABLES = {
    'report': report_table,
    'few': lambda: random_table(np.random.default_rng(1), 5, mu_ball_surface=0.2),
    'many': lambda: dense_table(60, decelerating=True),
    'touching': lambda: table_of([(0.5, 0.5), (0.6, 0.5), (0.7, 0.5), (0.05, 0.05)]),
}


@pytest.mark.parametrize('name', TABLES)
def test_everything_is_put_back(name):
    table = TABLES[name]()
    n = len(table.balls)
    rng = np.random.default_rng(2)
    state, start = begun(table)
    own = np.array(table.positions)
    put_back(state, start, own)
    fresh = bits_of(state)
    elsewhere = own[:, ::1] * [-1.0, 1.0] + [table.length, 0.0]
    nowhere = np.full((n, 2), table.length / 2)
    ends = set()
    for _ in range(30):
        velocities = [random_velocity(rng, 0.1, 3.0) for _ in range(rng.choice([1, n]))]
        for layout, until, most in (
            (own, np.inf, 2000),
            (own, 0.1, 2000),
            (elsewhere, 0.3, 2000),
            (elsewhere, np.inf, 2),
            (nowhere, np.inf, 2000),
        ):
            ends.add(play(state, start, velocities, layout, until, most))
            assert put_back(state, start, own)
            assert bits_of(state) == fresh
    assert {PLAYED, BAD_LAYOUT, TOO_MANY_EVENTS} <= ends


def test_no_matter_what_was_played_before_a_shot_is_the_same():
    rng = np.random.default_rng(3)
    for make in TABLES.values():
        table = make()
        used, used_start = begun(table)
        for _ in range(20):
            layout = np.array(table.positions)
            velocities = [random_velocity(rng, 0.1, 3.0) for _ in table.balls]
            cut = rng.uniform(0.0, 0.5)
            fresh, fresh_start = begun(table)
            play(used, used_start, velocities, layout, cut)
            play(fresh, fresh_start, velocities, layout, cut)
            assert used.log.counts.tolist() == fresh.log.counts.tolist()
            count = used.log.counts[0]
            assert used.log.events[:count].tobytes() == fresh.log.events[:count].tobytes()


def test_whole_it_is_put_back_where_nothing_is_known_of_it():
    """Also balls that were put elsewhere and have not moved."""
    for make in TABLES.values():
        table = make()
        state, start = begun(table)
        put_all_back(state, start)
        fresh = bits_of(state)
        place_elsewhere = np.array(table.positions) * [-1.0, 1.0] + [table.length, 0.0]
        put_back(state, start, place_elsewhere)
        put_all_back(state, start)
        assert bits_of(state) == fresh


def plain_clearance(table):
    least = np.inf
    for i, one in enumerate(table.balls):
        x, y = one.position
        edges = (x, table.length - x, y, table.width - y)
        least = min(least, min(edges) - one.radius)
        for other in table.balls[:i]:
            apart = np.hypot(x - other.position[0], y - other.position[1])
            least = min(least, (apart - one.radius - other.radius) / 2)
    return least


def test_all_balls_may_be_moved_by_the_clearance():
    rng = np.random.default_rng(4)
    for count in (1, 2, 5, 12):
        table = random_table(rng, count)
        state, start = begun(table)
        found = clearance(state.balls, state.table.boundary)
        assert found == pytest.approx(plain_clearance(table), abs=1e-15)
        assert start.clearance_squared == pytest.approx(found**2)
        for _ in range(50):
            angles = rng.uniform(0.0, 2.0 * np.pi, count)
            steps = 0.999 * found * np.column_stack([np.cos(angles), np.sin(angles)])
            assert put_back(state, start, table.positions + steps)


def test_balls_that_overlap_a_little_have_no_clearance():
    table = table_of([(0.5, 0.5), (0.6 - 5e-10, 0.5)])
    state, start = begun(table)
    assert clearance(state.balls, state.table.boundary) < 0.0 and start.clearance_squared == 0.0


def test_a_state_does_not_change_what_it_was_made_of():
    table = report_table()
    before = table.balls_at_rest.tobytes()
    state, start = begun(table)
    play(state, start, [(-4.0, 0.0)], np.array(table.positions))
    assert table.balls_at_rest.tobytes() == before
    assert start.balls.tobytes() == before or not np.shares_memory(start.balls, state.balls)


@pytest.mark.parametrize('count', [0, 1, 7])
def test_a_copy_of_records(count):
    records = report_table().balls_at_rest[:count]
    copy = copied(records)
    assert copy.dtype == records.dtype and copy.tobytes() == records.tobytes()
    assert copy.flags.writeable and not np.shares_memory(copy, records)


def test_a_layout_from_elsewhere_fills_the_cells_anew():
    rng = np.random.default_rng(6)
    table = dense_table(60, decelerating=True)
    state, start = begun(table)
    for _ in range(10):
        layout = random_layout(rng, table.radii, table.length, table.width)
        assert put_back(state, start, layout)
        places = tuple(map(tuple, layout))
        balls = [
            dataclasses.replace(ball, position=spot)
            for ball, spot in zip(table.balls, places, strict=True)
        ]
        fresh, _ = begun(dataclasses.replace(table, balls=balls))
        for name in ('cell_x', 'cell_y', 'previous'):
            np.testing.assert_array_equal(state.balls[name], fresh.balls[name])
        np.testing.assert_array_equal(state.grid.first, fresh.grid.first)
        np.testing.assert_array_equal(state.grid.following, fresh.grid.following)
