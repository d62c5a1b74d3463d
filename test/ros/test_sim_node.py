"""The node in this process: what the topics, services and parameters do."""

import json
import threading
import uuid

import numpy as np
import pytest
from geometry_msgs.msg import Pose, PoseArray, Twist, Vector3
from rclpy.exceptions import InvalidNamespaceException, InvalidNodeNameException
from rclpy.parameter import Parameter
from ros_harness import Observer, Ros
from std_msgs.msg import String
from survival import Attacker, is_served
from waiting import PATIENCE

from pool_sim_ros.physics import report_table, simulate
from pool_sim_ros.ros import interface, messages
from pool_sim_ros.ros.sim_node import SimNode
from pool_sim_ros.simulator import ParameterError
from pool_sim_ros.simulator.job import Job
from pool_sim_ros.simulator.table_json import table_from_json

FAST = {'report_integrator': 'event', 'real_time_factor': 4.0}


def twist(x=0.0, y=0.0, z=0.0, angular_z=0.0):
    return Twist(linear=Vector3(x=x, y=y, z=z), angular=Vector3(z=angular_z))


def test_a_strike_through_either_door_is_played_to_the_end_that_the_physics_gives(ros):
    ros.sim_node(**FAST)
    observer = Observer(ros).wait_for_match()
    table = report_table()
    observer.strike(twist(-3.0, 0.4))
    accepted, done = observer.wait_for_responses(2)
    assert (accepted['phase'], done['phase']) == ('accepted', 'done')
    assert accepted['id'] == done['id']
    shot = simulate(table, (-3.0, 0.4))
    assert np.array_equal(list(done['final_positions'].values()), shot.final_positions)
    assert (done['integrator'], done['events']) == ('event', len(shot.events))

    second = observer.ask(velocity=[1.0, 1.0])
    done = observer.wait_for_phase(second, 'done')
    shot = simulate(table, (1.0, 1.0), positions=shot.final_positions)
    assert np.array_equal(list(done['final_positions'].values()), shot.final_positions)
    assert np.array_equal(observer.wait_for_frame_at(done['t_end']), shot.final_positions)


@pytest.mark.parametrize(
    ('message', 'code'),
    [
        (twist(float('nan')), 'BAD_VELOCITY'),
        (twist(0.0, float('inf')), 'BAD_VELOCITY'),
        (twist(), 'BAD_VELOCITY'),
        (twist(1.0, z=0.1), 'BAD_VELOCITY'),
        (twist(1.0, z=float('nan')), 'BAD_VELOCITY'),
        (twist(1.0, angular_z=0.1), 'BAD_VELOCITY'),
        (twist(15.1), 'TOO_FAST'),
        ('0', 'UNKNOWN_SHOT'),
        ('5', 'UNKNOWN_SHOT'),
        ('x', 'BAD_REQUEST'),
        ('', 'BAD_REQUEST'),
        ('{"shot": ', 'BAD_REQUEST'),
        ('{"id": "a", "shot": 1, "spin": 2}', 'BAD_REQUEST'),
        ('x' * 1_000_000, 'BAD_REQUEST'),
        ('{"velocity": [NaN, 0]}', 'BAD_VELOCITY'),
        ('{"velocity": [0, -Infinity]}', 'BAD_VELOCITY'),
        ('{"velocity": [0, 0]}', 'BAD_VELOCITY'),
        ('{"velocity": [100, 0]}', 'TOO_FAST'),
    ],
    ids=lambda value: repr(value)[:30] if isinstance(value, str) else None,
)
def test_bad_input_is_answered_with_a_reason_and_changes_nothing(ros, message, code):
    ros.sim_node(**FAST)
    observer = Observer(ros).wait_for_match()
    if isinstance(message, str):
        observer.request(message)
    else:
        observer.strike(message)
    [response] = observer.wait_for_responses(1)
    assert (response['phase'], response['code']) == ('rejected', code)
    assert response['reason'] and '\n' not in response['reason']
    seen = len(observer.heard['ball_poses'])
    ros.spin_until(lambda: len(observer.heard['ball_poses']) > seen + 3, 'further frames')
    assert not observer.state['moving'] and not observer.state['computing']
    positions = messages.from_poses(observer.heard['ball_poses'][-1])
    assert np.array_equal(positions, report_table().positions)
    assert len(observer.responses) == 1


