"""Driving the node: placing balls, diagnostics, several tables, record and replay over topics."""

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import Point, Pose, PoseArray
from parameter_files import CONFIG, from_file
from process_harness import node_process, start_node
from rclpy.parameter import Parameter
from ros_harness import Observer

from pool_sim_ros.physics import report_table, simulate
from pool_sim_ros.ros import interface, messages
from pool_sim_ros.simulator import build_settings, values_from
from pool_sim_ros.simulator.table_json import table_from_json

FAST = {'report_integrator': 'event', 'real_time_factor': 4.0}
START = report_table().positions


def poses(positions):
    return PoseArray(poses=[Pose(position=Point(x=float(x), y=float(y))) for x, y in positions])


class Placer:
    """Sends `set_ball_poses`, and hears `/diagnostics`."""

    def __init__(self, ros, observer, simulator=interface.NODE_NAME):
        self._ros, self._observer = ros, observer
        self.statuses = []
        topic, diagnostics = interface.SET_BALL_POSES, interface.DIAGNOSTICS
        node = observer.node
        self._publisher = node.create_publisher(topic.type, topic.of(simulator), topic.qos)
        node.create_subscription(
            diagnostics.type, diagnostics.name,
            lambda m: self.statuses.extend(s for s in m.status if simulator in s.name), 10,
        )  # fmt: skip
        ros.spin_until(
            lambda: self._publisher.get_subscription_count() and self.statuses, 'the match'
        )

    def place(self, positions, frame_id=''):
        message = poses(positions)
        message.header.frame_id = frame_id
        self._publisher.publish(message)

    @property
    def values(self):
        return {item.key: item.value for item in self.statuses[-1].values}

    def wait_for(self, condition, what):
        self._ros.spin_until(lambda: condition(self.values), what)
        return self.values


def last_positions(observer):
    return messages.from_poses(observer.heard['ball_poses'][-1])


def test_balls_are_placed_and_the_next_strike_starts_there(ros):
    ros.sim_node(**FAST)
    observer = Observer(ros).wait_for_match()
    placer = Placer(ros, observer)
    there = START * [1.0, 0.98]
    placer.place(there)
    ros.spin_until(lambda: np.array_equal(last_positions(observer), there), 'the balls there')
    done = observer.wait_for_phase(observer.ask(velocity=[-2.0, 0.1]), 'done')
    shot = simulate(report_table(), (-2.0, 0.1), positions=there)
    assert np.array_equal(list(done['final_positions'].values()), shot.final_positions)
    done = observer.wait_for_phase(observer.ask(shot=1), 'done')
    shot = simulate(report_table(), done['velocity'])
    assert np.array_equal(list(done['final_positions'].values()), shot.final_positions)


def with_ball(index, place):
    places = START.copy()
    places[index] = place
    return places


@pytest.mark.parametrize(
    ('places', 'words'),
    [
        (with_ball(3, START[2] + 0.01), ["'2'", "'3'", 'overlap']),
        (with_ball(5, (9.0, 0.5)), ["'5'", 'outside']),
        (with_ball(10, (np.nan, 0.5)), ["'10'", 'finite']),
        (with_ball(0, (0.5, -np.inf)), ["'C'", 'finite']),
        (START[:10], ['10 positions', '11 balls']),
        (np.empty((0, 2)), ['0 positions', '11 balls']),
        (np.tile(START, (2000, 1)), ['22000 positions', '11 balls']),
    ],
    ids=['overlap', 'outside', 'nan', 'infinite', 'too few', 'none', 'too many'],
)
def test_what_is_no_layout_is_rejected_naming_the_ball(ros, places, words):
    ros.sim_node()
    observer = Observer(ros).wait_for_match()
    placer = Placer(ros, observer)
    placer.place(places)
    values = placer.wait_for(lambda v: v['rejected commands'] == '1', 'the rejection')
    for word in ['set_ball_poses', *words]:
        assert word in values['last rejection']
    assert np.array_equal(last_positions(observer), START)


def test_a_layout_in_another_frame_is_rejected_with_a_line_and_one_in_ours_is_not(ros, capfd):
    ros.sim_node(frame_id='cloth')
    observer = Observer(ros).wait_for_match()
    placer = Placer(ros, observer)
    there = START * [1.0, 0.98]
    placer.place(there, 'table')
    values = placer.wait_for(lambda v: v['rejected commands'] == '1', 'the rejection')
    assert "the frame is 'table'; it must be 'cloth', or empty" in values['last rejection']
    lines = [line for line in capfd.readouterr().err.splitlines() if 'set_ball_poses' in line]
    assert len(lines) == 1 and "'cloth'" in lines[0]
    assert np.array_equal(last_positions(observer), START)
    placer.place(there, 'cloth')
    ros.spin_until(lambda: np.array_equal(last_positions(observer), there), 'the balls there')


def test_balls_are_not_placed_while_they_move(ros):
    node = ros.sim_node(report_integrator='event', real_time_factor=0.05)
    observer = Observer(ros).wait_for_match()
    placer = Placer(ros, observer)
    asked = observer.ask(shot=3)
    ros.spin_until(lambda: observer.state['moving'], 'motion')
    placer.place(START)
    values = placer.wait_for(lambda v: v['rejected commands'] == '1', 'the rejection')
    assert 'moving' in values['last rejection']
    node.set_parameters([Parameter('real_time_factor', value=10.0)])
    done = observer.wait_for_phase(asked, 'done')
    shot = simulate(report_table(), done['velocity'])
    assert np.array_equal(list(done['final_positions'].values()), shot.final_positions)


