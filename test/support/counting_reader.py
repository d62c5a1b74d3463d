"""Reads frames in a process of its own: says that it is matched, and once it has so many.

python counting_reader.py NODE COUNT
"""

import sys

import rclpy
from rclpy.qos import QoSProfile

from pool_sim_ros.ros import interface

TOPICS = (interface.BALL_POSES, interface.BALL_VELOCITIES)


def main() -> None:
    name, count = sys.argv[1], int(sys.argv[2])
    rclpy.init(args=[])
    node = rclpy.create_node('counting_reader')
    heard = {topic.name: 0 for topic in TOPICS}

    def add(topic):
        def on_message(_):
            heard[topic.name] += 1

        return on_message

    subscriptions = [
        node.create_subscription(
            topic.type, topic.of(name), add(topic), QoSProfile(depth=count), raw=True
        )
        for topic in TOPICS
    ]
    while not all(subscription.get_publisher_count() for subscription in subscriptions):
        rclpy.spin_once(node, timeout_sec=0.05)
    print('matched', flush=True)
    while min(heard.values()) < count:
        rclpy.spin_once(node, timeout_sec=0.05)
    print('all of them', flush=True)


if __name__ == '__main__':
    main()
