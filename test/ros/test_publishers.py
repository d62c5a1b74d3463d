"""What the node sends: every frame, and what goes with it."""

import json
import signal
from dataclasses import replace
from pathlib import Path

import numpy as np
import plain_messages
import pytest
from process_harness import Process
from rclpy.duration import Duration
from ros_harness import Observer
from shot_frames import shot_frames

from pool_sim_ros.ros import Publishers, interface, messages
from pool_sim_ros.simulator import Diagnosis, build_settings, default_values, table_from_json

SETTINGS = build_settings(default_values())
TABLE = SETTINGS.table
PATIENCE = Duration(seconds=60.0)
COUNTING_READER = Path(__file__).parents[1] / 'support' / 'counting_reader.py'
FRAMES = ('ball_poses', 'ball_velocities', 'collisions')


class Sender:
    """Publishers on a node, and somebody who hears them."""

    def __init__(self, ros, **settings):
        node = ros.node('sender')
        self.name = node.get_name()
        self.observer = Observer(ros, self.name)
        self.output = Publishers(node, replace(SETTINGS, **settings))
        ros.spin_until(self.output.is_read, 'the reader')

    def heard(self, topic):
        return self.observer.heard[topic]


def test_a_shot_is_sent_frame_by_frame_bit_for_bit(ros):
    sender = Sender(ros)
    frames = shot_frames(TABLE, (-4.0, 0.3))
    for frame in frames:
        sender.output.frame(frame)
        sender.output.wait_for_delivery(PATIENCE)  # the queue holds ten
    touched = [frame.collisions for frame in frames if len(frame.collisions)]
    wanted = {'ball_poses': len(frames), 'ball_velocities': len(frames), 'collisions': len(touched)}
    ros.spin_until(lambda: {t: len(sender.heard(t)) for t in FRAMES} == wanted, 'all of it')
    radii = TABLE.radii.tolist()
    for poses, velocities, frame in zip(
        sender.heard('ball_poses'), sender.heard('ball_velocities'), frames, strict=True
    ):
        assert poses == plain_messages.to_poses('table', frame.stamp, frame.positions, radii)
        assert velocities == plain_messages.to_velocities(frame.velocities)
    assert sender.heard('collisions') == [plain_messages.to_collisions(rows) for rows in touched]


def test_frames_are_kept_for_half_a_second_at_30_times_real_time(ros):
    node = ros.node('sender')
    Publishers(node, SETTINGS)
    depths = {publisher.topic_name: publisher.qos_profile.depth for publisher in node.publishers}
    for topic in (interface.BALL_POSES, interface.BALL_VELOCITIES, interface.COLLISIONS):
        assert depths[topic.of(node.get_fully_qualified_name())] >= 0.5 * 30 * 60


@pytest.mark.soak
def test_a_reader_that_did_not_run_for_800_frames_gets_all_of_them(ros):
    """0.44 s at 30 times real time; shared memory holds 512 messages for it, of all topics."""
    node = ros.node('sender')
    output = Publishers(node, SETTINGS)
    frame, *_ = shot_frames(TABLE, (-4.0, 0.3))
    with Process(COUNTING_READER, node.get_fully_qualified_name(), '800') as reader:
        reader.wait_for('matched')
        ros.spin_until(
            lambda: (
                output._poses.get_subscription_count()
                and output._velocities.get_subscription_count()
            ),
            'the reader',
        )
        reader.signal(signal.SIGSTOP)
        for _ in range(800):
            output.frame(frame)
        reader.signal(signal.SIGCONT)
        reader.wait_for('all of them')
        assert reader.wait() == 0


def test_what_was_made_ready_for_other_ticks_is_not_sent(ros):
    sender = Sender(ros)
    [frame, *_] = shot_frames(TABLE, (-4.0, 0.3))
    [other, *_] = shot_frames(TABLE, (2.0, 0.3))
    sender.output.prepare(other.block)
    sender.output.frame(frame)
    ros.spin_until(lambda: sender.heard('ball_velocities'), 'the frame')
    [velocities] = sender.heard('ball_velocities')
    assert np.array_equal(messages.from_rows(velocities), frame.velocities)


def test_the_clock_is_sent_only_where_it_is_wanted(ros):
    [frame, *_] = shot_frames(TABLE, (-4.0, 0.3))
    quiet, loud = Sender(ros), Sender(ros, publish_clock=True)
    publishers = quiet.observer.node.get_publishers_info_by_topic('/clock')
    assert [info.node_name for info in publishers] == [loud.name]
    ros.spin_until(
        lambda: loud.output._clock.get_subscription_count() == 2, 'the readers of the clock'
    )
    for sender in (quiet, loud):
        sender.output.clock(1_500_000_000)
        sender.output.frame(frame)
    ros.spin_until(lambda: loud.heard('/clock'), 'the clock')
    last = loud.heard('/clock')[-1]
    assert messages.from_time(last.clock) in (1_500_000_000, frame.stamp)


def test_the_table_is_kept_for_those_who_come_late(ros):
    sender = Sender(ros)
    sender.output.table(SETTINGS)
    late = Observer(ros, sender.name)
    ros.spin_until(lambda: late.heard['table'], 'the table')
    assert table_from_json(late.heard['table'][-1].data) == TABLE


def test_the_state_is_json(ros):
    sender = Sender(ros)
    state = {'paused': True, 'tick': 7}
    sender.output.state(state)
    ros.spin_until(lambda: sender.heard('state'), 'the state')
    assert json.loads(sender.heard('state')[-1].data) == state


def test_diagnostics_name_the_node(ros):
    sender, topic, heard = Sender(ros), interface.DIAGNOSTICS, []
    reader = sender.observer.node.create_subscription(
        topic.type, topic.name, heard.append, topic.qos
    )
    ros.spin_until(reader.get_publisher_count, 'the match')
    ros.spin_until(lambda: sender.output._diagnostics.get_subscription_count(), 'the match')
    sender.output.diagnostics(1_500_000_000, Diagnosis('', {'speed': '1'}))
    ros.spin_until(lambda: heard, 'the diagnostics')
    assert heard[0].status[0].name == f'/{sender.name}: simulation'


def test_a_failure_is_told_and_ends_all(ros, capfd):
    output = Publishers(ros.node('sender'), SETTINGS)
    assert output.is_open() and not output.failed
    output.fail('the table broke')
    assert output.failed and not output.is_open()
    assert 'the table broke' in ''.join(capfd.readouterr())


def test_nobody_reads(ros):
    assert not Publishers(ros.node('sender'), SETTINGS).is_read()


def test_the_log_is_that_of_the_node(ros, capfd):
    node = ros.node('sender')
    Publishers(node, SETTINGS).tell('ready')
    log = ''.join(capfd.readouterr())
    assert 'ready' in log and node.get_name() in log
