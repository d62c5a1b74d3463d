"""Answers each request for a what-if with the same bytes, until it is interrupted: what ROS alone
takes there and back.

python echo.py
"""

import sys

import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

from pool_sim_ros.ros import oracle_interface
from pool_sim_ros.ros.what_if_rows import no_answer_bytes

NAME = '/echo'


def main() -> None:
    context = Context()
    rclpy.init(args=[], context=context)
    node = Node('echo', context=context, use_global_arguments=False, start_parameter_services=False)
    asked, told = oracle_interface.WHAT_IF_REQUEST, oracle_interface.WHAT_IF_RESPONSE
    answers = node.create_publisher(told.type, told.of(NAME), told.publisher_qos)
    answer = no_answer_bytes((1, 2), 'table')
    node.create_subscription(
        asked.type, asked.of(NAME), lambda _: answers.publish(answer), asked.qos, raw=True
    )
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    print('ready', file=sys.stderr, flush=True)
    try:
        executor.spin()
    except KeyboardInterrupt:
        pass
    finally:
        context.try_shutdown()


if __name__ == '__main__':
    main()
