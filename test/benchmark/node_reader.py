"""A reader of all topics in a process of its own; says on standard output what it heard.

Each line is a JSON object: one once the topics are matched, and one when standard input closes.
"""

import json
import sys
import threading

import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile

from pool_sim_ros.ros import interface

TOPICS = (interface.BALL_POSES, interface.BALL_VELOCITIES, interface.COLLISIONS)
STAMP = slice(4, 12)
DEPTH = 20000
"""11 s of frames at 30 times real time: what is missing then was not lost in this queue."""


def main() -> None:
    context = Context()
    rclpy.init(args=[], context=context)
    node = Node('reader', context=context, use_global_arguments=False)
    heard = {topic.name: [] for topic in TOPICS}

    def keep(topic):
        return lambda data: heard[topic.name].append(data[STAMP])

    subscriptions = [
        node.create_subscription(
            topic.type, topic.of('/pool_sim'), keep(topic), QoSProfile(depth=DEPTH), raw=True
        )
        for topic in TOPICS
    ]
    closed = threading.Event()
    threading.Thread(target=lambda: (sys.stdin.read(), closed.set()), daemon=True).start()
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    said = False
    while not closed.is_set():
        executor.spin_once(0.05)
        if not said and all(s.get_publisher_count() for s in subscriptions):
            print(json.dumps({'matched': True}), flush=True)
            said = True
    stamps = [
        int.from_bytes(s[:4], 'little') * 10**9 + int.from_bytes(s[4:], 'little')
        for s in heard['ball_poses']
    ]
    print(json.dumps({'stamps': stamps, **{name: len(heard[name]) for name in heard}}), flush=True)
    context.try_shutdown()


if __name__ == '__main__':
    main()
