"""A client of an oracle on the caller's own node: what if."""

# Some methods of rclpy's Node have no types.
# mypy: allow-untyped-calls

from __future__ import annotations

import math
import random
import time
from dataclasses import dataclass
from typing import Any

from numpy.typing import ArrayLike
from rclpy.node import Node
from rclpy.task import Future

from pool_sim_ros.ros import oracle_interface
from pool_sim_ros.ros.large_blocks import keep_large_blocks
from pool_sim_ros.ros.oracle_error import OracleError
from pool_sim_ros.ros.point_cloud import Stamp
from pool_sim_ros.ros.what_if_rows import answer_from, request_bytes
from pool_sim_ros.simulator import read_json_object

LOOK_PERIOD = 0.05
"""Seconds between two looks for an oracle, while there is none and something to ask."""

KNOCK_PERIOD = 0.25
"""Seconds between two tries of one candidate, until one is answered: only then both sides know each
other, and no answer is lost."""

RESEND = 10.0
"""Seconds without any answer after which questions are sent again: an oracle was restarted, or only
somebody else listened. An answer depends on nothing but the question and the layout."""


@dataclass
class _Asked:
    message: bytes
    future: Future
    sent: float | None = None


class WhatIfClient:
    """Asks an oracle what comes of candidates, from the table as it lies.

    It has no executor: futures are done while somebody spins the node.

    Parameters
    ----------
    node : Node
        The caller's; stays his.
    oracle : str, optional
        Name of the oracle, relative to the node's namespace or absolute.
    frame_id : str, optional
        Frame of the simulator's table.
    """

    def __init__(
        self, node: Node, oracle: str = oracle_interface.ORACLE_NAME, *, frame_id: str = 'table'
    ) -> None:
        keep_large_blocks()
        self._node, self._frame_id = node, frame_id
        asked, answer, rejected = (
            oracle_interface.WHAT_IF_REQUEST,
            oracle_interface.WHAT_IF_RESPONSE,
            oracle_interface.WHAT_IF_REJECTED,
        )
        self._requests = node.create_publisher(asked.type, asked.of(oracle), asked.qos)
        self._responses = node.create_subscription(
            answer.type, answer.of(oracle), self._on_answer, answer.qos, raw=True
        )
        self._rejections = node.create_subscription(
            rejected.type, rejected.of(oracle), self._on_rejected, rejected.qos
        )
        self._timer = node.create_timer(LOOK_PERIOD, self._send_waiting)
        self._timer.cancel()
        self._asked: dict[Stamp, _Asked] = {}
        self._knocks: set[Stamp] = set()
        self._heard = False
        self._knocked = -math.inf
        self._last_answer = 0.0

    def _is_matched(self) -> bool:
        """Return whether this side knows an oracle; it may not know this side yet."""
        return (
            self._requests.get_subscription_count() > 0
            and self._responses.get_publisher_count() > 0
            and self._rejections.get_publisher_count() > 0
        )

    def ask(self, candidates: ArrayLike) -> Future:
        """Ask what comes of candidates; what is asked before the oracle is there waits for it.

        Parameters
        ----------
        candidates : array_like of shape (m, 2) or (m, 5)
            Velocities of the cue ball, m/s, and where balls spin its spins, rad/s; at most 50,000.

        Returns
        -------
        Future
            Of rclpy. Its result is a `WhatIf`. It raises OracleError where the oracle rejects the
            question, as it does while balls move.

        Raises
        ------
        ValueError
            For a wrong shape, no candidates, or too many.
        """
        stamp = _new_stamp()
        asked = _Asked(request_bytes(stamp, self._frame_id, candidates), Future())
        self._asked[stamp] = asked
        if self._heard and self._is_matched():
            self._send(asked)
        else:
            self._heard = False
        self._timer.reset()
        return asked.future

    def close(self) -> None:
        """Take the client off the node; futures that are not done are cancelled."""
        self._node.destroy_timer(self._timer)
        self._node.destroy_subscription(self._responses)
        self._node.destroy_subscription(self._rejections)
        self._node.destroy_publisher(self._requests)
        for asked in self._asked.values():
            asked.future.cancel()
        self._asked.clear()

    def _send(self, asked: _Asked) -> None:
        asked.sent = time.monotonic()
        self._requests.publish(asked.message)

    def _knock(self) -> None:
        if time.monotonic() - self._knocked > KNOCK_PERIOD:
            self._knocked = time.monotonic()
            stamp = _new_stamp()
            self._knocks.add(stamp)
            self._requests.publish(request_bytes(stamp, self._frame_id, [(0.0, 0.0)]))

    def _opened(self) -> None:
        """Ask what waits, now that the oracle has answered."""
        self._heard = True
        self._knocks.clear()
        for asked in list(self._asked.values()):
            if asked.sent is None:
                self._send(asked)

    def _send_waiting(self) -> None:
        for stamp, asked in list(self._asked.items()):  # another thread may ask meanwhile
            if asked.future.cancelled():
                self._asked.pop(stamp, None)
        if not self._asked:
            self._timer.cancel()
        elif not self._is_matched():
            self._heard = False
        elif not self._heard:
            self._knock()
        else:
            late = time.monotonic() - RESEND
            for asked in list(self._asked.values()):
                if asked.sent is None or max(asked.sent, self._last_answer) < late:
                    self._send(asked)

    def _on_answer(self, message: bytes) -> None:
        try:
            stamp, outcomes = answer_from(message)
        except ValueError as error:
            self._leave_out(error)
            return
        if stamp in self._knocks:
            self._opened()
        if outcomes is not None:  # a rejection comes on a topic of its own, with its reason
            self._end(stamp, outcomes)

    def _on_rejected(self, message: Any) -> None:
        try:
            fields = read_json_object(message.data)
            seconds, nanoseconds = fields['stamp']
            error = OracleError(str(fields['code']), str(fields['reason']))
            self._end((seconds, nanoseconds), error)
        except (KeyError, TypeError, ValueError) as error:
            self._leave_out(error)

    def _end(self, stamp: Stamp, result: Any) -> None:
        asked = self._asked.pop(stamp, None)
        if asked is None or asked.future.done():
            return  # somebody else's, or answered twice
        self._last_answer = time.monotonic()
        if isinstance(result, OracleError):
            asked.future.set_exception(result)
        else:
            asked.future.set_result(result)

    def _leave_out(self, error: Exception) -> None:
        line = f'not understood, and left out: {type(error).__name__}: {error}'
        self._node.get_logger().warn(line[:300], throttle_duration_sec=1.0)


def _new_stamp() -> Stamp:
    return random.getrandbits(31), random.randrange(1_000_000_000)
