"""The command `replay`: a recorded session over topics again."""

import hashlib

from process_harness import Process, node_process
from rclpy.qos import QoSProfile
from ros_harness import Observer

from pool_sim_ros.ros import interface
from pool_sim_ros.simulator.log_reader import read_log
from pool_sim_ros.simulator.replay import replay_frames


class RawReader:
    """Keeps the bytes of the frames and the collisions, by topic."""

    def __init__(self, ros, simulator=interface.NODE_NAME):
        node = ros.node('raw')
        topics = (interface.BALL_POSES, interface.COLLISIONS, interface.BALL_VELOCITIES)
        self.heard = {topic.name: [] for topic in topics}
        self._subscriptions = [
            node.create_subscription(
                topic.type,
                topic.of(simulator),
                self.heard[topic.name].append,
                QoSProfile(depth=20000),
                raw=True,
            )
            for topic in topics
        ]

    def matched(self):
        return all(subscription.get_publisher_count() for subscription in self._subscriptions)


def test_a_session_is_replayed_with_the_same_bytes_on_the_topics(ros, tmp_path):
    log = tmp_path / 'session.log'
    reader = RawReader(ros)
    with node_process(
        '--ros-args',
        '-p',
        f'record:={log}',
        '-p',
        'real_time_factor:=10.0',
        '-p',
        'report_integrator:=event',
    ) as process:
        observer = Observer(ros).wait_for_match()
        ros.spin_until(reader.matched, 'the reader')
        for fields in ({'shot': 1}, {'velocity': [-3.3, 0.7]}, {'shot': 4}):
            observer.wait_for_phase(observer.ask(**fields), 'done')
        wanted = sum(len(frame.collisions) > 0 for frame in replay_frames(*read_log(log)))
        ros.spin_until(lambda: len(reader.heard['collisions']) == wanted, 'all contacts')
        process.interrupt()
        assert process.wait() == 0
    recorded = reader.heard

    again = RawReader(ros, 'replayed')
    with Process(
        'cli.replay', str(log), '--speed', '20', '--wait', '--ros-args', '-r', '__node:=replayed'
    ) as process:
        process._forget()  # it may end before all that it has sent is heard
        ros.spin_until(
            lambda: (
                again.heard['ball_poses'][-1:] == recorded['ball_poses'][-1:]
                and len(again.heard['collisions']) == wanted
            ),
            'the last frame and all contacts',
        )
        assert process.wait() == 0
    with Process('cli.replay', str(log), '--digest') as process:
        assert process.wait() == 0
    contacts = recorded['collisions']
    assert hashlib.sha256(b''.join(contacts)).hexdigest() + '  collisions' in process.stdout
    assert again.heard['collisions'] == contacts != []
    # A slow machine may lose frames on the way to a reader: compare those that were heard twice.
    first, second = by_stamp(recorded['ball_poses']), by_stamp(again.heard['ball_poses'])
    both = first.keys() & second.keys()
    assert all(first[stamp] == second[stamp] for stamp in both)
    assert len(both) > 150  # of the 250 or so in which balls roll


def by_stamp(frames):
    """Return serialized poses by the bytes of their stamp, which follow a head of four."""
    return {frame[4:12]: frame for frame in frames}


def test_replay_prints_digests_and_refuses_in_one_line(domain, tmp_path):
    log = tmp_path / 'none.log'
    with Process('cli.replay', str(log)) as process:
        assert process.wait() == 1
        assert process.stderr == f'replay: {log} cannot be read: No such file or directory\n'
    with Process('cli.replay', '--help') as process:
        assert process.wait() == 0 and '--speed' in process.stdout


def test_a_speed_that_is_none_is_told_in_the_words_of_the_user(domain):
    for word in ('-1', 'nan', 'inf', '1e-311', 'fast'):
        with Process('cli.replay', 'session.log', '--speed', word) as process:
            assert process.wait() == 2
            assert f"argument --speed: '{word}' is " in process.stderr.splitlines()[-1]


def test_a_tilde_is_the_home_of_the_user(domain, tmp_path, monkeypatch):
    monkeypatch.setenv('HOME', str(tmp_path))
    with Process('cli.replay', '~/none.log') as process:
        assert process.wait() == 1
        assert f'{tmp_path}/none.log' in process.stderr