def test_a_strike_while_balls_move_is_busy_and_does_not_disturb_the_shot(ros):
    node = ros.sim_node(report_integrator='event', real_time_factor=0.05)
    observer = Observer(ros).wait_for_match()
    first = observer.ask(shot=3)
    ros.spin_until(lambda: observer.state['moving'], 'motion')
    observer.strike(twist(1.0))
    second = observer.ask(shot=1)
    assert observer.wait_for_phase(second, 'rejected')['code'] == 'BUSY'
    node.set_parameters([Parameter('real_time_factor', value=10.0)])
    done = observer.wait_for_phase(first, 'done')
    shot = simulate(report_table(), done['velocity'])
    assert np.array_equal(list(done['final_positions'].values()), shot.final_positions)
    assert [r['code'] for r in observer.responses] == ['OK', 'BUSY', 'BUSY', 'OK']


def test_a_repeated_request_is_answered_again_and_not_played_again(ros):
    ros.sim_node(**FAST)
    observer = Observer(ros).wait_for_match()
    request = json.dumps({'id': 'once', 'shot': 2})
    observer.request(request)
    done = observer.wait_for_phase('once', 'done')
    observer.wait_for_frame_at(done['t_end'])
    seq = len(observer.collisions)
    observer.request(request)
    assert observer.wait_for_responses(3)[-1] == done
    observer.request(json.dumps({'id': 'once', 'shot': 3}))
    assert observer.wait_for_responses(4)[-1]['code'] == 'ID_REUSED'
    assert len(observer.collisions) == seq and not observer.state['moving']


def test_a_reset_preempts_and_time_and_seq_go_on(ros):
    ros.sim_node(report_integrator='event', real_time_factor=1.0)
    observer = Observer(ros).wait_for_match()
    first = observer.ask(shot=1)
    ros.spin_until(lambda: len(observer.collisions) > 0, 'a collision')
    answer = observer.call(interface.RESET)
    assert answer.success and 'preempted' in answer.message
    assert observer.wait_for_phase(first, 'preempted')['code'] == 'RESET'
    assert observer.phases(first) == ['accepted', 'preempted']
    ros.spin_until(
        lambda: np.array_equal(
            messages.from_poses(observer.heard['ball_poses'][-1]), report_table().positions
        ),
        'the start layout',
    )

    second = observer.ask(shot=3)
    observer.wait_for_phase(second, 'done')
    ticks = [round(stamp * 60 / 1e9) for stamp in observer.stamps]
    assert ticks == list(range(ticks[0], ticks[0] + len(ticks)))
    assert observer.collisions[:, 0].tolist() == list(range(len(observer.collisions)))
    answer = observer.call(interface.RESET)
    assert answer.success and 'preempted' not in answer.message


def test_each_of_a_burst_is_answered_exactly_once(ros):
    ros.sim_node(**FAST)
    observer = Observer(ros).wait_for_match()
    ids = [uuid.uuid4().hex for _ in range(1000)]
    for number, request_id in enumerate(ids):
        kind = ({'shot': 2}, {'velocity': [-1.0, 0.1]}, {'shot': 9})[number % 3]
        observer.request(json.dumps({'id': request_id, **kind}))

    observer.wait_for_settled(1000)
    responses = observer.responses
    decisions = [r for r in responses if r['phase'] in ('accepted', 'rejected')]
    assert sorted(r['id'] for r in decisions) == sorted(ids)
    accepted = sorted(r['id'] for r in responses if r['phase'] == 'accepted')
    assert accepted and accepted == sorted(r['id'] for r in responses if r['phase'] == 'done')


