"""The node on a table whose balls spin: in this process, and as users run it."""

import hashlib
import json

import numpy as np
import pytest
from geometry_msgs.msg import Twist, Vector3
from parameter_files import CONFIG
from process_harness import node_process
from rclpy.parameter import Parameter
from ros_harness import Observer

from pool_sim_ros.physics import POOL_TABLES, pool_table
from pool_sim_ros.ros import SimNode, digests, interface, messages
from pool_sim_ros.ros.cdr import PosesWriter, RowsWriter
from pool_sim_ros.simulator import (
    COLLISION_COLUMNS,
    SPIN_COLUMNS,
    Change,
    parameters_of,
    read_log,
    replay_frames,
    table_from_json,
)

BREAK = {'speed': 9.0, 'azimuth': 180.3, 'side': 0.1, 'above': 0.2}


def quaternions(message):
    turned = [pose.orientation for pose in message.poses]
    return np.array([[q.x, q.y, q.z, q.w] for q in turned])


def heights(message):
    return np.array([pose.position.z for pose in message.poses])


@pytest.fixture
def observer(ros):
    ros.sim_node(table_preset='7ft', real_time_factor=0.0)
    return Observer(ros).wait_for_match()


def test_the_parameters_of_the_table_are_there_with_descriptions(ros):
    node = ros.sim_node(table_preset='7ft')
    names = parameters_of('ball')
    assert {n for n in node._parameters if n.startswith(('table.', 'balls.'))} == {
        n for n in names if n.startswith(('table.', 'balls.'))
    }
    for name, spec in names.items():
        descriptor = node.describe_parameter(name)
        assert spec.doc in descriptor.description
        assert descriptor.read_only == (spec.change is Change.NEVER)
    table = pool_table('7ft')
    assert node.get_parameter('table.mu_slide').value == table.mu_slide
    assert node.get_parameter('table.pockets').value == table.pockets.ravel().tolist()
    [result] = node.set_parameters([Parameter('table.mu_slide', value=0.3)])
    assert result.successful
    for name, value in (
        ('table.cushion_model', 'rubber'),
        ('table.preset', '9ft'),
        ('table.ball_friction', 'report'),
        ('integrator', 'time_slice'),
    ):
        [result] = node.set_parameters([Parameter(name, value=value)])
        assert not result.successful and result.reason, name
    assert not node.has_parameter('table.mu_ball_surface')


@pytest.mark.parametrize('name', POOL_TABLES)
def test_the_file_of_a_table_starts_it(ros, name):
    file = CONFIG / f'{name}.yaml'
    arguments = ['--ros-args', '--params-file', str(file)]
    node = ros.add(SimNode(context=ros.context, cli_args=arguments))
    assert node.runner._simulation.settings.table == pool_table(name)


def test_a_table_without_pockets_has_an_empty_list_of_them(ros):
    node = ros.sim_node(table_preset='carom')
    assert node.has_parameter('table.pockets')
    [result] = node.set_parameters([Parameter('table.mu_roll', value=0.02)])
    assert result.successful
    assert node.runner._simulation.settings.table.mu_roll == 0.02


def test_it_shows_the_table_and_strikes_with_a_spin(ros, observer):
    table = pool_table('7ft')
    assert table_from_json(observer.heard['table'][-1].data) == table
    assert observer.state['pocketed'] == []
    observer.strike(Twist(linear=Vector3(x=-1.0), angular=Vector3(x=0.0, y=20.0, z=30.0)))
    ros.spin_until(lambda: observer.responses, 'an answer')
    accepted = observer.responses[0]
    assert (accepted['phase'], accepted['spin']) == ('accepted', [0.0, 20.0, 30.0])
    done = observer.wait_for_phase(accepted['id'], 'done')
    observer.wait_for_frame_at(done['t_end'])
    moving = [messages.from_rows(m) for m in observer.heard['ball_velocities']]
    assert {rows.shape for rows in moving} == {(16, 5)}
    layout = observer.heard['ball_velocities'][0].layout.dim
    assert [d.label for d in layout] == ['ball', ','.join(SPIN_COLUMNS)]
    assert max(rows[0, 4] for rows in moving) == 30.0
    last = observer.heard['ball_poses'][-1]
    assert abs(quaternions(last)[0, 3]) < 1.0
    np.testing.assert_array_equal(heights(last), table.radii)


