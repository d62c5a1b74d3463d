"""An executor that nothing ends but a shutdown."""

# Executors of rclpy have no types.
# mypy: allow-untyped-calls

from __future__ import annotations

import functools
import time
from collections.abc import Callable
from typing import Any

from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.logging import get_logger
from rclpy.node import Node

from pool_sim_ros.ros.guarded_node import exceptions_told

PAUSE = 0.1
"""Seconds after a failed wait: should each one fail, this leaves the processor to others."""


class LastingExecutor(SingleThreadedExecutor):
    """Outlasts what is raised where a message is taken, dealt with or answered, and logs it.

    A `GuardedNode` raises nothing in its callbacks. rclpy raises around them too.

    Parameters
    ----------
    context : Context
    """

    def __init__(self, context: Context) -> None:
        super().__init__(context=context)

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Wait for one callback and run it; see rclpy."""
        ended_well = False
        with exceptions_told('waiting for messages', self.context, get_logger('executor')):
            super().spin_once(timeout_sec)
            ended_well = True
        if not ended_well and self.context.ok():
            time.sleep(PAUSE)

    def _make_handler(self, entity: Any, node: Node, take: Callable[[Any], Any]) -> Any:
        # Here, since rclpy never calls an entity again whose `take` has raised.
        what = str(getattr(entity, 'topic', getattr(entity, 'srv_name', type(entity).__name__)))

        def told() -> Any:
            return exceptions_told(what, self.context, node.get_logger())

        async def deal_with(call: Callable[[], Any]) -> None:
            with told():
                await call()

        def take_or_nothing(entity: Any) -> Any:
            call = None
            with told():
                call = take(entity)
            return None if call is None else functools.partial(deal_with, call)

        return super()._make_handler(entity, node, take_or_nothing)