def test_a_late_client_finds_the_state_the_table_and_the_past_responses(ros):
    ros.sim_node(**FAST)
    observer = Observer(ros).wait_for_match()
    shot = observer.ask(shot=3)
    observer.wait_for_phase(shot, 'done')
    late = Observer(ros)
    ros.spin_until(
        lambda: late.phases(shot) == ['accepted', 'done'] and late.heard['table'], 'what is latched'
    )
    assert table_from_json(late.heard['table'][0].data) == report_table()
    ros.spin_until(lambda: late.heard['state'], 'the state')
    assert set(late.state) == {
        'pocketed',
        'paused',
        'moving',
        'computing',
        'tick',
        'sim_time',
        'real_time_factor',
    }


def test_the_state_comes_unasked_for(ros):
    ros.sim_node()
    observer = Observer(ros).wait_for_match()
    ros.spin_until(lambda: len(observer.heard['state']) >= 3, 'three states')
    ticks = [json.loads(m.data)['tick'] for m in observer.heard['state']]
    assert ticks == sorted(set(ticks))


def test_the_clock_says_the_time_of_the_frames_only_if_asked_to(ros):
    ros.sim_node('quiet')
    ros.sim_node('loud', publish_clock=True, publish_rate=100)
    observer = Observer(ros, 'loud').wait_for_match(clock=True)
    ros.spin_until(lambda: len(observer.heard['/clock']) > 20, 'the clock')
    clocks = {messages.from_time(m.clock) for m in observer.heard['/clock']}
    assert all(stamp % 10_000_000 == 0 for stamp in clocks)
    assert observer.node.count_publishers('/clock') == 1


