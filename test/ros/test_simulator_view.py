"""Who looks at a simulator sees its table and its balls as they lie, or a reason why not."""

import dataclasses

import numpy as np
import pytest
from geometry_msgs.msg import Point, Pose, PoseArray
from waiting import wait_until

from pool_sim_ros.physics import report_table
from pool_sim_ros.ros import OracleError, interface, messages
from pool_sim_ros.ros.simulator_view import Lying, SimulatorView
from pool_sim_ros.simulator import Phase, Response, table_to_json

TABLE = report_table()
RESTING = {'paused': False, 'moving': False, 'computing': False, 'tick': 60, 'sim_time': 1.0}


class Stub:
    """Shows what a simulator would show, when the test says so."""

    TOPICS = (
        interface.TABLE,
        interface.STATE,
        interface.BALL_POSES,
        interface.SHOT_RESPONSE,
    )

    def __init__(self, ros):
        self.node = ros.node('stub')
        self._publishers = {
            topic.name: self.node.create_publisher(topic.type, topic.of('/stub'), topic.qos)
            for topic in self.TOPICS
        }
        self.view = SimulatorView(ros.context, '/stub', 'test_view')
        wait_until(
            lambda: all(p.get_subscription_count() for p in self._publishers.values()), 'the view'
        )

    def send(self, topic, message):
        """Send, and wait until that has arrived."""
        text = isinstance(message, str)
        publisher = self._publishers[topic.name]
        publisher.publish(messages.to_string(message) if text else message)
        publisher.wait_for_all_acked()

    def table(self):
        self.send(interface.TABLE, table_to_json(TABLE))

    def state(self, **changes):
        self.send(interface.STATE, messages.to_json_string(RESTING | changes))

    def poses(self, time, positions=TABLE.positions, frame_id='table'):
        message = PoseArray(
            poses=[Pose(position=Point(x=float(x), y=float(y))) for x, y in positions]
        )
        message.header.frame_id = frame_id
        message.header.stamp = messages.to_time(round(time * 1e9))
        self.send(interface.BALL_POSES, message)

    def placed(self, time, positions):
        ends = dict(zip(TABLE.labels, np.asarray(positions).tolist(), strict=True))
        response = Response(
            'x', Phase.DONE, t_start=time, t_end=time, place={'9': ends['9']},
            final_positions=ends, final_positions_in=ends,
        )  # fmt: skip
        self.send(interface.SHOT_RESPONSE, response.to_json())

    def lies(self):
        """Return where the balls lie, once what was sent has come."""
        return self.view.lying().positions


@pytest.fixture
def stub(ros):
    stub = Stub(ros)
    yield stub
    stub.view.close()


def moved(x):
    positions = np.array(TABLE.positions)
    positions[9] = [x, 0.2]
    return positions


def wait_for(stub, positions):
    def arrived():
        try:
            return np.array_equal(stub.lies(), positions)
        except OracleError:
            return False

    wait_until(arrived, 'the layout')


def wait_for_error(stub, words):
    def told():
        try:
            stub.lies()
        except OracleError as error:
            return words in str(error)

    wait_until(told, words)


def test_nobody_is_there(stub):
    with pytest.raises(OracleError, match='^NO_SIMULATOR: no simulator is heard as /stub;'):
        stub.lies()
    assert stub.view.table() is None and stub.view.simulator == '/stub'
    assert not stub.view.has_changed(Lying(TABLE, TABLE.positions))


def test_one_that_shows_no_balls_and_one_with_others(stub):
    stub.table()
    stub.state()
    wait_for_error(stub, 'NO_SIMULATOR: /stub has not shown its balls yet; a paused one')
    stub.poses(1.0, TABLE.positions[:5])
    wait_for_error(stub, '/stub shows 5 balls, and its table has 11')


def test_the_latest_balls_at_rest_count(stub):
    stub.table()
    stub.poses(0.9)
    stub.poses(1.0, moved(1.8), 'hall')
    stub.state()
    wait_for(stub, moved(1.8))
    assert stub.view.frame_id == 'hall' and stub.view.lying().table == TABLE
    stub.state(moving=True, tick=61)
    wait_for_error(stub, 'MOVING: the balls are moving')
    assert stub.view.has_changed(Lying(TABLE, moved(1.8)))
    stub.state(computing=True, tick=62)
    wait_for_error(stub, 'MOVING: a shot is being computed')


def test_what_changed_between_two_looks_is_seen(stub):
    stub.table()
    stub.poses(1.0)
    stub.state()
    wait_for(stub, TABLE.positions)
    assert not stub.view.has_changed(Lying(TABLE, TABLE.positions))
    slow = dataclasses.replace(TABLE, mu_ball_surface=0.3)
    assert stub.view.has_changed(Lying(slow, TABLE.positions))
    stub.poses(2.0, moved(1.8))  # struck and at rest again
    stub.state(tick=120, sim_time=2.0)
    wait_for(stub, moved(1.8))
    assert stub.view.has_changed(Lying(TABLE, TABLE.positions))
    assert not stub.view.has_changed(Lying(TABLE, moved(1.8)))


def test_a_layout_that_was_placed_counts_until_a_frame_shows_another(stub):
    stub.table()
    stub.poses(1.0)
    stub.state(paused=True)
    stub.placed(1.0 + 1 / 60, moved(1.8))
    wait_for(stub, moved(1.8))
    stub.poses(1.0 + 1 / 60, moved(1.9))
    wait_for(stub, moved(1.9))


def test_a_simulator_that_was_started_anew_is_not_shown_as_it_was_before(stub):
    stub.table()
    stub.poses(1000.0, moved(1.8))
    stub.placed(1001.0, moved(1.9))
    stub.state(tick=60_000, sim_time=1000.0)
    wait_for(stub, moved(1.9))
    stub.state(tick=0, sim_time=0.0)
    wait_for_error(stub, 'has not shown its balls yet')
    stub.poses(0.1, moved(1.7))
    wait_for(stub, moved(1.7))


def test_one_that_falls_silent_is_gone(stub, monkeypatch):
    stub.table()
    stub.poses(1.0)
    stub.state()
    wait_for(stub, TABLE.positions)
    monkeypatch.setattr('pool_sim_ros.ros.simulator_view.SILENCE', 0.0)
    wait_for_error(stub, 'no simulator is heard')


def test_foreign_messages_are_left_out(stub, capfd):
    stub.table()
    stub.poses(1.0)
    stub.state()
    wait_for(stub, TABLE.positions)
    for topic in (interface.TABLE, interface.STATE, interface.SHOT_RESPONSE):
        for text in ('', 'null', '{"tick": 1e999}'):
            stub.send(topic, text)
    stub.poses(1.1, [[np.nan, 0.0]] * 11)
    wait_for(stub, TABLE.positions)
    stub.state(tick=66)
    wait_for(stub, TABLE.positions)
    wait_until(lambda: 'left out' in told(capfd, stub), 'a line in the log')


def told(capfd, stub):
    stub.lies()
    return capfd.readouterr().err
