"""The oracle's node beside a simulator: every question gets one answer, and it is the engine's."""

import json

import numpy as np
import pytest
from oracle_harness import TIMEOUT, hall, spin_until, strokes
from point_clouds import message_of
from rclpy.parameter import Parameter
from ros_harness import own_domain, spinning
from sensor_msgs.msg import PointCloud2
from visualization_msgs.msg import Marker
from waiting import wait_until

from pool_sim_ros.oracle import find_shots, what_if
from pool_sim_ros.physics import cue_strike, pool_table, report_table
from pool_sim_ros.ros import OracleError, OracleNode, WhatIfClient, interface, oracle_interface
from pool_sim_ros.ros.cdr_reader import CdrReader
from pool_sim_ros.ros.what_if_rows import REQUEST_BYTES

TABLE = report_table()
QUICK = {'report_integrator': 'event', 'real_time_factor': 20.0}
GOAL = {'ball': '9', 'to': [0.3, 0.2], 'within': 0.3}
NOISE = {'speed': 0.05, 'azimuth': 0.2}


@pytest.fixture(scope='module')
def room(domain):
    with hall(domain, **QUICK) as made:
        yield made


@pytest.fixture
def room_at_start(room):
    """The balls lie as at the start, and the oracle knows it."""
    room.shots.call(interface.RESET, timeout=TIMEOUT)
    start = room.ask([(0.0, 0.0)]).finals[0]
    while not np.array_equal(start, TABLE.positions):
        start = room.ask([(0.0, 0.0)]).finals[0]
    return room


def assert_same(found, expected):
    assert found.labels == TABLE.labels
    for name in ('finals', 'durations', 'event_counts', 'first_hit', 'pocketed'):
        assert np.array_equal(getattr(found, name), getattr(expected, name)), name


@pytest.mark.parametrize('count', [1, 1000, 50_000])
def test_a_what_if_has_the_bits_of_simulate_many(room_at_start, count):
    candidates = strokes(count)
    assert_same(room_at_start.ask(candidates), what_if(TABLE, candidates))


def test_a_burst_is_answered_whole(room_at_start):
    candidates = [strokes(10_000, seed) for seed in range(3)] * 7
    futures = [room_at_start.what_if.ask(rows) for rows in candidates]
    found = [spin_until(future) for future in futures]
    for rows, outcomes in zip(candidates[:3], found, strict=False):
        assert_same(outcomes, what_if(TABLE, rows))
    assert [len(outcomes.finals) for outcomes in found] == [10_000] * 21


def test_what_was_struck_and_what_was_placed_counts_at_once(room_at_start):
    """Without waiting: the oracle must not answer from how the balls lay before."""
    room, velocity = room_at_start, (-2.0, 0.3)
    before = room.ask([velocity])
    room.shots.play(velocity=velocity, timeout=TIMEOUT)
    after = room.ask([velocity])
    expected = what_if(TABLE, [velocity], positions=before.finals[0])
    assert np.array_equal(after.finals, expected.finals)
    for k in range(5):
        place = [1.8, 0.2 + 0.05 * k]
        room.shots.place({'9': place}, timeout=TIMEOUT)
        assert room.ask([(0.0, 0.0)]).finals[0, 9].tolist() == place


def test_balls_that_are_placed_while_the_table_is_paused_count_too(room_at_start):
    room = room_at_start
    room.shots.call(interface.SET_PAUSED, timeout=TIMEOUT, data=True)
    try:
        room.shots.place({'9': [1.9, 0.3]}, timeout=TIMEOUT)
        assert room.ask([(0.0, 0.0)]).finals[0, 9].tolist() == [1.9, 0.3]
    finally:
        room.shots.call(interface.SET_PAUSED, timeout=TIMEOUT, data=False)


def test_while_balls_move_it_says_so(room_at_start):
    room = room_at_start
    room.simulator.set_parameters([Parameter('real_time_factor', value=0.1)])
    try:
        room.simulator.runner.request('{"id": "m", "velocity": [-4.0, 0.1]}')
        wait_until(lambda: room.simulator.runner._simulation.moving, 'motion')
        with pytest.raises(OracleError, match=r'^MOVING: .*; ask again when all rest$'):
            room.ask([(-1.0, 0.0)])
        with pytest.raises(OracleError, match='^MOVING: '):
            room.plan(GOAL)
    finally:
        room.simulator.runner.reset()
        room.simulator.set_parameters([Parameter('real_time_factor', value=20.0)])
    assert len(room.ask([(-1.0, 0.0)]).finals) == 1


