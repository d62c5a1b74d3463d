"""The declared topics and services, and what the node makes of them."""

from rclpy.qos import DurabilityPolicy, ReliabilityPolicy

from pool_sim_ros.ros import interface


def test_interface_is_that_of_the_design(ros):
    ros.sim_node('table_1', publish_clock=True)
    node = ros.node()
    expected = {
        '/table_1/cue_velocity': ('geometry_msgs/msg/Twist', False, 1000),
        '/table_1/shot/request': ('std_msgs/msg/String', False, 1000),
        '/table_1/shot/response': ('std_msgs/msg/String', True, 1000),
        '/table_1/ball_poses': ('geometry_msgs/msg/PoseArray', False, 10),
        '/table_1/ball_velocities': ('std_msgs/msg/Float64MultiArray', False, 10),
        '/table_1/collisions': ('std_msgs/msg/Float64MultiArray', False, 1000),
        '/table_1/state': ('std_msgs/msg/String', True, 1),
        '/table_1/table': ('std_msgs/msg/String', True, 1),
        '/table_1/markers': ('visualization_msgs/msg/MarkerArray', True, 10),
        '/table_1/set_ball_poses': ('geometry_msgs/msg/PoseArray', False, 10),
        '/diagnostics': ('diagnostic_msgs/msg/DiagnosticArray', False, 10),
        '/clock': ('rosgraph_msgs/msg/Clock', False, 1),
    }
    declared = [item for item in vars(interface).values() if isinstance(item, interface.Topic)]
    topics = {topic.of('/table_1'): topic for topic in declared}
    assert set(topics) == set(expected)
    ros.spin_until(lambda: node.count_publishers('/clock') > 0, 'the clock')
    for name, (kind, latched, depth) in expected.items():
        if name.endswith(('cue_velocity', 'request', 'set_ball_poses')):
            [info] = node.get_subscriptions_info_by_topic(name)
        else:
            info, *_ = node.get_publishers_info_by_topic(name)  # ~/markers has two
        assert info.topic_type == kind
        assert info.qos_profile.reliability is ReliabilityPolicy.RELIABLE
        assert (info.qos_profile.durability is DurabilityPolicy.TRANSIENT_LOCAL) == latched
        assert topics[name].qos.depth == depth
    services = dict(node.get_service_names_and_types_by_node('table_1', '/'))
    assert services['/table_1/reset'] == services['/table_1/step'] == ['std_srvs/srv/Trigger']
    assert services['/table_1/set_paused'] == ['std_srvs/srv/SetBool']