BAD = [
    ({'velocity': [1.0, 0.0], 'spin': [0.0, 0.0]}, 'BAD_REQUEST'),
    ({'spin': [0.0, 0.0, 1.0]}, 'BAD_REQUEST'),
    ({'shot': 1, 'spin': [0.0, 0.0, 1.0]}, 'BAD_REQUEST'),
    ({'velocity': [1.0, 0.0], 'spin': [0.0, 0.0, float('nan')]}, 'BAD_VELOCITY'),
    ({'velocity': [0.0, 0.0], 'spin': [0.0, 0.0, 0.0]}, 'BAD_VELOCITY'),
    ({'cue': {'speed': 1.0}}, 'BAD_REQUEST'),
    ({'cue': {'speed': 1.0, 'azimuth': 0.0, 'top': 1.0}}, 'BAD_REQUEST'),
    ({'cue': {'speed': float('inf'), 'azimuth': 0.0}}, 'BAD_VELOCITY'),
    ({'cue': {'speed': 1.0, 'azimuth': 0.0, 'above': 0.51}}, 'BAD_VELOCITY'),
    ({'cue': {'speed': 1.0, 'azimuth': 0.0}, 'velocity': [1.0, 0.0]}, 'BAD_REQUEST'),
    ({'cue': {'speed': 99.0, 'azimuth': 0.0}}, 'TOO_FAST'),
    ({'place': {'9': [0.0, 0.0]}}, 'BAD_LAYOUT'),
    ({'place': {'9': [1.4859, 0.4953]}}, 'BAD_LAYOUT'),
    ({'place': {'9': [0.01, 0.3]}}, 'BAD_LAYOUT'),
    ({'place': {'x': [0.5, 0.3]}}, 'BAD_LAYOUT'),
    ({'place': {'9': [0.5, 0.3, 0.0]}}, 'BAD_REQUEST'),
    ({'place': {'9': [0.5, 0.3]}, 'now': True}, 'BAD_REQUEST'),
    ({'place': [0.5, 0.3]}, 'BAD_REQUEST'),
]


def test_every_bad_request_gets_one_answer_and_changes_nothing(ros, observer):
    asked = [observer.ask(**fields) for fields, _ in BAD]
    observer.wait_for_responses(len(BAD))
    good = observer.ask(place={'9': [0.9, 0.3]})
    assert observer.wait_for_phase(good, 'done')['final_positions']['9'] == [0.9, 0.3]
    for request_id, (fields, code) in zip(asked, BAD, strict=True):
        [answer] = [r for r in observer.responses if r['id'] == request_id]
        assert (answer['phase'], answer['code']) == ('rejected', code), fields
        assert answer['reason'] and '\n' not in answer['reason']
    assert observer.phases(good) == ['accepted', 'done']


@pytest.mark.parametrize(
    'fields',
    [{'velocity': [1.0, 0.0], 'spin': [0.0, 0.0, 0.0]}, {'cue': {'speed': 1.0, 'azimuth': 0.0}}],
)
def test_discs_take_no_spin_and_no_cue_but_are_placed(ros, fields):
    ros.sim_node()
    observer = Observer(ros).wait_for_match()
    answer = observer.wait_for_phase(observer.ask(**fields), 'rejected')
    assert answer['code'] == 'BAD_VELOCITY' and 'disc' in answer['reason']
    done = observer.wait_for_phase(observer.ask(place={'9': [1.0, 0.3]}), 'done')
    assert done['final_positions']['9'] == [1.0, 0.3] and done['pocketed'] is None
    assert observer.state['pocketed'] == []


class RawReader:
    """Keeps the bytes of what frames show, by topic."""

    TOPICS = (interface.BALL_POSES, interface.BALL_VELOCITIES, interface.COLLISIONS)

    def __init__(self, ros):
        node = ros.node('raw')
        self.heard = {topic.name: [] for topic in self.TOPICS}
        self.subscriptions = [
            node.create_subscription(
                topic.type, topic.of('pool_sim'), self.heard[topic.name].append, 20000, raw=True
            )
            for topic in self.TOPICS
        ]