def test_diagnostics_tell_how_the_node_is_doing(ros):
    ros.sim_node(report_integrator='event', real_time_factor=4.0)
    observer = Observer(ros).wait_for_match()
    placer = Placer(ros, observer)
    observer.request('7')
    observer.wait_for_phase(observer.ask(shot=1), 'done')
    values = placer.wait_for(lambda v: v['energy check'] != 'no shot yet', 'the shot')
    assert values['rejected commands'] == '1' and 'UNKNOWN_SHOT' in values['last rejection']
    assert 0.0 < float(values['compute time of the last shot (s)']) < 60.0
    values = placer.wait_for(
        lambda v: (
            v['achieved speed (sim s / s)'] != 'unknown'
            and abs(float(v['achieved speed (sim s / s)']) - 4.0) < 0.5
        ),
        'the speed',
    )
    assert float(values['worst frame lateness (ms)']) >= 0.0 and int(values['ticks behind']) >= 0
    status = placer.statuses[-1]
    assert status.level in (DiagnosticStatus.OK, DiagnosticStatus.WARN)
    assert status.name == '/pool_sim: simulation' and status.hardware_id == '/pool_sim'


def test_the_speed_is_changed_while_balls_move(ros):
    node = ros.sim_node(report_integrator='event', real_time_factor=0.01)
    observer = Observer(ros).wait_for_match()
    asked = observer.ask(shot=1)
    ros.spin_until(lambda: observer.state['moving'], 'motion')
    for factor in (0.0, 0.5, 100.0):
        [result] = node.set_parameters([Parameter('real_time_factor', value=factor)])
        assert result.successful
    done = observer.wait_for_phase(asked, 'done')
    shot = simulate(report_table(), done['velocity'])
    assert np.array_equal(list(done['final_positions'].values()), shot.final_positions)
    ticks = [round(stamp * 60 / 1e9) for stamp in observer.stamps]
    assert ticks == list(range(ticks[0], ticks[0] + len(ticks)))


@pytest.mark.parametrize('name', ['physical', 'rack15'])
def test_the_other_tables_are_complete_and_playable(name):
    file = CONFIG / f'{name}.yaml'
    values = from_file(file)
    assert set(values) == set(from_file(CONFIG / 'report.yaml'))
    table = build_settings(values_from(values)).table
    assert table.ball_friction == 'coulomb' and table.e_cue_ball == 0.95
    assert len(set(table.labels)) == {'physical': 11, 'rack15': 16}[name]
    assert all(ball.radius == 0.05715 / 2 and ball.mass == 0.17 for ball in table.balls)
    assert simulate(table, (-10.0, 0.1), until=120.0).complete


def test_the_rack_is_tight():
    table = build_settings(values_from(from_file(CONFIG / 'rack15.yaml'))).table
    apart = table.positions[1:, np.newaxis] - table.positions[np.newaxis, 1:]
    distances = np.hypot(*np.moveaxis(apart, 2, 0))[np.triu_indices(15, 1)]
    assert np.sum(distances < 0.05715 + 1e-9) == 30


def test_a_rack_is_broken_over_the_topics(ros):
    with node_process(
        '--ros-args', '--params-file', str(CONFIG / 'rack15.yaml'), '-p', 'real_time_factor:=20.0'
    ):
        observer = Observer(ros).wait_for_match()
        table = table_from_json(observer.heard['table'][-1].data)
        done = observer.wait_for_phase(observer.ask(velocity=[-9.0, 0.3]), 'done')
        shot = simulate(table, (-9.0, 0.3))
        assert np.array_equal(list(done['final_positions'].values()), shot.final_positions)


def test_three_processes_under_other_names_have_no_topic_in_common(ros):
    names = {'/hall/left', '/hall/right', '/pool_sim'}
    arguments = [
        ['-r', '__ns:=/hall', '-r', '__node:=left'],
        ['-r', '__ns:=/hall', '-r', '__node:=right', '-p', 'publish_clock:=true'],
        [],
    ]
    processes = [
        start_node(
            '--ros-args', '-p', 'report_integrator:=event', '-p', 'real_time_factor:=10.0', *words
        )
        for words in arguments
    ]
    try:
        for process in processes:
            process.wait_for('ready')
        observers = {name: Observer(ros, name).wait_for_match() for name in names}
        asked = {name: observers[name].ask(shot=3) for name in sorted(names)}
        for name, observer in observers.items():
            observer.wait_for_phase(asked[name], 'done')
            assert {response['id'] for response in observer.responses} == {asked[name]}
        node = observers['/pool_sim'].node
        shared = {'/clock', '/diagnostics', '/rosout', '/parameter_events'}
        for topic, _ in node.get_topic_names_and_types():
            owners = {
                f'{info.node_namespace.rstrip("/")}/{info.node_name}'
                for info in node.get_publishers_info_by_topic(topic)
                + node.get_subscriptions_info_by_topic(topic)
            }
            assert topic in shared or len(owners & names) <= 1, (topic, owners)
        [clock] = node.get_publishers_info_by_topic('/clock')
        assert clock.node_name == 'right'
    finally:
        for process in processes:
            process.__exit__()


@pytest.mark.parametrize('use_sim_time', [True, False])
@pytest.mark.parametrize('publish_clock', [True, False])
def test_use_sim_time_does_not_stop_the_node_that_makes_the_time(ros, use_sim_time, publish_clock):
    ros.sim_node(**FAST, publish_clock=publish_clock, use_sim_time=use_sim_time)
    observer = Observer(ros).wait_for_match(clock=publish_clock)
    observer.request('7')
    done = observer.wait_for_phase(observer.ask(shot=3), 'done')
    shot = simulate(report_table(), done['velocity'])
    assert np.array_equal(list(done['final_positions'].values()), shot.final_positions)
