"""Services that answer later, from any thread, while the executor goes on."""

from __future__ import annotations

from concurrent.futures import Future
from typing import Any

from rclpy.service import Service

from pool_sim_ros.ros.guarded_node import exceptions_told


def allow_late_answers(node: Any, service: Service) -> None:
    """Let the callback of a service return a future of its response.

    A coroutine would keep the executor busy for as long as it waits.

    Parameters
    ----------
    node : Node
        Logs what cannot be sent.
    service : Service
    """
    send_now = service.send_response

    def send(response: Any, header: Any) -> None:
        if not isinstance(response, Future):
            send_now(response, header)
            return

        def send_result(done: Future[Any]) -> None:
            with exceptions_told(service.srv_name, node.context, node.get_logger()):
                send_now(done.result(), header)

        response.add_done_callback(send_result)

    service.send_response = send  # type: ignore[method-assign]
