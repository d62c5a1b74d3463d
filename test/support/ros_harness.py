"""Helpers for tests over ROS: contexts and observers; none of them sleeps blindly."""

import contextlib
import fcntl
import json
import random
import tempfile
import time
import uuid
from pathlib import Path

import numpy as np
import rclpy
from process_harness import Process
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile
from waiting import PATIENCE

from pool_sim_ros.ros import interface, messages
from pool_sim_ros.ros.sim_node import SimNode
from pool_sim_ros.ros.spin_thread import SpinThread

FRAMES_KEPT = 20000


@contextlib.contextmanager
def own_domain():
    """Yield a domain id from 1 to 101 that is locked for as long as this lasts."""
    folder = Path(tempfile.gettempdir())
    for number in random.sample(range(1, 102), 101):
        with (folder / f'pool_sim_ros_domain_{number}.lock').open('w') as file:
            with contextlib.suppress(BlockingIOError):
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                yield number
                return
    raise RuntimeError('all ROS domains from 1 to 101 are taken by other test runs')


class Ros:
    """A context and an executor; ends whatever was made with it, in reverse order."""

    def __init__(self, domain, args=()):
        self.domain, self._args = domain, list(args)
        self._stack = contextlib.ExitStack()

    def __enter__(self):
        self.context = Context()
        rclpy.init(args=self._args, context=self.context, domain_id=self.domain)
        self._stack.callback(self.context.try_shutdown)
        self.executor = SingleThreadedExecutor(context=self.context)
        self._stack.callback(self.executor.shutdown, 0.0)
        return self

    def __exit__(self, *_):
        self._stack.close()

    def add(self, node):
        self.executor.add_node(node)
        self._stack.callback(node.destroy_node)
        return node

    def node(self, name='observer'):
        return self.add(Node(f'{name}_{uuid.uuid4().hex[:8]}', context=self.context))

    def sim_node(self, name=interface.NODE_NAME, **parameters):
        """Make a SimNode in this process; `table_length` stands for the parameter table.length."""
        overrides = [
            Parameter(key.replace('table_', 'table.').replace('balls_', 'balls.'), value=value)
            for key, value in parameters.items()
        ]
        return self.add(
            SimNode(context=self.context, node_name=name, parameter_overrides=overrides)
        )

    def spin_until(self, condition, what):
        end = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < end, f'waited {PATIENCE:g} s for {what}'
            Process.check_all()
            self.executor.spin_once(0.1)


@contextlib.contextmanager
def spinning(node):
    """Run the callbacks of a node in the background."""
    thread = SpinThread(node)
    try:
        yield node
    finally:
        thread.close()


class Observer:
    """A client of the node that keeps everything it hears, by topic."""

    TOPICS = (
        interface.BALL_POSES,
        interface.BALL_VELOCITIES,
        interface.COLLISIONS,
        interface.SHOT_RESPONSE,
        interface.STATE,
        interface.TABLE,
        interface.CLOCK,
    )

    def __init__(self, ros, simulator=interface.NODE_NAME):
        self._ros = ros
        self._simulator = simulator
        self.node = ros.node()
        self.heard = {topic.name: [] for topic in self.TOPICS}
        self._subscriptions = {}
        self._clients = {}
        self.responses = []
        for topic in self.TOPICS:
            qos = QoSProfile(
                depth=FRAMES_KEPT,
                durability=topic.qos.durability,
                reliability=topic.qos.reliability,
            )
            self._subscriptions[topic.name] = self.node.create_subscription(
                topic.type, topic.of(simulator), self._keeper(topic), qos
            )
        self._publishers = {
            topic.name: self.node.create_publisher(topic.type, topic.of(simulator), topic.qos)
            for topic in (interface.SHOT_REQUEST, interface.CUE_VELOCITY)
        }

    def _keeper(self, topic):
        if topic is interface.SHOT_RESPONSE:
            return lambda message: self.responses.append(json.loads(message.data))
        return self.heard[topic.name].append

    def wait_for_match(self, clock=False):
        """Wait until everything sent from now on arrives, both ways, and what is latched has."""
        subscriptions = [
            subscription
            for name, subscription in self._subscriptions.items()
            if clock or name != interface.CLOCK.name
        ]

        def matched():
            return (
                all(s.get_publisher_count() for s in subscriptions)
                and all(p.get_subscription_count() for p in self._publishers.values())
                and self.heard[interface.STATE.name]
                and self.heard[interface.TABLE.name]
            )

        self._ros.spin_until(matched, f'the topics of {self._simulator}')
        return self

    def request(self, text):
        self._publishers[interface.SHOT_REQUEST.name].publish(messages.to_string(text))

    def ask(self, **fields):
        """Send a request under a new id, and return the id."""
        request_id = uuid.uuid4().hex
        self.request(json.dumps({'id': request_id, **fields}))
        return request_id

    def strike(self, twist):
        self._publishers[interface.CUE_VELOCITY.name].publish(twist)

    @property
    def state(self):
        return json.loads(self.heard[interface.STATE.name][-1].data)

    @property
    def stamps(self):
        return [messages.from_time(m.header.stamp) for m in self.heard['ball_poses']]

    @property
    def collisions(self):
        rows = [messages.from_rows(m) for m in self.heard['collisions']]
        return np.concatenate(rows) if rows else np.empty((0, 10))

    def phases(self, request_id):
        return [r['phase'] for r in self.responses if r['id'] == request_id]

    def wait_for_responses(self, count):
        self._ros.spin_until(lambda: len(self.responses) >= count, f'{count} responses')
        return self.responses

    def wait_for_phase(self, request_id, phase):
        self._ros.spin_until(lambda: phase in self.phases(request_id), f'{phase} of {request_id}')
        return next(r for r in self.responses if (r['id'], r['phase']) == (request_id, phase))

    def wait_for_frame_at(self, time):
        """Wait for a frame at or after a sim time in s, and return the positions in the latest."""
        poses = self.heard[interface.BALL_POSES.name]

        def latest():
            return messages.from_time(poses[-1].header.stamp) if poses else -1

        self._ros.spin_until(lambda: latest() >= time * 1e9 - 0.5, f'a frame at {time} s')
        return messages.from_poses(poses[-1])

    def wait_for_settled(self, count):
        """Wait until `count` requests are accepted or rejected, and those accepted are over."""

        def settled():
            phases = [response['phase'] for response in self.responses]
            accepted = phases.count('accepted')
            over = phases.count('done') + phases.count('preempted')
            return accepted + phases.count('rejected') >= count and accepted == over

        self._ros.spin_until(settled, f'{count} answers')

    def call(self, service, **fields):
        """Call a service of the node and return its response."""
        if service not in self._clients:
            name = service.of(self._simulator)
            self._clients[service] = self.node.create_client(service.type, name)
        client = self._clients[service]
        self._ros.spin_until(client.service_is_ready, service.name)
        future = client.call_async(service.type.Request(**fields))
        self._ros.spin_until(future.done, f'the answer of {service.name}')
        return future.result()
