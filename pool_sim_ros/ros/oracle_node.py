"""The node that answers what if, and what to do: a client of one simulator."""

# Some methods of rclpy's Node have no types.
# mypy: allow-untyped-calls

from __future__ import annotations

import json
import threading
from typing import Any

from rcl_interfaces.msg import ParameterDescriptor
from rclpy.context import Context
from rclpy.parameter import Parameter
from rclpy.publisher import Publisher
from std_msgs.msg import String

from pool_sim_ros.oracle import Cluster, ClusterError, Plan, what_if
from pool_sim_ros.physics import Table, compile_kernels
from pool_sim_ros.ros import commands, interface, messages, oracle_interface
from pool_sim_ros.ros.guarded_node import GuardedNode
from pool_sim_ros.ros.large_blocks import keep_large_blocks
from pool_sim_ros.ros.oracle_error import OracleCode, OracleError
from pool_sim_ros.ros.plan_desk import PlanDesk
from pool_sim_ros.ros.plan_json import LONGEST_REQUEST
from pool_sim_ros.ros.plan_markers import no_markers, plan_markers
from pool_sim_ros.ros.point_cloud import read_stamp
from pool_sim_ros.ros.simulator_view import Lying, SimulatorView
from pool_sim_ros.ros.what_if_rows import answer_bytes, candidates_from, no_answer_bytes

LOOK_PERIOD = 0.2
"""Seconds between two looks for a new table, whose engine is then compiled."""

PLAN_BYTES = commands.HEAD_BYTES + 4 * LONGEST_REQUEST
"""Bytes of a request for a plan: a character has at most four in UTF-8."""


class OracleNode(GuardedNode):
    """The oracle as a node, until `destroy_node`.

    Its owner spins it. What-ifs are answered in the callback; plans are made in a thread of their
    own. Several may look at one simulator, each under a name of its own.

    Parameters
    ----------
    node_name : str, optional
    simulator : str, optional
        Name of the simulator, relative to the namespace of this process or absolute.
    threads : int, optional
        At most so many threads play; by default one for each core.
    context : Context, optional
    parameter_overrides : list of Parameter, optional
        As rclpy's Node takes them. The parameter `scheduler` is the address of a Dask cluster that
        plays instead of this process.

    Raises
    ------
    ClusterError
        Where the scheduler does not answer.
    """

    def __init__(
        self,
        node_name: str = oracle_interface.ORACLE_NAME,
        *,
        simulator: str = interface.NODE_NAME,
        threads: int | None = None,
        context: Context | None = None,
        parameter_overrides: list[Parameter] | None = None,
    ) -> None:
        # Without services: an executor looks at each of them before every answer.
        super().__init__(
            node_name,
            context=context,
            start_parameter_services=False,
            parameter_overrides=[
                Parameter('start_type_description_service', value=False),
                *(parameter_overrides or []),
            ],
        )
        try:
            self._cluster = self._connected()
        except Exception:
            super().destroy_node()
            raise
        keep_large_blocks()
        self._threads = threads
        self._view = SimulatorView(self.context, simulator, 'oracle_view')
        self._table: Table | None = None
        self._compiled = False
        self._drawing = threading.Lock()
        self._drawn: Lying | None = None
        self._answers = self._publisher(oracle_interface.WHAT_IF_RESPONSE)
        self._rejections = self._publisher(oracle_interface.WHAT_IF_REJECTED)
        self._plans = self._publisher(oracle_interface.PLAN_RESPONSE)
        self._markers = self._publisher(oracle_interface.PLAN_MARKERS)
        self._desk = PlanDesk(self._send_plan, self._view.lying, self._draw, threads, self._cluster)
        asked = oracle_interface.WHAT_IF_REQUEST
        self.create_subscription(asked.type, asked.private, self._on_what_if, asked.qos, raw=True)
        wanted = oracle_interface.PLAN_REQUEST
        read = commands.reader(wanted.type, PLAN_BYTES, self._on_plan, self._desk.refuse)
        self.create_subscription(wanted.type, wanted.private, read, wanted.qos, raw=True)
        self.create_timer(LOOK_PERIOD, self._look)

    def is_ready(self) -> bool:
        """Return whether it knows the table, and its engine is compiled."""
        return self._compiled

    def stop(self, timeout: float) -> bool:
        """Return whether the plan in the making ended within `timeout` s; make no other."""
        return self._desk.close(timeout)

    def destroy_node(self) -> None:
        """Leave ROS; this does not wait for a plan that is in the making."""
        self._desk.close(0.0)
        self._view.close()
        if self._cluster is not None:
            self._cluster.close()
        super().destroy_node()

    def _connected(self) -> Cluster | None:
        words = 'address of a Dask scheduler, like tcp://host:8786, whose workers play; empty: none'
        descriptor = ParameterDescriptor(description=words, read_only=True)
        address = self.declare_parameter('scheduler', '', descriptor).value
        return Cluster(address) if address else None

    def _publisher(self, topic: interface.Topic) -> Publisher:
        return self.create_publisher(topic.type, topic.private, topic.publisher_qos)

    def _look(self) -> None:
        """Compile the engine of a new table; take down the markers of how balls lay before."""
        table = self._view.table()
        if table is not None and table != self._table:
            self._table = table
            compile_kernels(table)
            self._compiled = True
            self.get_logger().info(f'ready: {self._view.simulator}, {len(table.balls)} balls')
        drawn = self._drawn
        if drawn is not None and self._view.has_changed(drawn):
            with self._drawing:
                if self._drawn is drawn:
                    self._drawn = None
                    self._markers.publish(no_markers(self._view.frame_id))

    def _on_what_if(self, message: bytes) -> None:
        stamp = read_stamp(message)
        try:
            candidates = candidates_from(message, self._view.frame_id)
            table, positions = self._view.lying()
            try:
                outcomes = what_if(
                    table,
                    candidates,
                    positions=positions,
                    threads=self._threads,
                    cluster=self._cluster,
                )
            except ValueError as error:
                raise OracleError(OracleCode.BAD_CANDIDATE, str(error)) from None
            except ClusterError as error:
                raise OracleError(OracleCode.FAILED, str(error)) from None
        except OracleError as error:
            fields = {'stamp': list(stamp), 'code': error.code, 'reason': error.reason}
            self._rejections.publish(String(data=json.dumps(fields)))
            self._answers.publish(no_answer_bytes(stamp, self._view.frame_id))
            self.warn(f'what_if was rejected: {error}')
            return
        self._answers.publish(answer_bytes(stamp, self._view.frame_id, table, outcomes))

    def _on_plan(self, message: Any) -> None:
        self._desk.take(message.data)

    def _send_plan(self, text: str) -> None:
        if self.context.ok():
            self._plans.publish(messages.to_string(text))

    def _draw(self, plan: Plan, lying: Lying) -> None:
        markers = plan_markers(plan, lying, self._view.frame_id)
        with self._drawing:
            if self.context.ok():
                self._markers.publish(markers)
                self._drawn = lying
