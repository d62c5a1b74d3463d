"""A client of an oracle on the caller's own node: what to do."""

# Some methods of rclpy's Node have no types.
# mypy: allow-untyped-calls

from __future__ import annotations

import json
import uuid
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import String

from pool_sim_ros.ros import oracle_interface
from pool_sim_ros.ros.oracle_error import OracleError
from pool_sim_ros.ros.plan_json import LAST, PlanPhase, read_plan_response

if TYPE_CHECKING:  # they load the physics
    from pool_sim_ros.oracle import Goal, Noise

LOOK_PERIOD = 0.05
"""Seconds between two looks for an oracle, while there is none and something to ask."""

RESEND = 1.0
"""Seconds after which a request that is not over is sent again, with the same id: the oracle makes
one plan of it, and answers with the latest response."""


@dataclass
class _Wanted:
    request: str
    future: Future
    on_progress: Callable[[dict[str, Any]], None]


class PlanClient:
    """Asks an oracle for the shots that most likely meet a goal, from the table as it lies.

    It has no executor: futures are done while somebody spins the node.

    Parameters
    ----------
    node : Node
        The caller's; stays his.
    oracle : str, optional
        Name of the oracle, relative to the node's namespace or absolute.
    """

    def __init__(self, node: Node, oracle: str = oracle_interface.ORACLE_NAME) -> None:
        self._node = node
        asked, answer = oracle_interface.PLAN_REQUEST, oracle_interface.PLAN_RESPONSE
        self._requests = node.create_publisher(asked.type, asked.of(oracle), asked.qos)
        self._responses = node.create_subscription(
            answer.type, answer.of(oracle), self._on_response, answer.qos
        )
        self._timer = node.create_timer(RESEND, self._resend)
        self._timer.cancel()
        self._wanted: dict[str, _Wanted] = {}
        self._looking = node.create_timer(LOOK_PERIOD, self._send_first)
        self._looking.cancel()

    def is_matched(self) -> bool:
        """Return whether an oracle hears what is asked from now on, and is heard."""
        return (
            self._requests.get_subscription_count() > 0
            and self._responses.get_publisher_count() > 0
        )

    def plan(
        self,
        goal: Goal | Mapping[str, Any],
        noise: Noise | Mapping[str, float] | str,
        *,
        on_progress: Callable[[dict[str, Any]], None] = lambda response: None,
        **search: Any,
    ) -> Future:
        """Ask for a plan; what is asked before the oracle is there waits for it.

        Parameters
        ----------
        goal : Goal, or its fields
        noise : Noise, its fields, or the name of a preset
        on_progress : callable, optional
            Called with each response, as ``~/plan/response`` carries it.
        **search
            shots, seconds, seed, count, speeds, offset, as `find_shots` takes them.

        Returns
        -------
        Future
            Of rclpy. Its result is the last response: ``shots``, best first, each with velocity,
            spin, cue, chance, low, high and more. It raises OracleError where the oracle rejects
            the request, or somebody cancelled it.
        """
        request_id = uuid.uuid4().hex
        fields = {
            'id': request_id,
            'goal': goal if isinstance(goal, Mapping) else goal.fields(),
            'noise': noise if isinstance(noise, (Mapping, str)) else asdict(noise),
            **search,
        }
        wanted = _Wanted(json.dumps(fields), Future(), on_progress)
        self._wanted[request_id] = wanted
        if self.is_matched():
            self._requests.publish(String(data=wanted.request))
        else:
            self._looking.reset()
        self._timer.reset()
        return wanted.future

    def cancel(self, future: Future) -> None:
        """End the search for a plan; its `future` then raises OracleError."""
        for request_id, wanted in list(self._wanted.items()):
            if wanted.future is future:
                wanted.request = json.dumps({'id': request_id, 'cancel': True})
                self._requests.publish(String(data=wanted.request))

    def close(self) -> None:
        """Take the client off the node; futures that are not done are cancelled."""
        self._node.destroy_timer(self._timer)
        self._node.destroy_timer(self._looking)
        self._node.destroy_subscription(self._responses)
        self._node.destroy_publisher(self._requests)
        for wanted in self._wanted.values():
            wanted.future.cancel()
        self._wanted.clear()

    def _send_first(self) -> None:
        """Send what was asked before there was an oracle."""
        if self.is_matched():
            self._looking.cancel()
            self._resend()

    def _resend(self) -> None:
        for request_id, wanted in list(self._wanted.items()):  # another thread may ask meanwhile
            if wanted.future.done():
                self._wanted.pop(request_id, None)
            else:
                self._requests.publish(String(data=wanted.request))
        if not self._wanted:
            self._timer.cancel()

    def _on_response(self, message: Any) -> None:
        try:
            response = read_plan_response(message.data)
        except ValueError as error:
            line = f'not understood, and left out: {error}'
            self._node.get_logger().warn(line[:300], throttle_duration_sec=1.0)
            return
        wanted = self._wanted.get(response['id'])
        if wanted is None or wanted.future.done():
            return  # somebody else's, or answered twice
        wanted.on_progress(response)
        if response['phase'] in [phase.value for phase in LAST]:
            del self._wanted[response['id']]
            if response['phase'] == PlanPhase.DONE:
                wanted.future.set_result(response)
            else:
                why = OracleError(str(response.get('code')), str(response.get('reason')))
                wanted.future.set_exception(why)
