"""When which markers are sent, and what a viewer with a short queue is left with."""

import pytest
from process_harness import node_process
from rclpy.qos import DurabilityPolicy, QoSProfile
from ros_harness import Observer
from visualization_msgs.msg import Marker

from pool_sim_ros.physics import report_table
from pool_sim_ros.ros import interface

TABLE = report_table()
EVERYTHING = {'table': 1, 'cushions': 4, 'balls': len(TABLE.balls), 'labels': len(TABLE.balls)}


class Viewer:
    """A viewer as RViz (depth 5) and foxglove_bridge (depth 2) are."""

    def __init__(self, ros, depth, node, durability=DurabilityPolicy.TRANSIENT_LOCAL):
        self.shown = {}
        self.messages = 0
        self.deletions = 0
        topic = interface.MARKERS
        qos = QoSProfile(depth=depth, durability=durability)
        self._node = ros.node('viewer')
        self._node.create_subscription(topic.type, topic.of(node), self._take, qos)

    def _take(self, array):
        self.messages += 1
        for marker in array.markers:
            if marker.action == Marker.DELETEALL:
                self.shown.clear()
                self.deletions += 1
            elif marker.action == Marker.DELETE:
                self.shown.pop((marker.ns, marker.id), None)
            else:
                self.shown[marker.ns, marker.id] = marker

    def counts(self):
        return {name: sum(ns == name for ns, _ in self.shown) for name in EVERYTHING}

    def balls(self):
        balls = sorted((i, m.pose.position) for (ns, i), m in self.shown.items() if ns == 'balls')
        return [(place.x, place.y) for _, place in balls]


@pytest.mark.parametrize('depth', [1, 2, 5, 10])
def test_a_viewer_that_comes_after_a_shot_sees_everything(ros, depth):
    ros.sim_node(real_time_factor=0.0)
    observer = Observer(ros).wait_for_match()
    early = Viewer(ros, 5, interface.NODE_NAME)
    ros.spin_until(lambda: early.counts() == EVERYTHING, 'what an early viewer is shown')
    done = observer.wait_for_phase(observer.ask(velocity=[-3.0, 0.4]), 'done')
    ends = [tuple(place) for place in done['final_positions'].values()]
    ros.spin_until(lambda: early.balls() == ends, 'the end')
    late = Viewer(ros, depth, interface.NODE_NAME)
    ros.spin_until(
        lambda: late.counts() == EVERYTHING and late.balls() == ends, 'what a late viewer is shown'
    )


def test_a_table_at_rest_is_not_sent_over_and_over(ros):
    ros.sim_node()
    observer = Observer(ros).wait_for_match()
    viewer = Viewer(ros, 10, interface.NODE_NAME)
    ros.spin_until(lambda: viewer.counts() == EVERYTHING, 'the table')
    quiet, last = viewer.messages, len(observer.stamps)
    ros.spin_until(lambda: len(observer.stamps) > last + 30, 'frames at rest')
    assert viewer.messages <= quiet + 2  # what it was sent as it came


@pytest.mark.parametrize(
    'durability', [DurabilityPolicy.TRANSIENT_LOCAL, DurabilityPolicy.VOLATILE]
)
def test_a_viewer_that_comes_while_balls_roll_sees_everything(ros, durability):
    ros.sim_node('slow', real_time_factor=0.05)
    observer = Observer(ros, 'slow').wait_for_match()
    observer.wait_for_phase(observer.ask(velocity=[-3.0, 0.4]), 'accepted')
    ros.spin_until(lambda: observer.state['moving'], 'the shot')
    Viewer(ros, 5, 'slow')
    viewer = Viewer(ros, 2, 'slow', durability)
    ros.spin_until(lambda: viewer.counts() == EVERYTHING, 'the table')
    assert observer.state['moving']
    start = [ball.position for ball in TABLE.balls]
    ros.spin_until(lambda: viewer.balls()[0] != start[0], 'the ball that rolls')


def test_a_viewer_that_comes_while_a_shot_is_paused_sees_everything(ros):
    ros.sim_node('paused', real_time_factor=0.1)
    observer = Observer(ros, 'paused').wait_for_match()
    observer.wait_for_phase(observer.ask(velocity=[-3.0, 0.4]), 'accepted')
    ros.spin_until(lambda: observer.state['moving'], 'the shot')
    observer.call(interface.SET_PAUSED, data=True)
    ros.spin_until(lambda: observer.state['paused'], 'the pause')
    viewer = Viewer(ros, 2, 'paused')
    ros.spin_until(lambda: viewer.counts() == EVERYTHING, 'the table')

    def latest():
        poses = observer.heard[interface.BALL_POSES.name][-1].poses
        return [(pose.position.x, pose.position.y) for pose in poses]

    ros.spin_until(lambda: viewer.balls() == latest(), 'the balls where they stopped')


FEW = ['C', 'a', 'b']


def few_balls():
    places = ' '.join(f'{0.3 + 0.3 * i}, 0.5,' for i in range(len(FEW))).rstrip(',')
    return {
        'balls.labels': str(FEW).replace("'", '"'),
        'balls.masses': str([0.2] * len(FEW)),
        'balls.radii': str([0.03] * len(FEW)),
        'balls.positions': f'[{places}]',
        'balls.colors': str([0.5] * 3 * len(FEW)),
    }


def test_after_a_restart_with_fewer_balls_none_of_the_old_ones_stays(ros):
    named = ['--ros-args', '-r', '__node:=again']
    viewer = Viewer(ros, 5, '/again')
    with node_process(*named):
        ros.spin_until(lambda: viewer.counts() == EVERYTHING, 'the table')
    with node_process(*named, **few_balls()):
        wanted = EVERYTHING | {'balls': len(FEW), 'labels': len(FEW)}
        ros.spin_until(lambda: viewer.counts() == wanted, 'the new table')
        texts = {m.text for (ns, _), m in viewer.shown.items() if ns == 'labels'}
        assert texts == set(FEW)


def test_nothing_flickers_while_balls_roll(ros):
    """Only whoever comes, a strike and a rest need all of it, which begins with an empty table."""
    ros.sim_node('steady')
    observer = Observer(ros, 'steady').wait_for_match()
    viewer = Viewer(ros, 50, 'steady')
    ros.spin_until(lambda: viewer.counts() == EVERYTHING, 'the table')
    before, messages = viewer.deletions, viewer.messages
    observer.wait_for_phase(observer.ask(velocity=[-3.0, 0.4]), 'done')
    ros.spin_until(lambda: viewer.messages > messages + 30, 'the frames of the shot')
    assert viewer.deletions - before <= 4
