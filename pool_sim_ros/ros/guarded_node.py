"""A node whose callbacks raise nothing: what they raise goes into the log, and the node goes on."""

# Some methods of rclpy's Node have no types.
# mypy: allow-untyped-calls

from __future__ import annotations

import contextlib
import functools
import inspect
import traceback
from collections.abc import Callable, Iterator
from typing import Any

from rclpy.context import Context
from rclpy.executors import ExternalShutdownException
from rclpy.impl.rcutils_logger import RcutilsLogger
from rclpy.node import Node
from rclpy.service import Service
from rclpy.subscription import Subscription
from rclpy.timer import Timer

from pool_sim_ros.ros.parameter_services import checked

TELL_PERIOD = 1.0
"""Seconds between two exceptions in the log: a peer may cause as many as it likes."""

LOG_PERIOD = 0.1
"""Seconds between two warnings in the log; this delays no response."""

Callback = Callable[..., Any]


@contextlib.contextmanager
def exceptions_told(what: str, context: Context, log: RcutilsLogger) -> Iterator[None]:
    """Log an exception and go on after the block.

    Parameters
    ----------
    what : str
        What it befell: the name of a topic or a service.
    context : Context
        While it is down nothing is logged: then calls fail because of that.
    log : RcutilsLogger
    """
    try:
        yield
    except ExternalShutdownException:
        raise
    except Exception:
        if context.ok():
            text = f'{what} failed, and the node goes on:\n{traceback.format_exc()}'
            log.error(encodable(text), throttle_duration_sec=TELL_PERIOD)


def encodable(text: str) -> str:
    """Return a text that the log can write: a peer may send half of a surrogate pair."""
    return text.encode(errors='backslashreplace').decode()


class GuardedNode(Node):
    """A node whose subscriptions, services and timers raise nothing, under any executor.

    A service that fails is answered with its empty response.

    Parameters
    ----------
    *args, **options
        As rclpy's Node takes them.
    """

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        for service in self.services:  # rclpy makes some without create_service
            service.callback = self._guarded(service.srv_name, service.callback, service.srv_type)

    def create_subscription(
        self, msg_type: Any, topic: str, callback: Callback, *args: Any, **options: Any
    ) -> Subscription:
        """Return a subscription; `msg_type`, `topic`, `callback` and the rest as rclpy has them."""
        guarded = self._guarded(topic, callback)
        return super().create_subscription(msg_type, topic, guarded, *args, **options)

    def create_service(
        self, srv_type: Any, srv_name: str, callback: Callback, *args: Any, **options: Any
    ) -> Service:
        """Return a service; `srv_type`, `srv_name`, `callback` and the rest as rclpy has them."""
        callback = checked(srv_type, callback, self.warn)
        guarded = self._guarded(srv_name, callback, srv_type)
        return super().create_service(srv_type, srv_name, guarded, *args, **options)

    def create_timer(
        self, timer_period_sec: float, callback: Callback, *args: Any, **options: Any
    ) -> Timer:
        """Return a timer; `timer_period_sec`, in s, and `callback` as rclpy has them."""
        guarded = self._guarded('a timer', callback)
        return super().create_timer(timer_period_sec, guarded, *args, **options)

    def warn(self, line: str) -> None:
        """Write to the log, as `line`, what a peer did wrong, but not too often."""
        self.get_logger().warn(encodable(line), throttle_duration_sec=LOG_PERIOD)

    def _guarded(self, what: str, callback: Callback, service: Any = None) -> Callback:
        """Return a callback that raises nothing; of this type of service, or of none."""

        def told() -> contextlib.AbstractContextManager[None]:
            return exceptions_told(what, self.context, self.get_logger())

        def otherwise() -> Any:
            return None if service is None else service.Response()

        if inspect.iscoroutinefunction(callback):

            @functools.wraps(callback)
            async def call_later(*args: Any) -> Any:
                with told():
                    return await callback(*args)
                return otherwise()

            return call_later

        @functools.wraps(callback)
        def call(*args: Any) -> Any:
            with told():
                return callback(*args)
            return otherwise()

        return call
