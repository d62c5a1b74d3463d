"""The markers, and when they are sent."""

import dataclasses

import numpy as np
import pytest
from visualization_msgs.msg import Marker

from pool_sim_ros.physics import cue_strike, pool_table, report_table, simulate
from pool_sim_ros.ros.markers import Markers
from pool_sim_ros.simulator.frame import COLLISION_COLUMNS
from pool_sim_ros.simulator.layout import start_layout
from pool_sim_ros.simulator.playback import Playback

TABLE = report_table()
NOTHING = np.empty((0, len(COLLISION_COLUMNS)))


def by_name(array):
    """Return the markers by namespace and id; none may be there twice."""
    shown = [marker for marker in array.markers if marker.action != Marker.DELETEALL]
    found = {(marker.ns, marker.id): marker for marker in shown}
    assert len(found) == len(shown)
    return found


class Viewer:
    """Shows what RViz shows after some messages, in their order."""

    def __init__(self):
        self.shown = {}

    def take(self, array):
        by_name(array)
        for marker in array.markers:
            if marker.action == Marker.DELETEALL:
                self.shown.clear()
            elif marker.action == Marker.DELETE:
                self.shown.pop((marker.ns, marker.id), None)
            else:
                assert marker.type != Marker.LINE_LIST or marker.points, 'viewers complain'
                self.shown[marker.ns, marker.id] = marker
        return self

    def count(self, namespace):
        return sum(ns == namespace for ns, _ in self.shown)


def place(marker):
    position = marker.pose.position
    return position.x, position.y, position.z


def lines(marker):
    """Return the trails, as a list of [[x, y], [x, y]] for each colour."""
    assert len(marker.points) == len(marker.colors) and len(marker.points) % 2 == 0
    found = {}
    for start, end, color in zip(
        marker.points[::2], marker.points[1::2], marker.colors[::2], strict=True
    ):
        key = round(color.r, 4), round(color.g, 4), round(color.b, 4)
        found.setdefault(key, []).append([[start.x, start.y], [end.x, end.y]])
    return found


def test_the_table_is_a_cloth_of_its_size_between_four_cushions():
    found = by_name(Markers(TABLE, 'felt').table())
    cloth = found.pop(('table', 0))
    assert (cloth.scale.x, cloth.scale.y) == (TABLE.length, TABLE.width)
    assert place(cloth)[2] + cloth.scale.z / 2 == pytest.approx(0.0)
    faces = set()
    assert len(found) == 4
    for cushion in found.values():
        x, y, _ = place(cushion)
        if cushion.scale.x < cushion.scale.y:
            faces.add(('x', round(x + np.sign(TABLE.length / 2 - x) * cushion.scale.x / 2, 9)))
        else:
            faces.add(('y', round(y + np.sign(TABLE.width / 2 - y) * cushion.scale.y / 2, 9)))
    assert faces == {('x', 0.0), ('x', TABLE.length), ('y', 0.0), ('y', TABLE.width)}
    assert all(m.header.frame_id == 'felt' for m in (cloth, *found.values()))


def test_every_ball_has_its_colour_size_place_and_a_label_that_faces_the_viewer():
    found = by_name(Markers(TABLE, 'table').everything(TABLE.positions + 0.01))
    for i, ball in enumerate(TABLE.balls):
        marker, label = found['balls', i], found['labels', i]
        x, y = TABLE.positions[i] + 0.01
        assert place(marker) == (x, y, ball.radius)
        assert marker.type == Marker.SPHERE and marker.scale.x == 2 * ball.radius
        assert (marker.color.r, marker.color.g, marker.color.b) == pytest.approx(ball.color)
        assert label.type == Marker.TEXT_VIEW_FACING and label.text == ball.label
        assert place(label)[:2] == (x, y) and place(label)[2] > 2 * ball.radius


def test_a_table_at_rest_changes_nothing():
    markers = Markers(TABLE, 'table')
    markers.everything(TABLE.positions)
    assert markers.changes(TABLE.positions, NOTHING, started=False, rolling=False) is None


def test_balls_that_are_put_elsewhere_leave_no_trail():
    markers = Markers(TABLE, 'table')
    markers.everything(TABLE.positions)
    positions = TABLE.positions.copy()
    positions[3] += 0.02
    found = by_name(markers.changes(positions, NOTHING, started=False, rolling=False))
    assert set(found) == {('balls', 3), ('labels', 3), ('trails', 0)}
    assert found['trails', 0].points == []


