"""A shot on its way to a page, against the trajectory itself."""

import json

import numpy as np
import pytest
from spin_tables import spin_table

from pool_sim_ros.physics import EventKind, report_table, simulate
from pool_sim_ros.web_view.motion import EVENT_FIELDS, event_rows, motion_fields

DISCS = report_table(), (-4.0, 0.1), None
SPHERES = spin_table([(1.0, 0.5), (0.5, 0.52), (1.5, 0.2)]), (-3.0, 0.0), (10.0, 60.0, 20.0)


def place(fields, ball, time):
    """Look a ball up as the page does."""
    rows = [row for row in fields['segments'] if row[0] == ball and row[1] <= time]
    if not rows:
        return fields['start'][ball]
    _, t, x, y, vx, vy, ax, ay = rows[-1][:8]
    t = time - t
    return [x + t * (vx + 0.5 * t * ax), y + t * (vy + 0.5 * t * ay)]


@pytest.mark.parametrize(('table', 'velocity', 'spin'), [DISCS, SPHERES])
def test_the_page_can_look_up_every_ball_at_every_time(table, velocity, spin):
    shot = simulate(table, velocity, spins=spin)
    fields = json.loads(json.dumps(motion_fields(shot, table.positions)))
    assert fields['duration'] == shot.duration
    assert fields['ends'] == shot.final_positions.tolist()
    for time in np.linspace(0.0, shot.duration, 200):
        found = [place(fields, ball, time) for ball in range(len(table.balls))]
        np.testing.assert_allclose(found, shot.positions(time), rtol=0, atol=1e-12)


@pytest.mark.parametrize(('table', 'velocity', 'spin'), [DISCS, SPHERES])
def test_balls_that_stay_have_no_rows(table, velocity, spin):
    shot = simulate(table, velocity, spins=spin)
    fields = motion_fields(shot, table.positions)
    moved = np.any(shot.final_positions != table.positions, axis=1)
    assert {int(row[0]) for row in fields['segments']} == set(np.flatnonzero(moved).tolist())
    assert not moved.all()


def test_a_ball_that_only_turns_has_rows():
    table = spin_table([(1.0, 0.5), (0.5, 0.5)])
    shot = simulate(table, (0.0, 0.0), spins=(0.0, 0.0, 50.0))
    fields = motion_fields(shot, table.positions)
    assert {row[0] for row in fields['segments']} == {0.0}


def test_contacts_are_listed_and_stops_are_not():
    shot = simulate(*DISCS[:2])
    contacts = shot.events[shot.events['kind'] != EventKind.STOP]
    rows = event_rows(shot)
    assert [row[0] for row in rows] == contacts['t'].tolist()
    assert rows[0] == [contacts[0][name] for name in EVENT_FIELDS]