class Heard:
    """Sends clouds as anybody may, and keeps what the oracle says of them on its topics.

    Their stamps have two equal numbers, which those of a WhatIfClient have not.
    """

    def __init__(self, room):
        self.node = room.ros.node('heard')
        self.answers, self.rejected = [], []
        for topic, keep in (
            (oracle_interface.WHAT_IF_RESPONSE, self._on_answer),
            (oracle_interface.WHAT_IF_REJECTED, self._on_rejected),
        ):
            self.node.create_subscription(topic.type, topic.of('pool_oracle'), keep, topic.qos)
        topic = oracle_interface.WHAT_IF_REQUEST
        self.requests = self.node.create_publisher(topic.type, topic.of('pool_oracle'), topic.qos)

    def _on_answer(self, message):
        stamp = message.header.stamp
        if stamp.sec == stamp.nanosec:
            self.answers.append(message)

    def _on_rejected(self, message):
        rejection = json.loads(message.data)
        seconds, nanoseconds = rejection['stamp']
        if seconds == nanoseconds:
            self.rejected.append(rejection)

    def wait_for_match(self):
        """Ask something wrong until it is answered on both topics, and then once more: after that
        answer nothing else is under way."""

        def answered():
            self.requests.publish(candidates_message(0, count=0))
            return self.answers and self.rejected

        wait_until(answered, 'the oracle')
        self.requests.publish(candidates_message(99, count=0))
        wait_until(lambda: self.answers[-1].header.stamp.sec == 99, 'the last answer')
        wait_until(lambda: self.rejected[-1]['stamp'] == [99, 99], 'the last rejection')
        self.answers.clear()
        self.rejected.clear()


@pytest.fixture(scope='module')
def heard(room):
    heard = Heard(room)
    with spinning(heard.node):
        heard.wait_for_match()
        yield heard


def candidates_message(number, names='vx vy', count=2, **changes):
    rows = np.zeros(count, [(name, '<f8') for name in names.split()])
    return message_of(rows, (number, number), **changes)


