"""A node that asks the oracle for a shot, plays it, and goes on with the next ball."""

import sys

import rclpy
from rclpy.node import Node

from pool_sim_ros.ros import PlanClient, ShotClient

rclpy.init()
node = Node('player')
planner, shooter = PlanClient(node), ShotClient(node.context)
shooter.wait_for_simulator(30.0)
for number, ball in enumerate(sys.argv[1:] or ['9', '4', '7'], 1):
    place = {'ball': ball, 'to': [0.3 + 0.1 * number, 0.56], 'within': 0.2}
    plan = planner.plan(place, 'sjtu', shots=20_000)
    rclpy.spin_until_future_complete(node, plan)
    shots = plan.result()['shots']
    if not shots:
        print(f'{number}: ball {ball}: no shot found')
        continue
    played = shooter.play(velocity=shots[0]['velocity'], spin=shots[0]['spin'], timeout=60.0)
    x, y = played['final_positions'][ball]
    print(f'{number}: ball {ball}: {shots[0]["chance"]:.0%}, ended at [{x:.2f}, {y:.2f}]')
rclpy.shutdown()
