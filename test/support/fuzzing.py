"""Does to one node whatever a peer can do: every topic, service and parameter, and what is none."""

import json
import math
import random
import struct
import subprocess
import sys
import time
import uuid
from collections import Counter
from pathlib import Path

from geometry_msgs.msg import Point, Pose, PoseArray, Quaternion, Twist, Vector3
from rcl_interfaces.msg import Parameter as ParameterMessage
from rcl_interfaces.msg import ParameterValue
from rcl_interfaces.srv import (
    DescribeParameters,
    GetParameters,
    GetParameterTypes,
    ListParameters,
    SetParameters,
    SetParametersAtomically,
)
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.serialization import serialize_message
from ros_harness import Ros
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Float64MultiArray, Header, String
from std_srvs.srv import Empty, SetBool, Trigger
from type_description_interfaces.srv import GetTypeDescription

from pool_sim_ros.ros import interface
from pool_sim_ros.simulator import PARAMETERS

GARBAGE = Path(__file__).with_name('garbage_requests.py')
COMMANDS = (interface.CUE_VELOCITY, interface.SHOT_REQUEST, interface.SET_BALL_POSES)
OUTPUTS = (interface.SHOT_RESPONSE, interface.STATE, interface.TABLE, interface.BALL_POSES)

SERVICES = {
    **{s.name: s.type for s in (interface.RESET, interface.SET_PAUSED, interface.STEP)},
    'describe_parameters': DescribeParameters,
    'get_parameter_types': GetParameterTypes,
    'get_parameters': GetParameters,
    'get_type_description': GetTypeDescription,
    'list_parameters': ListParameters,
    'set_parameters': SetParameters,
    'set_parameters_atomically': SetParametersAtomically,
}

FLOATS = (
    0.0, -0.0, 5e-324, 1e-311, 2.3e-308, 1e-9, 1e-6, 1e-3, 1.0, -4.0, 14.9, 949.0, 1e6, 1e155,
    1.7e308, -1.7e308, math.inf, -math.inf, math.nan,
)  # fmt: skip
WHOLE = (0, 1, -1, 2, 60, 1000, 1001, 2**31 - 1, -(2**31), 2**63 - 1, -(2**63))
TEXTS = (
    '',
    'a',
    'event',
    'time_slice',
    'coulomb',
    'report',
    '\x01',
    'ß',
    '\U0001f3b1' * 9,
    '%s%n',
    'x' * 9999,
)
OTHER_PARAMETERS = (
    'use_sim_time',
    'start_type_description_service',
    'nothing',
    '',
    'table',
    'a.b.c',
)

UNANSWERED = 5
"""Calls of one service under way at the most: it keeps ten."""

LOST = 10.0
"""Seconds after which a call that was not answered is lost."""


def garbage_sender(seed):
    """Start another implementation of DDS that sends bytes of no type to the services."""
    names = []
    for name, kind in SERVICES.items():
        package = kind.__module__.split('.')[0]
        names += [f'pool_sim/{name}', f'{package}::srv::dds_::{kind.__name__}_Request_']
    return subprocess.Popen([sys.executable, GARBAGE, str(seed), *names])