def test_each_wrong_request_gets_one_rejection_and_a_cloud_without_points(room_at_start, heard):
    wrong = [
        (candidates_message(1, frame_id='map'), 'BAD_FRAME'),
        (candidates_message(2, is_bigendian=True), 'BAD_FIELDS'),
        (candidates_message(3, row_step=1), 'BAD_FIELDS'),
        (candidates_message(4, 'x y z'), 'BAD_FIELDS'),
        (candidates_message(5, count=0), 'BAD_REQUEST'),
        (candidates_message(6, count=50_001), 'TOO_MANY'),
        (candidates_message(7, count=REQUEST_BYTES // 16), 'TOO_MANY'),
        (candidates_message(8, 'vx vy wx wy wz'), 'BAD_CANDIDATE'),
        (candidates_message(9, data=np.full(4, np.nan).tobytes()), 'BAD_CANDIDATE'),
        (candidates_message(10, data=np.full(4, 1e300).tobytes()), 'BAD_CANDIDATE'),
        (PointCloud2(), 'BAD_FRAME'),
    ]
    for message, _ in wrong:
        heard.requests.publish(message)
    heard.requests.publish(b'\0\1\0\0\x63\0\0\0\x63\0\0\0\xff\xff\xff\xff')  # cut off
    heard.requests.publish(candidates_message(12))
    wait_until(lambda: len(heard.answers) == len(wrong) + 2, 'all answers')
    wait_until(lambda: len(heard.rejected) == len(wrong) + 1, 'all rejections')
    codes = {tuple(r['stamp']): r['code'] for r in heard.rejected}
    stamps = [(k, k) for k in range(1, 11)]
    expected = dict(zip([*stamps, (0, 0)], [code for _, code in wrong], strict=True))
    assert codes == expected | {(99, 99): 'BAD_REQUEST'}
    for rejection in heard.rejected:
        assert set(rejection) == {'stamp', 'code', 'reason'} and '\n' not in rejection['reason']
    widths = {a.header.stamp.sec: a.width for a in heard.answers}
    assert widths == dict.fromkeys([*range(11), 99], 0) | {12: 2}


def test_a_plan_is_that_of_find_shots_and_is_drawn(room_at_start):
    room, drawn = room_at_start, []
    topic = oracle_interface.PLAN_MARKERS
    viewer = room.ros.node('viewer')
    viewer.create_subscription(topic.type, topic.of('pool_oracle'), drawn.append, topic.qos)
    with spinning(viewer):
        done = room.plan(GOAL, NOISE, shots=3000, seed=4, count=2)
        plan = find_shots(TABLE, GOAL, NOISE, shots=3000, seed=4, count=2)
        assert [s['velocity'] for s in done['shots']] == [s.velocity.tolist() for s in plan]
        wait_until(lambda: drawn and len(drawn[-1].markers) > 3, 'markers')
        names = {marker.ns for marker in drawn[-1].markers}
        assert {'plan_paths', 'plan_ends', 'plan_chances'} <= names
        best = done['shots'][0]
        played = room.shots.play(velocity=tuple(best['velocity']), timeout=TIMEOUT)
        wait_until(lambda: len(drawn[-1].markers) == 1, 'the end of the markers')
        assert drawn[-1].markers[0].action == Marker.DELETEALL
    expected = what_if(TABLE, [best['velocity']]).finals[0]
    assert np.array_equal(list(played['final_positions'].values()), expected)


def test_its_topics_are_those_of_the_interface(room):
    node = room.ros.node('observer')
    heard = (oracle_interface.WHAT_IF_REQUEST, oracle_interface.PLAN_REQUEST)
    for topic in oracle_interface.TOPICS:
        name = topic.of('/pool_oracle')
        look = (
            node.get_subscriptions_info_by_topic
            if topic in heard
            else node.get_publishers_info_by_topic
        )
        wait_until(lambda look=look, name=name: look(name), name)
        assert look(name)[0].topic_type.split('/')[-1] == topic.type.__name__


def test_two_oracles_stand_side_by_side(room_at_start):
    room = room_at_start
    other = room.ros.add(OracleNode('second', context=room.ros.context, threads=1))
    node = room.ros.node('asker')
    client = WhatIfClient(node, 'second')
    with spinning(other), spinning(node):
        wait_until(other.is_ready, 'its table')
        for ask in (lambda rows: spin_until(client.ask(rows)), room.ask):
            assert_same(ask(strokes(10)), what_if(TABLE, strokes(10)))


def test_without_a_simulator_it_says_so(ros):
    oracle = ros.add(OracleNode('lonely', simulator='/nobody', context=ros.context))
    node = ros.node('asker')
    client = WhatIfClient(node, 'lonely')
    with (
        spinning(oracle),
        spinning(node),
        pytest.raises(OracleError, match='^NO_SIMULATOR: no simulator is heard as /nobody'),
    ):
        spin_until(client.ask([(1.0, 0.0)]))
    client.close()


@pytest.fixture
def apart():
    """A domain without the simulator of `room`, which has the same name."""
    with own_domain() as number:
        yield number


def test_on_a_pool_table_balls_spin_and_fall(apart):
    table = pool_table('7ft')
    with hall(apart, table_preset='7ft', real_time_factor=0.0) as room:
        room.shots.place({'C': [1.2, 0.3], '9': [1.0, 0.2]}, timeout=TIMEOUT)
        done = room.plan({'ball': '9', 'pocket': 'any'}, 'fastfiz', shots=6000, offset=0.3)
        best = done['shots'][0]
        velocity, spin = cue_strike(table, **best['cue'])
        assert [*velocity, *spin] == [*best['velocity'], *best['spin']]
        found = room.ask([best['velocity'] + best['spin']])
        played = room.shots.play(cue=best['cue'], timeout=TIMEOUT)
    assert np.array_equal(found.finals[0], list(played['final_positions'].values()))
    caught = {k: n for k, n in zip(found.labels, found.pocketed[0].tolist(), strict=True) if n >= 0}
    assert caught == played['pocketed'] and best['caught']['9'] == best['chance'] > 0.0


def test_a_table_that_changes_is_looked_at_anew(apart):
    with hall(apart, **QUICK) as room:
        changed = Parameter('table.mu_ball_surface', value=0.3)
        (result,) = room.simulator.set_parameters([changed])
        assert result.successful, result.reason
        table = room.simulator.runner._simulation.settings.table
        assert table != TABLE
        expected = what_if(table, [(-2.0, 0.1)])
        found = room.ask([(-2.0, 0.1)])
        while not np.array_equal(found.finals, expected.finals):  # it is on its way
            found = room.ask([(-2.0, 0.1)])


def test_bytes_of_a_stamp_are_read_as_they_come():
    assert CdrReader(b'\0\1\0\0\5\0\0\0\6\0\0\0').numbers('iI') == [5, 6]
