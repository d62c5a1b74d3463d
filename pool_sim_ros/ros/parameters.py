"""The node's parameters in ROS: their declaration, and what happens when they change."""

from __future__ import annotations

from collections.abc import Callable

from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    SetParametersResult,
)
from rclpy.node import Node
from rclpy.parameter import Parameter

from pool_sim_ros.simulator import (
    PARAMETERS,
    Change,
    ParameterError,
    ParameterSpec,
    ParameterValue,
    Settings,
    build_settings,
    coerce,
    near_misses,
    parameters_of,
    values_from,
)


def declare_parameters(node: Node) -> Settings:
    """Check the values that were given at start-up, and declare all parameters with them.

    A name that is nearly one of ours is warned of in the log of the node.

    Raises
    ------
    ParameterError
        If they do not make a table; then nothing is declared.
    """
    # A misspelt name is only here: rclpy has no public access to overrides of what is undeclared.
    overrides = {name: parameter.value for name, parameter in node._parameter_overrides.items()}
    values = values_from(overrides)
    settings = build_settings(values)
    for name, ours in near_misses(overrides).items():
        node.get_logger().warn(f'{name} is not a parameter of this node; did you mean {ours}?')
    specs = parameters_of(settings.table.motion)
    node.declare_parameters(
        '',
        [(name, _declarable(values[name]), describe(spec)) for name, spec in specs.items()],
        ignore_override=True,
    )
    return settings


def describe(spec: ParameterSpec) -> ParameterDescriptor:
    """Return the descriptor of a parameter."""
    descriptor = ParameterDescriptor(
        name=spec.name,
        description=f'{spec.doc} ({spec.change.value})',
        read_only=spec.change is Change.NEVER,
        additional_constraints=' or '.join(spec.choices),
    )
    if isinstance(spec.default, float):
        if spec.smallest:
            descriptor.additional_constraints = f'0, or at least {spec.smallest:g}'
        bounds = FloatingPointRange(from_value=float(spec.least), to_value=float(spec.most))
        descriptor.floating_point_range = [bounds]
    elif isinstance(spec.default, int) and not isinstance(spec.default, bool):
        bounds = IntegerRange(from_value=int(spec.least), to_value=int(spec.most), step=1)
        descriptor.integer_range = [bounds]
    return descriptor


def on_change(node: Node, apply: Callable[[Settings], None]) -> None:
    """Check every later change, and call `apply` with the settings after it."""

    names = parameters_of(node.get_parameter('table.motion').value)
    empty = Parameter('', value=[])

    def settings_with(parameters: list[Parameter]) -> Settings:
        values = {name: node.get_parameter_or(name, empty).value for name in names}
        for parameter in parameters:
            if parameter.name in names:
                values[parameter.name] = coerce(parameter.name, parameter.value)
        return build_settings({name: coerce(name, value) for name, value in values.items()})

    def in_their_own_types(parameters: list[Parameter]) -> list[Parameter]:
        return [_as_declared(parameter) for parameter in parameters]

    def check(parameters: list[Parameter]) -> SetParametersResult:
        try:
            settings_with(parameters)
        except ParameterError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def changed(parameters: list[Parameter]) -> None:
        if any(parameter.name in names for parameter in parameters):
            apply(settings_with([]))

    node.add_pre_set_parameters_callback(in_their_own_types)
    node.add_on_set_parameters_callback(check)
    node.add_post_set_parameters_callback(changed)


def _declarable(value: ParameterValue) -> ParameterValue | Parameter.Type:
    """Return a value as rclpy declares it: it takes an empty list for one of bytes."""
    return Parameter.Type.DOUBLE_ARRAY if value == [] else value


def _as_declared(parameter: Parameter) -> Parameter:
    if parameter.name not in PARAMETERS:
        return parameter
    try:
        return Parameter(parameter.name, value=coerce(parameter.name, parameter.value))
    except ParameterError:
        return parameter  # it is refused, with the reason, once all were looked at