def test_a_shot_moves_only_what_rolls_flashes_at_contacts_and_leaves_exact_trails():
    shot = simulate(TABLE, (-4.0, 0.3))
    playback = Playback(start_layout(TABLE), 60)
    playback.strike()
    playback.computed(shot)
    markers = Markers(TABLE, 'table')
    markers.everything(TABLE.positions)
    flashes, before = [], TABLE.positions
    while True:
        frame = playback.next_frame()
        changes = markers.changes(
            frame.positions, frame.collisions, started=frame.started, rolling=True
        )
        moved = np.flatnonzero(np.any(frame.positions != before, axis=1))
        found = by_name(changes)
        assert {i for ns, i in found if ns == 'balls'} == set(moved.tolist())
        for i in moved:
            assert place(found['balls', i])[:2] == tuple(frame.positions[i])
        flashes += [place(m)[:2] for (ns, _), m in found.items() if ns == 'flashes']
        assert all(m.lifetime.nanosec > 0 for (ns, _), m in found.items() if ns == 'flashes')
        before = frame.positions
        if frame.finished:
            break
    contacts = shot.events[shot.events['kind'] < 2]
    assert flashes == [(event['x'], event['y']) for event in contacts]
    trails = lines(found['trails', 0])
    for i, ball in enumerate(TABLE.balls):
        way = shot.path(i)
        trail = trails.get(tuple(round(float(np.float32(part)), 4) for part in ball.color), [])
        corners = [end for start, end in trail if start != end]
        assert len(corners) == len(way) - 1
        np.testing.assert_allclose(np.reshape(corners, (-1, 2)), way[1:], atol=1e-9)


def test_the_next_shot_begins_without_the_trails_of_the_last():
    markers = Markers(TABLE, 'table')
    markers.everything(TABLE.positions)
    markers.changes(TABLE.positions, NOTHING, started=True, rolling=True)
    rolled = TABLE.positions + [0.1, 0.0]
    assert markers.changes(rolled, NOTHING, started=False, rolling=True).markers[-1].points
    again = markers.changes(TABLE.positions, NOTHING, started=True, rolling=True)
    assert again.markers[-1].points == []


def test_all_there_is_stands_in_one_message():
    viewer = Viewer().take(Markers(TABLE, 'table').everything(TABLE.positions))
    count = len(TABLE.balls)
    assert {ns: viewer.count(ns) for ns in ('table', 'cushions', 'balls', 'labels')} == {
        'table': 1,
        'cushions': 4,
        'balls': count,
        'labels': count,
    }
    assert len(viewer.shown) == 1 + 4 + 2 * count


def test_a_table_with_fewer_balls_leaves_none_of_those_before():
    few = dataclasses.replace(TABLE, balls=TABLE.balls[:3])
    viewer = Viewer().take(Markers(TABLE, 'table').everything(TABLE.positions))
    viewer.take(Markers(few, 'table').everything(few.positions))
    assert (viewer.count('balls'), viewer.count('labels')) == (3, 3)
    # First of all: what stands before it would never be seen.
    array = Markers(few, 'table').everything(few.positions)
    assert [m.action == Marker.DELETEALL for m in array.markers] == [True] + [False] * (
        len(array.markers) - 1
    )
    assert array.markers[0].ns == ''


def contacts(count):
    """Return rows of collisions of the first two balls, all at different places."""
    rows = np.zeros((count, len(COLLISION_COLUMNS)))
    rows[:, COLLISION_COLUMNS.index('b')] = 1
    rows[:, COLLISION_COLUMNS.index('x')] = np.linspace(0.5, 1.0, count)
    rows[:, COLLISION_COLUMNS.index('nx')] = 1.0
    return rows


@pytest.mark.parametrize('count', [1, 32, 33, 64, 500])
def test_a_message_has_at_most_32_flashes_each_under_an_id_of_its_own(count):
    markers = Markers(TABLE, 'table')
    markers.everything(TABLE.positions)
    for _ in range(3):
        found = by_name(
            markers.changes(TABLE.positions, contacts(count), started=False, rolling=True)
        )
        flashes = [marker for (ns, _), marker in found.items() if ns == 'flashes']
        assert len(flashes) == min(count, 32)
        # Those of the latest contacts: a viewer would show the others for no time at all.
        latest = contacts(count)[-32:, COLLISION_COLUMNS.index('x')]
        assert [place(marker)[0] for marker in flashes] == latest.tolist()
        all_there_is = by_name(markers.everything(TABLE.positions))
        assert sum(ns == 'flashes' for ns, _ in all_there_is) == len(flashes)


