"""The node: a pool table on ROS topics."""

# Some methods of rclpy's Node have no types.
# mypy: allow-untyped-calls

from __future__ import annotations

import os
from collections.abc import Callable

from geometry_msgs.msg import PoseArray, Twist
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_msgs.msg import String
from std_srvs.srv import SetBool, Trigger

from pool_sim_ros.ros import interface, messages
from pool_sim_ros.ros.parameters import declare_parameters, on_change
from pool_sim_ros.ros.publishers import Publishers
from pool_sim_ros.simulator import (
    CommandLog,
    LogError,
    ParameterError,
    Response,
    Runner,
    Settings,
)

LOG_PERIOD = 0.1
"""Seconds between two warnings in the log; this delays no response."""


class SimNode(Node):
    """The pool table as a node, until `destroy_node`.

    Its owner spins it: the owner's executor runs the callbacks. Frames and shots have threads of
    their own.

    Parameters
    ----------
    context : Context, optional
    parameter_overrides : list of Parameter, optional
    node_name : str, optional

    Raises
    ------
    ParameterError
        If the parameters do not make a table.
    """

    def __init__(
        self,
        *,
        context: Context | None = None,
        parameter_overrides: list[Parameter] | None = None,
        node_name: str = interface.NODE_NAME,
    ) -> None:
        super().__init__(node_name, context=context, parameter_overrides=parameter_overrides)
        try:
            settings = declare_parameters(self)
            log = self._open_log(settings)
        except Exception:
            super().destroy_node()
            raise
        self._output = Publishers(self, settings)
        self.runner = Runner(settings, self._output, log)
        on_change(self, self.runner.apply)
        self._subscribe(interface.CUE_VELOCITY, self._on_cue_velocity)
        self._subscribe(interface.SHOT_REQUEST, self._on_shot_request)
        self._subscribe(interface.SET_BALL_POSES, self._on_set_ball_poses)
        self._serve(interface.RESET, self._on_reset)
        self._serve(interface.SET_PAUSED, self._on_set_paused)
        self._serve(interface.STEP, self._on_step)

    @property
    def failed(self) -> bool:
        """Whether a thread failed, which also shuts the context down."""
        return self._output.failed

    def destroy_node(self) -> None:
        """Stop the threads and leave ROS; this does not wait for a shot that is being computed."""
        self.runner.stop(0.0)
        super().destroy_node()

    def _subscribe(self, topic: interface.Topic, callback: Callable[..., None]) -> None:
        self.create_subscription(topic.type, topic.private, callback, topic.qos)

    def _serve(self, service: interface.Service, callback: Callable[..., object]) -> None:
        self.create_service(service.type, service.private, callback)

    def _open_log(self, settings: Settings) -> CommandLog | None:
        if not settings.record:
            return None
        try:
            path = os.path.expanduser(settings.record)
            return CommandLog(path, settings, self.get_logger().error)
        except LogError as error:
            raise ParameterError(f'record: {error}') from error

    def _on_cue_velocity(self, message: Twist) -> None:
        self._log(self.runner.strike(*messages.from_twist(message)))

    def _on_shot_request(self, message: String) -> None:
        self._log(self.runner.request(message.data))

    def _on_set_ball_poses(self, message: PoseArray) -> None:
        refusal = self.runner.place(messages.from_poses(message), message.header.frame_id)
        if refusal is not None:
            self._warn(f'set_ball_poses was rejected: {refusal}')

    def _on_reset(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        preempted = self.runner.reset()
        response.success = True
        shot = ', the shot in hand was preempted' if preempted else ''
        response.message = f'the balls are back on the start layout{shot}'
        return response

    def _on_set_paused(
        self, request: SetBool.Request, response: SetBool.Response
    ) -> SetBool.Response:
        self.runner.set_paused(request.data)
        response.success = True
        response.message = 'paused' if request.data else 'playing'
        return response

    def _on_step(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        response.success, response.message = self.runner.step()
        return response

    def _log(self, response: Response) -> None:
        if response.reason is not None:
            self._warn(f'{response.phase.value} ({response.code.value}): {response.reason}')

    def _warn(self, line: str) -> None:
        self.get_logger().warn(line, throttle_duration_sec=LOG_PERIOD)
