"""What came is taken once, in order, with the time at which it came."""

import time

from waiting import wait_until

from pool_sim_ros.ros import interface, messages
from pool_sim_ros.ros.inbox import Inbox
from pool_sim_ros.ros.simulator_link import SimulatorLink


def test_messages_wait_until_somebody_takes_them(ros):
    topic = interface.SHOT_RESPONSE
    node = ros.node()
    publisher = node.create_publisher(topic.type, topic.of('someone'), topic.qos)
    link = SimulatorLink(ros.context, '/someone', 'inbox')
    try:
        inbox, raw = Inbox(link, topic, past=False), Inbox(link, topic, depth=1, raw=True)
        wait_until(lambda: publisher.get_subscription_count() == 2, 'both')
        before = time.time_ns()
        for text in 'abc':
            publisher.publish(messages.to_string(text))
        found = []
        wait_until(lambda: found.extend(inbox.take()) or len(found) == 3, 'three messages')
        assert [message.data for message, _ in found] == ['a', 'b', 'c']
        assert all(before <= came <= time.time_ns() for _, came in found)
        assert inbox.take() == []
        ((data, _),) = raw.take()  # of depth 1: the latest
        assert data.endswith(b'c\0') and isinstance(data, bytes)
    finally:
        link.close()