def test_no_viewer_is_sent_lines_without_points():
    markers, viewer = Markers(TABLE, 'table'), Viewer()
    viewer.take(markers.everything(TABLE.positions))
    rolled = TABLE.positions + [0.1, 0.0]
    for positions, started in ((TABLE.positions, True), (rolled, False), (TABLE.positions, True)):
        viewer.take(markers.changes(positions, NOTHING, started=started, rolling=True))
        assert viewer.count('trails') == (not started)
        viewer.take(markers.everything(positions))
        assert viewer.count('trails') == (not started)


@pytest.fixture(scope='module')
def pool():
    """A table whose balls spin, and the frames of a break that loses the cue ball."""
    table = pool_table('7ft')
    velocity, spin = cue_strike(table, speed=9.0, azimuth=180.3, side=0.1, above=0.2)
    playback = Playback(start_layout(table), 60)
    playback.strike()
    playback.computed(simulate(table, velocity, spins=spin))
    frames = [playback.next_frame()]
    while not frames[-1].finished:
        frames.append(playback.next_frame())
    return table, frames


def shown(pool):
    """Yield each frame of a break, and what a viewer shows then."""
    table, frames = pool
    markers, viewer = Markers(table, 'table'), Viewer()
    start = start_layout(table)
    viewer.take(markers.everything(start.positions, start.orientations))
    for frame in frames:
        changes = markers.changes(
            frame.positions,
            frame.collisions,
            started=frame.started,
            rolling=True,
            turned=frame.orientations,
            pocketed=frame.pocketed,
        )
        yield frame, viewer if changes is None else viewer.take(changes)


def test_balls_that_spin_turn_with_their_spots_and_fall_below_the_cloth(pool):
    table, frames = pool
    for frame, viewer in shown(pool):
        if frame.tick % 10 and not frame.finished:
            continue
        for i, ball in enumerate(table.balls):
            marker, spots = viewer.shown['balls', i], viewer.shown['spots', i]
            label = viewer.shown['labels', i]
            height = -ball.radius if i in frame.pocketed else ball.radius
            assert place(marker) == place(spots) == (*frame.positions[i], height)
            q = spots.pose.orientation
            assert [q.x, q.y, q.z, q.w] == frame.orientations[i].tolist()
            assert place(label)[2] - height == pytest.approx(1.7 * ball.radius)
    assert len(frames[-1].pocketed) == 2
    points = np.array([[p.x, p.y, p.z] for p in spots.points])
    out = np.linalg.norm(points, axis=1) + spots.scale.x / 2
    assert np.all((ball.radius < out) & (out < 1.1 * ball.radius))  # they are seen on it


def test_a_spot_is_light_on_a_dark_ball_and_dark_on_a_light_one(pool):
    table, _ = pool
    found = by_name(Markers(table, 'table').everything(table.positions))
    light = {table.labels[i]: found['spots', i].color.r for i in range(len(table.balls))}
    assert light['C'] == 0.0 and light['8'] == 1.0


def test_trails_follow_paths_that_curve_into_the_pockets_with_few_lines(pool):
    table, frames = pool
    *_, (_, viewer) = shown(pool)
    trails = viewer.shown['trails', 0]
    assert len(trails.points) < 2000
    ends = np.array([[p.x, p.y] for p in trails.points]).reshape(-1, 2, 2)
    colors = np.array([[c.r, c.g, c.b] for c in trails.colors]).reshape(-1, 2, 3)[:, 0]
    mine = ends[np.all(colors == np.float32(table.balls[0].color), axis=1)]  # no other is white
    places = np.array([frame.positions[0] for frame in frames])
    for x, y in places[::7]:
        along = mine[:, 1] - mine[:, 0]
        lengths = np.maximum(np.sum(along**2, axis=1), 1e-18)
        share = np.clip(np.sum(([x, y] - mine[:, 0]) * along, axis=1) / lengths, 0.0, 1.0)
        nearest = mine[:, 0] + share[:, np.newaxis] * along
        assert np.hypot(*(nearest - [x, y]).T).min() < 2e-3


def test_one_message_holds_pockets_and_spots(pool):
    table, _ = pool
    viewer = Viewer().take(Markers(table, 'table').everything(table.positions))
    counts = {ns: viewer.count(ns) for ns in ('pockets', 'rails', 'spots', 'balls', 'labels')}
    assert counts == {'pockets': 6, 'rails': 18, 'spots': 16, 'balls': 16, 'labels': 16}


def test_discs_have_neither_spots_nor_pockets():
    viewer = Viewer().take(Markers(TABLE, 'table').everything(TABLE.positions))
    assert {ns for ns, _ in viewer.shown} == {'table', 'cushions', 'balls', 'labels'}