def test_pause_step_and_resume(ros):
    node = ros.sim_node(**FAST, start_paused=True, step_ticks=5)
    assert node.runner.ready.wait(PATIENCE)
    observer = Observer(ros).wait_for_match()
    shot = observer.ask(shot=1)
    observer.wait_for_phase(shot, 'accepted')
    answer = observer.call(interface.STEP)
    assert answer.success
    ros.spin_until(lambda: len(observer.stamps) == 5, 'five frames')
    assert observer.stamps == [k * 10**9 // 60 for k in range(5)]
    assert observer.call(interface.SET_PAUSED, data=False).success
    assert observer.wait_for_phase(shot, 'done')['t_start'] == 0.0
    answer = observer.call(interface.STEP)
    assert not answer.success and 'paused' in answer.message


def test_steps_that_wait_for_a_shot_keep_nobody_waiting(ros, monkeypatch):
    go_on = threading.Event()
    run = Job.run

    def wait_and_run(job):
        assert go_on.wait(PATIENCE)
        return run(job)

    monkeypatch.setattr(Job, 'run', wait_and_run)
    node = ros.sim_node(**FAST, start_paused=True)
    observer = Observer(ros).wait_for_match()
    shot = observer.ask(shot=1)
    observer.wait_for_phase(shot, 'accepted')
    client = observer.node.create_client(interface.STEP.type, interface.STEP.of('pool_sim'))
    ros.spin_until(client.service_is_ready, 'the service')
    steps = [client.call_async(interface.STEP.type.Request()) for _ in range(3)]
    is_served(observer)
    assert observer.call(interface.SET_PAUSED, data=True).success
    [result] = node.set_parameters([Parameter('step_ticks', value=2)])
    assert result.successful and not any(step.done() for step in steps)
    go_on.set()
    ros.spin_until(lambda: all(step.done() for step in steps), 'the steps')
    assert [step.result().message for step in steps] == [f'at tick {tick}' for tick in (1, 3, 5)]


def test_two_tables_do_not_hear_each_other(ros):
    ros.sim_node('left', **FAST)
    ros.sim_node('right', **FAST)
    left, right = (Observer(ros, name).wait_for_match() for name in ('left', 'right'))
    shot = left.ask(shot=3)
    left.wait_for_phase(shot, 'done')
    other = right.ask(shot=2)
    right.wait_for_phase(other, 'done')
    assert {r['id'] for r in left.responses} == {shot}
    assert {r['id'] for r in right.responses} == {other}


def test_a_parameter_that_may_change_counts_from_the_next_strike(ros):
    node = ros.sim_node(**FAST)
    observer = Observer(ros).wait_for_match()
    [result] = node.set_parameters([Parameter('table.e_cue_ball', value=0.95)])
    assert result.successful
    [result] = node.set_parameters([Parameter('max_cue_speed', value=5)])
    assert result.successful and node.get_parameter('max_cue_speed').value == 5.0
    first = observer.ask(velocity=[-4.0, 0.0])
    done = observer.wait_for_phase(first, 'done')
    table = table_from_json(observer.heard['table'][-1].data)
    assert table.e_cue_ball == 0.95
    shot = simulate(table, (-4.0, 0.0))
    assert np.array_equal(list(done['final_positions'].values()), shot.final_positions)
    second = observer.ask(velocity=[6.0, 0.0])
    assert observer.wait_for_phase(second, 'rejected')['code'] == 'TOO_FAST'


def test_parameters_that_make_no_table_leave_no_node_behind(ros):
    with pytest.raises(ParameterError, match='overlap'):
        ros.sim_node(
            balls_labels=['C', '1'],
            balls_masses=[1.0, 1.0],
            balls_radii=[0.1, 0.1],
            balls_positions=[0.5, 0.5, 0.6, 0.5],
            balls_colors=[1.0] * 6,
        )
    assert ros.node().count_publishers('/pool_sim/state') == 0


def test_a_table_of_another_size_with_other_balls(ros):
    ros.sim_node(
        **FAST,
        table_length=1.0,
        balls_labels=['C', 'red'],
        balls_masses=[1.0, 2.0],
        balls_radii=[0.1, 0.05],
        balls_positions=[0.2, 0.5, 0.6, 0.5],
        balls_colors=[1.0] * 6,
    )
    observer = Observer(ros).wait_for_match()
    shot = observer.ask(shot=4)
    done = observer.wait_for_phase(shot, 'done')
    assert list(done['final_positions']) == ['C', 'red']
    assert done['as_printed'] is False and done['velocity'] == pytest.approx([1.5, 0.0])
    pose_array = observer.heard['ball_poses'][-1]
    assert [pose.position.z for pose in pose_array.poses] == [0.1, 0.05]


def two_balls(**changes):
    return [
        Parameter('balls.labels', value=['C', 'red']),
        Parameter('balls.masses', value=[0.2, 0.2]),
        Parameter('balls.radii', value=[0.05, 0.05]),
        Parameter('balls.positions', value=[0.2, 0.5, 0.6, 0.5]),
        Parameter('balls.colors', value=[1.0] * 6),
        *(Parameter(name, value=value) for name, value in changes.items()),
    ]


def test_two_nodes_in_one_process_live_in_two_namespaces(ros):
    left = ros.add(SimNode(context=ros.context, namespace='left', parameter_overrides=two_balls()))
    right = ros.add(SimNode('table', context=ros.context, namespace='/halls/right'))
    assert left.get_fully_qualified_name() == '/left/pool_sim'
    assert right.get_fully_qualified_name() == '/halls/right/table'
    one = Observer(ros, '/left/pool_sim').wait_for_match()
    other = Observer(ros, '/halls/right/table').wait_for_match()
    [result] = right.set_parameters([Parameter('real_time_factor', value=20.0)])
    assert result.successful
    first = one.ask(velocity=[3.0, 0.0])
    second = other.ask(velocity=[-3.0, 0.4])
    ends = [o.wait_for_phase(a, 'done') for o, a in ((one, first), (other, second))]
    assert [len(end['final_positions']) for end in ends] == [2, 11]
    shot = simulate(report_table(), (-3.0, 0.4))
    assert np.array_equal(list(ends[1]['final_positions'].values()), shot.final_positions)
    assert {r['id'] for r in one.responses} == {first}
    assert {r['id'] for r in other.responses} == {second}
    assert one.call(interface.RESET).success and other.call(interface.RESET).success
    assert left.get_parameter('real_time_factor').value == 1.0


def test_a_node_heeds_the_arguments_of_the_process_unless_told_not_to(domain):
    with Ros(domain, args=['--ros-args', '-r', '__ns:=/all', '-p', 'step_ticks:=7']) as ros:
        heeds = ros.add(SimNode(context=ros.context))
        alone = ros.add(
            SimNode(
                context=ros.context,
                namespace='own',
                use_global_arguments=False,
                cli_args=['--ros-args', '-p', 'step_ticks:=3', '-r', '__node:=renamed'],
            )
        )
        assert heeds.get_fully_qualified_name() == '/all/pool_sim'
        assert heeds.get_parameter('step_ticks').value == 7
        assert alone.get_fully_qualified_name() == '/own/renamed'
        assert alone.get_parameter('step_ticks').value == 3


def test_parameters_of_others_are_declared_only_where_that_is_asked_for(ros):
    lamp = [Parameter('lamp', value=3)]
    options = dict(context=ros.context, parameter_overrides=lamp)
    plain = ros.add(SimNode('plain', **options))
    assert not plain.has_parameter('lamp')
    declared = ros.add(
        SimNode('declared', automatically_declare_parameters_from_overrides=True, **options)
    )
    assert declared.get_parameter('lamp').value == 3
    assert declared.describe_parameter('step_ticks').integer_range
    free = ros.add(SimNode('free', allow_undeclared_parameters=True, **options))
    [result] = free.set_parameters([Parameter('lamp', value=4)])
    assert result.successful and free.get_parameter('lamp').value == 4


def test_a_node_without_parameter_services_has_none(ros):
    node = ros.add(SimNode(context=ros.context, start_parameter_services=False))
    assert not [s.srv_name for s in node.services if 'set_parameters' in s.srv_name]
    logged = ros.add(SimNode('logged', context=ros.context, enable_logger_service=True))
    assert [s.srv_name for s in logged.services if 'logger' in s.srv_name]


@pytest.mark.parametrize(
    ('options', 'error', 'words'),
    [
        ({'namespace': 'a b'}, InvalidNamespaceException, 'namespace'),
        ({'namespace': '/a/'}, InvalidNamespaceException, 'namespace'),
        ({'namespace': 1}, TypeError, 'namespace must be a string'),
        ({'node_name': 'a-b'}, InvalidNodeNameException, 'node name'),
        ({'node_name': ''}, InvalidNodeNameException, 'node name'),
        ({'cli_args': '--ros-args'}, TypeError, 'cli_args must be a list'),
        ({'cli_args': ['--ros-args', '-p', 'x']}, RuntimeError, "'-p x'"),
        ({'use_global_arguments': 'no'}, TypeError, 'use_global_arguments must be true or false'),
        ({'parameter_overrides': [('a', 1)]}, TypeError, 'parameter_overrides must be a list'),
        ({'parameter_overrides': two_balls(time_slice=5e-8)}, ParameterError, 'time_slice'),
        ({'colour': 'green'}, TypeError, 'colour'),
    ],
)
def test_a_bad_option_is_told_and_leaves_no_node_behind(ros, options, error, words):
    with pytest.raises(error, match=words):
        SimNode(**{'context': ros.context, **options})
    assert ros.node().count_publishers('/pool_sim/state') == 0


def test_a_command_that_is_too_long_or_none_is_refused_in_a_line(ros, capfd):
    ros.sim_node(**FAST)
    observer = Observer(ros).wait_for_match()
    attacker = Attacker(ros)
    attacker.send('shot/request', String(data='x' * 100_000))
    attacker.send_raw('cue_velocity', b'\0\1\0\0' + bytes(3))
    answers = observer.wait_for_responses(2)
    assert {(r['code'], r['phase']) for r in answers} == {('BAD_REQUEST', 'rejected')}
    assert all('bytes' in r['reason'] for r in answers)
    is_served(observer)
    logged = []

    def told():
        attacker.send('set_ball_poses', PoseArray(poses=[Pose()] * 2000))
        logged.append(capfd.readouterr().err)
        return 'set_ball_poses was rejected: 2000 positions' in ''.join(logged)

    ros.spin_until(told, 'the line')
