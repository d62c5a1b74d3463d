"""Nodes of one full name: each of them is told."""

import pytest
import rclpy
from process_harness import node_process
from rclpy.context import Context
from rclpy.node import Node
from waiting import wait_until

from pool_sim_ros.ros import ShotClient
from pool_sim_ros.ros.namesakes import Namesakes, count_nodes

PATIENCE = 60.0
LINE = '2 nodes are named /pool_sim: '


@pytest.fixture
def make_node(domain):
    """Make nodes, each in a context of its own, as other processes have them."""
    made = []

    def make(name, namespace='/'):
        context = Context()
        rclpy.init(args=[], context=context, domain_id=domain)
        made.append(Node(name, namespace=namespace, context=context))
        return made[-1]

    yield make
    for node in made:
        node.destroy_node()
        node.context.try_shutdown()


def test_nodes_are_counted_by_their_full_name(ros, make_node):
    watcher = ros.node()
    for name, namespace in (('left', '/'), ('left', '/'), ('left', '/hall'), ('left_', '/')):
        make_node(name, namespace)
    ros.spin_until(lambda: count_nodes(watcher, '/left') == 2, 'both')
    ros.spin_until(lambda: count_nodes(watcher, '/hall/left') == 1, 'the one in the hall')
    ros.spin_until(lambda: count_nodes(watcher, '/left_') == 1, 'the longer name')
    assert count_nodes(watcher, '/lef') == count_nodes(watcher, 'left') == 0


def test_it_is_warned_of_once_and_again_once_the_other_had_gone(ros, make_node, capfd):
    node = make_node('left')
    namesakes = Namesakes(node)

    def warnings(count):
        ros.spin_until(lambda: count_nodes(node, '/left') == count, f'{count} nodes')
        for _ in range(3):
            namesakes.check()
        return capfd.readouterr().err.count('nodes are named /left: ')

    assert warnings(1) == 0
    other = make_node('left')
    assert warnings(2) == 1
    other.destroy_node()
    assert warnings(1) == 0
    make_node('left')
    assert warnings(2) == 1


def test_two_simulators_of_one_name_and_their_client_say_so(ros, capfd):
    fast = {'report_integrator': 'event', 'real_time_factor': 20.0}
    with node_process(**fast) as one, node_process(**fast) as other:
        for process in (one, other):
            process.wait_for(LINE)
        client = ShotClient(ros.context)
        try:
            client.wait_for_simulator(PATIENCE)
            wait_until(lambda: client._link.count_simulators() == 2, 'both')
            client.play(3, timeout=PATIENCE)
        finally:
            client.close()
        assert one.stderr.count(LINE) == other.stderr.count(LINE) == 1
    assert capfd.readouterr().err.count(LINE) == 1
