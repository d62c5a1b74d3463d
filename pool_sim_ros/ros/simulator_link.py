"""A client's side of the topics and services of one simulator."""

from __future__ import annotations

import uuid
from collections.abc import Callable
from typing import Any, TypeVar

from rclpy.client import Client
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.subscription import Subscription

from pool_sim_ros.ros import interface
from pool_sim_ros.ros.namesakes import count_nodes
from pool_sim_ros.ros.spin_thread import SpinThread

COMPLAINT_PERIOD = 1.0
"""Least time in s between two lines of the log about what made no sense."""

COMPLAINT_LENGTH = 300
"""Characters of such a line: anybody may send anything."""


T = TypeVar('T')


class SimulatorLink:
    """A node of its own that talks to one simulator.

    No other node has its name, and it offers no services. So one can start many, and a security
    policy need not know their names.

    Callbacks run in a thread of the link after `start`, or in the thread that calls `spin_once`.

    Parameters
    ----------
    context : Context
        Initialised; stays the caller's.
    simulator : str
        Name of the simulator, relative to the namespace of this process or absolute.
    kind : str
        What the node is; a part of its name.
    enable_rosout : bool, optional
        Whether the node's log goes to `/rosout` too.
    """

    def __init__(
        self, context: Context, simulator: str, kind: str, *, enable_rosout: bool = True
    ) -> None:
        self._node = Node(
            f'pool_{kind}_{uuid.uuid4().hex[:8]}',
            context=context,
            enable_rosout=enable_rosout,
            start_parameter_services=False,
            parameter_overrides=[Parameter('start_type_description_service', value=False)],
        )
        self._name = simulator
        self._executor: SingleThreadedExecutor | None = None
        self._thread: SpinThread | None = None

    @property
    def simulator(self) -> str:
        """Full name of the simulator."""
        topic = interface.SHOT_REQUEST
        return self.full_name(topic).removesuffix(f'/{topic.name}')

    def full_name(self, topic: interface.Topic) -> str:
        """Return the name under which the simulator has `topic`."""
        return self._node.resolve_topic_name(topic.of(self._name))

    def publisher(self, topic: interface.Topic) -> Publisher:
        """Return a publisher to `topic` of the simulator."""
        return self._node.create_publisher(topic.type, topic.of(self._name), topic.qos)

    def subscribe(
        self,
        topic: interface.Topic,
        callback: Callable[..., None],
        *,
        depth: int | None = None,
        past: bool = True,
        raw: bool = False,
    ) -> Subscription:
        """Subscribe to a topic of the simulator.

        Parameters
        ----------
        topic : Topic
        callback : callable
            Called with each message, or with it and what ROS knows about it.
        depth : int, optional
            Depth of the queue, in messages; by default that of the topic.
        past : bool, optional
            Whether a latched topic also delivers what was published before.
        raw : bool, optional
            Whether the messages come as serialised bytes.

        Returns
        -------
        Subscription
        """
        qos = QoSProfile(
            depth=topic.qos.depth if depth is None else depth,
            reliability=topic.qos.reliability,
            durability=topic.qos.durability if past else DurabilityPolicy.VOLATILE,
        )
        name = topic.of(self._name)
        return self._node.create_subscription(topic.type, name, callback, qos, raw=raw)

    def subscribe_text(
        self,
        topic: interface.Topic,
        read: Callable[[str], T],
        callback: Callable[[T], None],
        *,
        depth: int | None = None,
    ) -> Subscription:
        """Subscribe to a topic of texts; what `read` refuses with a ValueError is left out.

        Parameters
        ----------
        topic : Topic
        read : callable
            Returns what a text says.
        callback : callable
            Called with that.
        depth : int, optional
            As in `subscribe`.

        Returns
        -------
        Subscription
        """

        def on_text(message: Any) -> None:
            try:
                content = read(message.data)
            except ValueError as error:
                self.left_out(error)
            else:
                callback(content)

        return self.subscribe(topic, on_text, depth=depth)

    def unsubscribe(self, subscription: Subscription) -> None:
        """End `subscription`."""
        self._node.destroy_subscription(subscription)

    def client(self, service: interface.Service) -> Client:
        """Return a client of `service` of the simulator."""
        return self._node.create_client(service.type, service.of(self._name))

    def count_simulators(self) -> int:
        """Return how many nodes have the full name of the simulator."""
        return count_nodes(self._node, self.simulator)

    def warn(self, line: str) -> None:
        """Write `line` to the log of the node, as a warning."""
        self._node.get_logger().warn(line)

    def left_out(self, reason: object) -> None:
        """Write to the log, now and then, that something made no sense, with the `reason`."""
        words = ' '.join(str(reason)[:COMPLAINT_LENGTH].split())
        words = words.encode(
            errors='backslashreplace'
        ).decode()  # half a character cannot be logged
        line = f'not understood, and left out: {words}'
        self._node.get_logger().warn(line, throttle_duration_sec=COMPLAINT_PERIOD)

    def start(self) -> None:
        """Run the callbacks in a thread of the link's own, from now on."""
        self._thread = SpinThread(self._node)

    def spin_once(self, timeout: float) -> None:
        """Run a callback in this thread; wait for one at most `timeout` s."""
        if self._executor is None:
            self._executor = SingleThreadedExecutor(context=self._node.context)
            self._executor.add_node(self._node)
        self._executor.spin_once(timeout)

    def close(self) -> None:
        """Run no more callbacks, and leave ROS."""
        if self._thread is not None:
            self._thread.close()
        if self._executor is not None:
            self._executor.shutdown(0.0)
        self._node.destroy_node()
