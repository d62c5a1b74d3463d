"""Spinning a node in the background."""

from __future__ import annotations

import threading

from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node

LONGEST_WAIT = 0.5
"""Longest time between two checks of whether to end, s."""


class SpinThread:
    """Runs the callbacks of a node in a thread of its own until `close`.

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
        # Not shutdown() first: the thread may still use what that takes away.
        self._closing.set()
        self._executor.create_task(lambda: None)  # a task ends its wait
        self._thread.join()
        self._executor.shutdown(0.0)

    def _spin(self) -> None:
        try:
            while not self._closing.is_set():
                self._executor.spin_once(LONGEST_WAIT)
        except ExternalShutdownException:
            pass
