"""A node that is spun in the background."""

from __future__ import annotations

import threading

from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node


class SpinThread:
    """Runs the callbacks of a node in a thread of its own, from its making to `close`.

    Parameters
    ----------
    node : Node
        Stays the caller's.
    """

    def __init__(self, node: Node) -> None:
        self._executor = SingleThreadedExecutor(context=node.context)
        self._executor.add_node(node)
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._spin, name='ros', daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Run no more callbacks."""
        # Not shutdown() first: the thread may be in the midst of what that takes away.
        self._closing.set()
        self._executor.wake()
        self._thread.join()
        self._executor.shutdown(0.0)

    def _spin(self) -> None:
        try:
            while not self._closing.is_set():
                self._executor.spin_once(0.5)
        except ExternalShutdownException:
            pass
