"""What is kept to play one shot after another on a table."""

import sys
import threading

import numpy as np
from batches import NO_LIMITS, NO_SPINS
from benchmark.workloads import dense_table

from pool_sim_ros.physics import report_table, simulate
from pool_sim_ros.physics.event_driven.batch import FIRST_ROOM
from pool_sim_ros.physics.event_driven.work_area import WorkArea, work_area


def test_a_work_area_makes_room_for_long_shots():
    table = dense_table(60, decelerating=True)
    velocities = np.random.default_rng(1).normal(size=(60, 2))
    area = WorkArea(table)
    for _ in range(2):
        shot = area.play(velocities, NO_SPINS, None, NO_LIMITS)
        assert shot.n_events > FIRST_ROOM + 60
        assert len(shot.events) == shot.n_events
        assert shot.events.tobytes() == simulate(table, velocities).events.tobytes()
    short = area.play(np.zeros((1, 2)), NO_SPINS, None, NO_LIMITS)
    assert short.n_events == 0 and short.events.base.nbytes == 0


def test_what_a_work_area_returned_stays():
    table = report_table()
    area = WorkArea(table)
    first = area.play(np.array([(-4.0, 0.0)]), NO_SPINS, None, NO_LIMITS)
    kept = [array.copy() for array in (first.events, first.segments, first.final_positions)]
    area.play(np.array([(3.0, 1.0)]), NO_SPINS, None, NO_LIMITS)
    for array, copy in zip(
        (first.events, first.segments, first.final_positions), kept, strict=True
    ):
        assert array.tobytes() == copy.tobytes()


def test_a_thread_keeps_one_work_area():
    tables = report_table(), report_table()
    area = work_area(tables[0])
    assert work_area(tables[0]) is area
    others = []
    worker = threading.Thread(target=lambda: others.append(work_area(tables[0])))
    worker.start()
    worker.join()
    assert others[0] is not area
    assert work_area(tables[1]) is not area
    assert work_area(tables[0]) is not area, 'it has played on another table since'


def test_one_is_kept_for_the_latest_layout_too():
    table = report_table()
    layouts = [simulate(table, (-2.0, y)).final_positions for y in (0.1, 0.3)]
    own, area = work_area(table), work_area(table, layouts[0])
    assert area is not own and work_area(table) is own
    assert work_area(table, layouts[0].copy()) is area
    expected = layouts[0].copy()
    layouts[0] += 1e-12  # the caller's array; what is kept is not
    assert work_area(table, layouts[0]) is not area
    shot = area.play(np.zeros((1, 2)), NO_SPINS, None, NO_LIMITS)
    assert shot.final_positions.tobytes() == expected.tobytes()


def test_the_states_of_many_shots_are_copies_where_there_are_few_balls(monkeypatch):
    area = WorkArea(report_table())
    silent, logging = area.silent, area.logging(100)
    assert area.silent is silent and len(logging.log.events) == 100
    assert not np.shares_memory(silent.balls, area.state.balls)
    monkeypatch.setattr(sys.modules[work_area.__module__], 'KEPT_BALLS', 10)
    large = WorkArea(report_table())
    assert np.shares_memory(large.silent.balls, large.state.balls)


def test_the_work_area_of_a_large_table_is_not_kept(monkeypatch):
    monkeypatch.setattr(sys.modules[work_area.__module__], 'KEPT_BALLS', 10)
    table = report_table()
    assert work_area(table) is not work_area(table)
