"""A node that shoots once and prints where the cue ball stopped."""

import json
import uuid

import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String

PATIENCE = 30.0  # s


class Shooter(Node):
    def __init__(self):
        super().__init__('shooter')
        self.requests = self.create_publisher(String, 'pool_sim/shot/request', 10)
        latched = QoSProfile(depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_subscription(String, 'pool_sim/shot/response', self.on_response, latched)
        self.id = uuid.uuid4().hex
        self.timer = self.create_timer(0.5, self.shoot)
        self.create_timer(PATIENCE, self.give_up)

    def shoot(self):
        # Until it is answered: a request may be lost, and the simulator plays each id once.
        request = {'id': self.id, 'velocity': [-2.0, 0.3]}
        self.requests.publish(String(data=json.dumps(request)))

    def on_response(self, message):
        if self.id not in message.data:
            return  # somebody else's
        self.timer.cancel()
        response = json.loads(message.data)
        if response['phase'] != 'accepted':
            print(response['phase'], response['reason'] or response['final_positions']['C'])
            raise SystemExit

    def give_up(self):
        raise SystemExit(f'the shot did not end within {PATIENCE:g} s; is pool_sim running?')


rclpy.init()
rclpy.spin(Shooter())