class Fuzzer:
    """Does one random thing after another.

    Parameters
    ----------
    ros : Ros
    seed : int
    balls : ndarray of shape (n, 2)
        A layout that is one, m.
    """

    def __init__(self, ros, seed, balls):
        self.done, self.lost = Counter(), 0
        self._ros, self._choose, self._balls = ros, random.Random(seed), balls
        self._node = ros.node('fuzzer')
        self._publishers = {topic.name: self._publisher(topic) for topic in COMMANDS}
        self._raw = {topic.name: self._publisher(topic) for topic in COMMANDS}
        self._clock = self._node.create_publisher(Clock, '/clock', 1)
        self._clients = {
            name: self._node.create_client(kind, f'pool_sim/{name}')
            for name, kind in SERVICES.items()
        }
        self._answers = {name: [] for name in SERVICES}
        self._guests, self._made = [], ['nobody-1']
        self._actions = {
            self.twist: 8, self.request: 10, self.layout: 5, self.garbage: 10, self.huge: 0.2,
            self.control: 6, self.set_parameters: 14, self.ask_parameters: 4, self.describe_type: 1,
            self.clock: 3, self.stranger: 0.5, self.pose_as_the_node: 0.5, self.burst: 0.3,
        }  # fmt: skip

    def wait_for_match(self):
        self._ros.spin_until(
            lambda: (
                all(p.get_subscription_count() for p in self._publishers.values())
                and all(p.get_subscription_count() for p in self._raw.values())
                and all(client.service_is_ready() for client in self._clients.values())
            ),
            'the topics and services',
        )
        return self

    def heard(self, response):
        """Note an id that the node made: a fuzzer guesses the next ones."""
        if response['id'] and '-' in response['id'] and response['phase'] == 'accepted':
            self._made.append(response['id'])
            del self._made[:-50]

    def act(self):
        """Do one thing."""
        [action] = self._choose.choices(list(self._actions), list(self._actions.values()))
        self.done[action.__name__] += 1
        action()

    def all_answer(self):
        """Wait until every service has answered a call that was made now."""
        for name, futures in self._answers.items():
            self._settle(futures, 0)
            self._ros.spin_until(lambda n=name: self._answered(n), f'an answer of {name}')

    def _answered(self, name):
        """Call a service, again and again as a client would; return whether it answers."""
        # Not reset, set_paused and step with what they do at random: nothing here needs to move.
        future = self._clients[name].call_async(SERVICES[name].Request())
        self._settle([future], 0)
        return future.done()

    def _settle(self, futures, most):
        """Wait until at most so many calls are under way; forget those that are lost.

        A service keeps ten requests, and what garbage is sent to it takes their places.
        """
        end = time.monotonic() + LOST
        while sum(not one.done() for one in futures) > most and time.monotonic() < end:
            self._ros.executor.spin_once(0.01)
        lost = sum(not one.done() for one in futures) if time.monotonic() >= end else 0
        self.lost += lost
        futures[:] = [one for one in futures if not (one.done() or lost)]

    def twist(self):
        self._publishers[interface.CUE_VELOCITY.name].publish(
            Twist(linear=Vector3(x=self._speed(), y=self._speed(), z=self._seldom()),
                  angular=Vector3(z=self._seldom()))
        )  # fmt: skip

    def request(self):
        self._publishers[interface.SHOT_REQUEST.name].publish(String(data=self._request()))

    def layout(self):
        self._publishers[interface.SET_BALL_POSES.name].publish(self._poses())

    def garbage(self):
        """Bytes under the right type that are a message, cut, grown or changed, or none at all."""
        topic = self._choose.choice(COMMANDS)
        data = bytearray(serialize_message(self._good(topic)))
        kind = self._choose.choice(('cut', 'grown', 'changed', 'length', 'any', 'any'))
        if kind == 'cut':
            del data[self._choose.randrange(1, len(data)) :]
        elif kind == 'grown':
            data += self._choose.randbytes(self._choose.choice((1, 3, 4, 100, 5000)))
        elif kind == 'changed':
            for _ in range(self._choose.randint(1, 8)):
                data[self._choose.randrange(len(data))] = self._choose.randrange(256)
        elif kind == 'length':
            place = self._choose.randrange(0, len(data) - 3)
            data[place : place + 4] = struct.pack('<I', self._choose.randrange(2**32))
        else:
            data = self._choose.randbytes(self._choose.choice((0, 1, 3, 4, 8, 40, 400)))
        self._send_raw(topic, bytes(data))

    def huge(self):
        size = self._choose.choice((100_000, 1_000_000, 8_000_000))
        topic = self._choose.choice(COMMANDS)
        if topic is interface.SHOT_REQUEST:
            data = serialize_message(String(data='x' * size))
        else:
            data = serialize_message(self._good(topic)) + bytes(size)
        self._send_raw(topic, data)

    def control(self):
        name = self._choose.choice(('reset', 'reset', 'set_paused', 'step', 'step'))
        fields = {'data': self._choose.random() < 0.4} if name == 'set_paused' else {}
        self._call(name, SERVICES[name].Request(**fields))

    def set_parameters(self):
        parameters = [self._parameter() for _ in range(self._choose.choice((1, 1, 1, 2, 3, 0, 40)))]
        if self._choose.random() < 0.01:
            parameters = [ParameterMessage(name=self._name())] * 5000
        name = self._choose.choice(('set_parameters', 'set_parameters_atomically'))
        self._call(name, SERVICES[name].Request(parameters=parameters))

    def ask_parameters(self):
        names = [self._name() for _ in range(self._choose.choice((0, 1, 3, 30)))]
        if self._choose.random() < 0.02:
            names *= 200
        name = self._choose.choice(
            ('describe_parameters', 'get_parameters', 'get_parameter_types', 'list_parameters')
        )
        if name == 'list_parameters':
            depth = self._choose.choice((0, 1, 2, 2**63, 2**64 - 1))
            self._call(name, ListParameters.Request(prefixes=names, depth=depth))
        else:
            self._call(name, SERVICES[name].Request(names=names))

    def describe_type(self):
        request = GetTypeDescription.Request(
            type_name=self._choose.choice(('std_msgs/msg/String', 'x', '', 'a/b/c' * 99)),
            type_hash=self._choose.choice(('', 'RIHS01_', 'RIHS01_' + 'f' * 64, 'x' * 999)),
            include_type_sources=self._choose.random() < 0.5,
        )
        self._call('get_type_description', request)

    def clock(self):
        message = Clock()
        message.clock.sec = self._choose.choice((0, 1, -1, 2**31 - 1, -(2**31)))
        message.clock.nanosec = self._choose.choice((0, 999_999_999, 2**32 - 1))
        self._clock.publish(message)

    def stranger(self):
        """Peers with the right name and another type, or another QoS; each leaves again later.

        Each is a participant of its own: in one, a topic has one type.
        """
        while len(self._guests) > 2:
            self._guests.pop(0).__exit__()
        self._guests.append(Ros(self._ros.domain).__enter__())
        node = self._guests[-1].node('stranger')
        best_effort = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
        name = f'pool_sim/{self._choose.choice(COMMANDS).name}'
        kind = self._choose.choice((Float64MultiArray, Header, String, Twist, PoseArray))
        publisher = node.create_publisher(kind, name, self._choose.choice((10, best_effort)))
        publisher.publish(kind())
        service = self._choose.choice(list(SERVICES))
        others = [k for k in (Empty, SetBool, Trigger, GetParameters) if k != SERVICES[service]]
        kind = self._choose.choice(others)
        client = node.create_client(kind, f'pool_sim/{service}')
        client.call_async(kind.Request())

    def pose_as_the_node(self):
        topic = self._choose.choice(OUTPUTS)
        publisher = self._publisher(topic)
        publisher.publish(topic.type())
        self._node.destroy_publisher(publisher)

    def finish(self, observer):
        """Wait until the node has read all commands: a strike among them may make it busy."""
        self._publishers[interface.SHOT_REQUEST.name].publish(
            String(data='{"id": "the end", "shot": 9}')
        )
        self._publishers[interface.CUE_VELOCITY.name].publish(Twist(linear=Vector3(z=7.25)))
        observer.wait_for_phase('the end', 'rejected')
        self._ros.spin_until(
            lambda: any('7.25' in (r['reason'] or '') for r in observer.responses),
            'the last strike',
        )

    def close(self):
        """Let all strangers leave."""
        while self._guests:
            self._guests.pop().__exit__()

    def burst(self):
        kind = self._choose.choice(('strikes', 'resets', 'requests'))
        for _ in range(self._choose.choice((50, 500))):
            if kind == 'resets':
                self.twist()
                self._call('reset', Trigger.Request())
            else:
                self.twist() if kind == 'strikes' else self.request()

    def _publisher(self, topic):
        return self._node.create_publisher(topic.type, f'pool_sim/{topic.name}', topic.qos)

    def _send_raw(self, topic, data):
        try:
            self._raw[topic.name].publish(data)
        except Exception as error:
            assert 'cannot publish data' in str(error)
        if not data:  # DDS serves one no more that has sent an empty message
            self._node.destroy_publisher(self._raw[topic.name])
            self._raw[topic.name] = self._publisher(topic)

    def _call(self, name, request):
        futures = self._answers[name]
        self._settle(futures, UNANSWERED - 1)
        futures.append(self._clients[name].call_async(request))

    def _good(self, topic):
        if topic is interface.SHOT_REQUEST:
            return String(data='{"id": "a", "shot": 9}')
        return self._poses() if topic is interface.SET_BALL_POSES else Twist()

    def _poses(self):
        kind = self._choose.random()
        positions = self._balls + [[self._choose.uniform(-0.02, 0.02)] * 2]
        if kind < 0.2:
            positions = positions[: self._choose.randrange(len(positions))]
        poses = [Pose(position=Point(x=x, y=y), orientation=Quaternion()) for x, y in positions]
        if kind > 0.8 and poses:
            self._choose.choice(poses).position.x = self._choose.choice(FLOATS)
        frame = self._choose.choice(('', 'table', 'map', '/table'))
        return PoseArray(header=Header(frame_id=frame), poses=poses)

    def _speed(self):
        random_one = self._choose.uniform(-15.0, 15.0)
        return random_one if self._choose.random() < 0.7 else self._choose.choice(FLOATS)

    def _seldom(self):
        return 0.0 if self._choose.random() < 0.9 else self._choose.choice(FLOATS)

    def _request(self):
        if self._choose.random() < 0.2:
            return self._choose.choice(
                ('1', '4', '5', '-1', '+2', ' 3 ', '[' * 4000, '{"id":' * 600, '9' * 4000, 'null',
                 '1e400', '{"shot": 1, "shot": 2}', '{"velocity": [1e999, 0]}', '"\\ud800"', *TEXTS)
            )  # fmt: skip
        prefix, _, count = self._choose.choice(self._made).rpartition('-')
        count = int(count) + self._choose.randrange(3)
        fields = {
            'id': self._choose.choice(
                (uuid.UUID(int=self._choose.getrandbits(128)).hex, 'same', f'{prefix}-{count}',
                 prefix, 'x' * 128, 'x' * 129, '\ud800', 7, None)
            )
        }  # fmt: skip
        if self._choose.random() < 0.5:
            fields['shot'] = self._choose.choice((1, 2, 3, 4, 5, -1, 10**4000, True, '1', None))
        if self._choose.random() < 0.6:
            x, y = self._speed(), self._speed()
            fields['velocity'] = self._choose.choice(
                ([x, y], [x, y], [x, y], [x], x, [x, None], [])
            )
        if self._choose.random() < 0.2:
            spin = [self._speed() for _ in range(3)]
            fields['spin'] = self._choose.choice((spin, spin[:2], [*spin[:2], '1'], None))
        if self._choose.random() < 0.2:
            cue = {'speed': self._speed(), 'azimuth': self._speed(), 'side': self._seldom()}
            fields['cue'] = self._choose.choice((cue, {**cue, 'x': 1}, {'speed': 1.0}, [1.0], '1'))
        if self._choose.random() < 0.2:
            place = {'9': [abs(self._speed()), 0.5], 'C': [1.6, abs(self._seldom())]}
            fields['place'] = self._choose.choice((place, {'x': [1.0, 0.5]}, {'9': [1.0]}, {}, [9]))
        if self._choose.random() < 0.05:
            fields[self._choose.choice(TEXTS)] = 1
        return json.dumps(fields)

    def _name(self):
        return self._choose.choice((*PARAMETERS, *OTHER_PARAMETERS))

    def _parameter(self):
        name = self._name()
        return ParameterMessage(name=name, value=self._value(PARAMETERS.get(name)))

    def _value(self, spec):
        """Return a value, mostly of the right type and near what the parameter takes."""
        value = ParameterValue(
            bool_value=self._choose.random() < 0.5,
            integer_value=self._choose.choice(WHOLE),
            double_value=self._choose.choice(FLOATS),
            string_value=self._choose.choice(TEXTS),
            double_array_value=[self._choose.choice(FLOATS)] * self._choose.choice((0, 1, 11, 22)),
            string_array_value=[self._choose.choice(TEXTS)] * self._choose.choice((0, 1, 11)),
        )
        value.type = self._choose.choice((*range(10), 10, 77, 128, 255))
        if spec is None or self._choose.random() < 0.2:
            return value
        kinds = {bool: 1, int: 2, float: 3, str: 4, list: 9 if spec.holds_strings else 8}
        value.type = kinds[type(spec.default)]
        if value.type == 2:
            value.integer_value = self._choose.choice(
                [int(spec.least), int(spec.most), spec.default, self._choose.choice(WHOLE)]
            )
        elif value.type == 3:
            edges = (spec.least, spec.most, spec.smallest)
            beyond = [math.nextafter(edge, to) for edge in edges for to in (-math.inf, math.inf)]
            value.double_value = float(
                self._choose.choice([*edges, *beyond, spec.default, self._choose.choice(FLOATS)])
            )
        elif spec.choices and self._choose.random() < 0.8:
            value.string_value = self._choose.choice(spec.choices)
        return value
