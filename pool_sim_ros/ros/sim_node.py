"""The node: a pool table on ROS topics."""

# Some methods of rclpy's Node have no types.
# mypy: allow-untyped-calls

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import Future
from typing import Any

from geometry_msgs.msg import PoseArray, Twist
from rclpy.context import Context
from rclpy.parameter import Parameter
from std_msgs.msg import String
from std_srvs.srv import SetBool, Trigger

from pool_sim_ros.ros import commands, interface, messages
from pool_sim_ros.ros.guarded_node import GuardedNode
from pool_sim_ros.ros.late_answers import allow_late_answers
from pool_sim_ros.ros.node_options import check_options
from pool_sim_ros.ros.parameters import declare_parameters, on_change
from pool_sim_ros.ros.publishers import Publishers
from pool_sim_ros.simulator import (
    CommandLog,
    LogError,
    ParameterError,
    Response,
    Runner,
    Settings,
    Stepped,
    unreadable_request,
)


class SimNode(GuardedNode):
    """The pool table as a node, until `destroy_node`.

    Its owner spins it: the owner's executor runs the callbacks. Frames and shots have threads of
    their own. What a callback raises goes into the log, and the node goes on.

    Parameters
    ----------
    node_name : str, optional
    context, cli_args, namespace, use_global_arguments, enable_rosout, start_parameter_services, \
parameter_overrides, allow_undeclared_parameters, automatically_declare_parameters_from_overrides, \
enable_logger_service
        As rclpy's Node takes them.

    Raises
    ------
    ParameterError
        If the parameters do not make a table.
    TypeError
        For an option of a wrong type; names it.
    InvalidNodeNameException, InvalidNamespaceException
        For a bad name or namespace; of rclpy.
    """

    def __init__(
        self,
        node_name: str = interface.NODE_NAME,
        *,
        context: Context | None = None,
        cli_args: list[str] | None = None,
        namespace: str | None = None,
        use_global_arguments: bool = True,
        enable_rosout: bool = True,
        start_parameter_services: bool = True,
        parameter_overrides: list[Parameter] | None = None,
        allow_undeclared_parameters: bool = False,
        automatically_declare_parameters_from_overrides: bool = False,
        enable_logger_service: bool = False,
    ) -> None:
        options: dict[str, Any] = dict(
            context=context,
            cli_args=cli_args,
            namespace=namespace,
            use_global_arguments=use_global_arguments,
            enable_rosout=enable_rosout,
            start_parameter_services=start_parameter_services,
            parameter_overrides=parameter_overrides,
            allow_undeclared_parameters=allow_undeclared_parameters,
            enable_logger_service=enable_logger_service,
        )
        check_options(node_name, options)
        super().__init__(node_name, **options)
        try:
            settings = declare_parameters(self)
            if automatically_declare_parameters_from_overrides:
                self._declare_others()
            log = self._open_log(settings)
        except Exception:
            super().destroy_node()
            raise
        self._output = Publishers(self, settings)
        self.runner = Runner(settings, self._output, log)
        on_change(self, self.runner.apply)
        self._read_commands(len(settings.table.balls))
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

    def _read_commands(self, balls: int) -> None:
        def too_many(data: bytes) -> str | None:
            count = commands.count_poses(data)
            return None if count is None else f'{count} positions; the table has {balls} balls'

        strike, request, layout = (
            (interface.CUE_VELOCITY, commands.TWIST_BYTES),
            (interface.SHOT_REQUEST, commands.REQUEST_BYTES),
            (interface.SET_BALL_POSES, commands.layout_bytes(balls)),
        )
        self._subscribe(*strike, self._on_cue_velocity, self._refuse_request)
        self._subscribe(*request, self._on_shot_request, self._refuse_request)
        self._subscribe(*layout, self._on_set_ball_poses, self._refuse_layout, too_many)

    def _subscribe(
        self,
        topic: interface.Topic,
        most: int,
        take: Callable[[Any], None],
        *refuse: Callable[[Any], Any],
    ) -> None:
        read = commands.reader(topic.type, most, take, *refuse)
        self.create_subscription(topic.type, topic.private, read, topic.qos, raw=True)

    def _serve(self, service: interface.Service, callback: Callable[..., object]) -> None:
        allow_late_answers(self, self.create_service(service.type, service.private, callback))

    def _declare_others(self) -> None:
        """Declare what was given at start-up and is none of the node's own parameters."""
        overrides = self._parameter_overrides.items()
        for name, parameter in overrides:
            if not self.has_parameter(name):
                self.declare_parameter(name, parameter.value, ignore_override=True)

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

    def _refuse_request(self, reason: str) -> None:
        self._log(self.runner.take(unreadable_request(reason)))

    def _on_set_ball_poses(self, message: PoseArray) -> None:
        refusal = self.runner.place(messages.from_poses(message), message.header.frame_id)
        if refusal is not None:
            self.warn(f'set_ball_poses was rejected: {refusal}')

    def _refuse_layout(self, reason: str) -> None:
        self.runner.refuse(f'set_ball_poses: {reason}')
        self.warn(f'set_ball_poses was rejected: {reason}')

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

    def _on_step(self, _: Trigger.Request, response: Trigger.Response) -> Future[Trigger.Response]:
        answer: Future[Trigger.Response] = Future()

        def fill(stepped: Future[Stepped]) -> None:
            response.success, response.message = stepped.result()
            answer.set_result(response)

        self.runner.step().add_done_callback(fill)
        return answer

    def _log(self, response: Response) -> None:
        if response.reason is not None:
            self.warn(f'{response.phase.value} ({response.code.value}): {response.reason}')
