"""A ROS 2 node that rides along: it strikes, tells hard contacts, and strikes again at rest.

    ros2 run pool_sim_ros sim_node          # in one terminal, or: make play
    python examples/ride_along.py           # in another

It needs the topics only: nothing of pool_sim_ros is imported, so it can be copied anywhere.
"""

import argparse
import json
import random
import uuid

import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Float64MultiArray, String

PATIENCE = 30.0
"""Seconds of silence after which it gives up."""

COLUMNS = ('seq', 't', 'kind', 'a', 'b', 'x', 'y', 'nx', 'ny', 'speed')
"""Of a row of `~/collisions`; kind 0 is a contact of two balls."""

HARD = 1.0
"""Closing speed above which a contact is told, m/s."""


class Rider(Node):
    """Strikes the cue ball at random, one shot after another."""

    def __init__(self, simulator, shots, seed):
        super().__init__('rider')
        self.left, self.random, self.id = shots, random.Random(seed), None
        self.requests = self.create_publisher(String, f'{simulator}/shot/request', 10)
        latched = QoSProfile(depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_subscription(String, f'{simulator}/shot/response', self.on_response, latched)
        deep = QoSProfile(depth=1000)
        self.create_subscription(
            Float64MultiArray, f'{simulator}/collisions', self.on_collisions, deep
        )
        self.strike_anew()
        self.timer = self.create_timer(0.5, self.ask)
        self.silence = self.create_timer(PATIENCE, self.give_up)

    def strike_anew(self):
        """Choose a strike, with an id of its own: the simulator plays each id once."""
        self.id = uuid.uuid4().hex
        self.velocity = [self.random.uniform(-4.0, -1.0), self.random.uniform(-1.0, 1.0)]

    def ask(self):
        """Send the request, again and again until it is answered: one may be lost."""
        request = {'id': self.id, 'velocity': self.velocity}
        self.requests.publish(String(data=json.dumps(request)))

    def on_response(self, message):
        """Hear what came of a request."""
        response = json.loads(message.data)
        if response.get('id') != self.id:
            return  # somebody else's
        self.silence.reset()
        if response['phase'] == 'accepted':
            self.timer.cancel()
            return
        if response['phase'] != 'done':
            raise SystemExit(f'{response["phase"]}: {response["reason"]}')
        x, y = response['final_positions']['C']
        print(f'The cue ball rests at ({x:.3f}, {y:.3f}) m.', flush=True)
        self.left -= 1
        if not self.left:
            raise SystemExit
        self.strike_anew()
        self.timer.reset()
        self.ask()

    def on_collisions(self, message):
        """Hear the contacts up to the next frame, as they come, and tell the hard ones of balls."""
        width = len(COLUMNS)
        for start in range(0, len(message.data), width):
            row = dict(zip(COLUMNS, message.data[start : start + width], strict=True))
            if row['kind'] == 0 and row['speed'] > HARD:
                print(f'  {row["t"]:8.3f} s: balls meet at {row["speed"]:.1f} m/s')

    def give_up(self):
        """End where nobody answers."""
        raise SystemExit(f'nothing was heard for {PATIENCE:g} s; is the simulator running?')


def main():
    """Ride along for some shots."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--simulator', default='pool_sim', help='the name of its node')
    parser.add_argument('--shots', type=int, default=3)
    parser.add_argument('--seed', type=int, help='of the strikes; by default each run differs')
    given = parser.parse_args()
    rclpy.init()
    rclpy.spin(Rider(given.simulator, given.shots, given.seed))


if __name__ == '__main__':
    main()