@pytest.fixture(scope='module')
def session(domain, tmp_path_factory):
    """A session on a node in a process of its own: what was heard, and the log."""
    from ros_harness import Ros

    log = tmp_path_factory.mktemp('session') / 'session.log'
    given = {'table.preset': '7ft', 'record': str(log), 'real_time_factor': 20.0}
    with Ros(domain) as ros, node_process(**given) as process:
        observer, raw = Observer(ros).wait_for_match(), RawReader(ros)
        ros.spin_until(
            lambda: all(s.get_publisher_count() for s in raw.subscriptions), 'the raw reader'
        )
        asked = []
        for fields in (
            {'cue': BREAK},
            {'velocity': [1.0, 0.0]},
            {'place': {'C': [1.4, 0.5]}},
            {'velocity': [-2.0, 0.3], 'spin': [10.0, -20.0, 30.0]},
            {'cue': {'speed': 3.0, 'azimuth': 77.0, 'above': -0.4}},
        ):
            asked.append(observer.ask(**fields))
            last = len(asked)
            observer.wait_for_settled(last)
        end = observer.responses[-1]['t_end']
        observer.wait_for_frame_at(end)
        process.interrupt()
        assert process.wait() == 0
    return observer, raw.heard, asked, log


def test_each_request_is_answered_once(session):
    observer, _, asked, _ = session
    phases = [observer.phases(request_id) for request_id in asked]
    over = ['accepted', 'done']
    assert phases == [over, ['rejected'], over, over, over]
    assert [r['code'] for r in observer.responses if r['id'] == asked[1]] == ['CUE_POCKETED']


def test_the_session_is_replayed_bit_for_bit(session):
    _, heard, _, log = session
    settings, commands = read_log(log)
    frames = list(replay_frames(settings, commands))
    poses = PosesWriter(settings.frame_id, settings.table.radii.tolist())
    shown = {
        poses.write([f.stamp], f.positions[None], f.orientations[None], [f.pocketed])[0]
        for f in frames
    }
    assert len(heard['ball_poses']) > 300 and set(heard['ball_poses']) <= shown
    rows = RowsWriter('ball', SPIN_COLUMNS)
    shown = {rows.write(frame.velocities[None])[0] for frame in frames}
    assert set(heard['ball_velocities']) <= shown
    rows = RowsWriter('collision', COLLISION_COLUMNS)
    shown = [rows.write(f.collisions[None])[0] for f in frames if len(f.collisions)]
    assert heard['collisions'] == shown


def test_the_balls_turn_without_jumps_and_stay_turned(session):
    observer, _, asked, _ = session
    turned = np.array([quaternions(message) for message in observer.heard['ball_poses']])
    np.testing.assert_allclose(np.linalg.norm(turned, axis=2), 1.0, rtol=0, atol=1e-12)
    placed = next(r for r in observer.responses if r['id'] == asked[2] and r['phase'] == 'done')
    stamps = np.array(observer.stamps) / 1e9
    dots = np.sum(turned[1:] * turned[:-1], axis=2)
    jumps = np.argwhere(dots < 0.0)
    assert all(ball == 0 and stamps[k + 1] >= placed['t_start'] - 1e-6 for k, ball in jumps)
    resting = np.flatnonzero(stamps >= placed['t_start'] - 1e-6)[0]
    np.testing.assert_array_equal(turned[resting, 0], [0, 0, 0, 1])
    np.testing.assert_allclose(turned[resting, 1:], turned[resting - 1, 1:], atol=1e-15)


def test_pocketed_balls_come_in_order_and_lie_below_the_cloth(session):
    observer, _, _, _ = session
    table = pool_table('7ft')
    states = [json.loads(message.data)['pocketed'] for message in observer.heard['state']]
    rows = observer.collisions
    fell = [table.labels[int(a)] for a in rows[rows[:, 2] == 3, 3]]
    longest = max(states, key=len)
    assert 'C' in fell and [label for label in fell if label in longest] == longest
    assert states.index([]) == 0 and states[-1] == [b for b in longest if b in states[-1]]
    for message in observer.heard['ball_poses'][::20]:
        places, z = messages.from_poses(message), heights(message)
        for ball in np.flatnonzero(z < 0.0):
            assert z[ball] == -table.radii[ball]
            assert any(np.array_equal(places[ball], pocket[:2]) for pocket in table.pockets)


def test_the_digests_of_a_session_are_those_of_its_messages(session):
    _, heard, _, log = session
    settings, commands = read_log(log)
    found = digests(settings, replay_frames(settings, commands))
    right = hashlib.sha256(b''.join(heard['collisions'])).hexdigest()
    assert found['collisions'] == right
    rows, sums = RowsWriter('ball', SPIN_COLUMNS), hashlib.sha256()
    for frame in replay_frames(settings, commands):
        sums.update(rows.write(frame.velocities[None])[0])
    assert found['ball_velocities'] == sums.hexdigest()
