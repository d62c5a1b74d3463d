"""rclpy's own services for parameters, guarded against requests over which it stumbles."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from typing import Any

from rcl_interfaces.msg import Parameter as ParameterMessage
from rcl_interfaces.msg import SetParametersResult
from rcl_interfaces.srv import (
    DescribeParameters,
    GetParameters,
    GetParameterTypes,
    ListParameters,
    SetParameters,
    SetParametersAtomically,
)
from rclpy.exceptions import ParameterNotDeclaredException
from rclpy.parameter import Parameter

MOST_NAMES = 1000
"""Parameters in one request; the node has some 30. A million would keep it busy for seconds."""

LISTS = {
    DescribeParameters: 'names',
    GetParameters: 'names',
    GetParameterTypes: 'names',
    ListParameters: 'prefixes',
    SetParameters: 'parameters',
    SetParametersAtomically: 'parameters',
}
"""Each of these services, and the field of its request that may have any length."""

TYPES = {kind.value for kind in Parameter.Type}

Callback = Callable[[Any, Any], Any]


def checked(service: Any, callback: Callback, warn: Callable[[str], None]) -> Callback:
    """Return the callback of a service for parameters that answers every request.

    Where rclpy cannot set a parameter, the result says why; in `set_parameters` the others of the
    request are set all the same.

    Parameters
    ----------
    service : type
        Of the service; the callback of one that is not in `LISTS` is returned as it is.
    callback : callable
        rclpy's.
    warn : callable
        Told in words what was refused.
    """
    if service not in LISTS:
        return callback

    def result(
        parameters: Sequence[ParameterMessage], set_them: Callable[[], SetParametersResult]
    ) -> SetParametersResult:
        reason = next(filter(None, map(why_unreadable, parameters)), '')
        if not reason:
            try:
                return set_them()
            except ParameterNotDeclaredException:
                names = ', '.join(parameter.name[:60] for parameter in parameters[:10])
                reason = f'{names}: no such parameter, or not on this table'
            except Exception as error:
                reason = f'{type(error).__name__}: {error}'
        warn(f'{service.__name__} was refused: {reason}')
        return SetParametersResult(successful=False, reason=reason)

    def set_one(parameter: ParameterMessage) -> SetParametersResult:
        request = SetParameters.Request(parameters=[parameter])
        return callback(request, SetParameters.Response()).results[0]

    def set_each(request: Any, response: Any) -> Any:
        for parameter in request.parameters:
            response.results.append(result([parameter], functools.partial(set_one, parameter)))
        return response

    def set_all(request: Any, response: Any) -> Any:
        response.result = result(request.parameters, lambda: callback(request, response).result)
        return response

    carry_out = {SetParameters: set_each, SetParametersAtomically: set_all}.get(service, callback)

    def answer(request: Any, response: Any) -> Any:
        count = len(getattr(request, LISTS[service]))
        if count <= MOST_NAMES:
            return carry_out(request, response)
        reason = f'it has {count} {LISTS[service]}; at most {MOST_NAMES} are read'
        warn(f'{service.__name__} was refused: {reason}')
        if service is SetParametersAtomically:
            response.result.reason = reason
        return response

    return answer


def why_unreadable(parameter: ParameterMessage) -> str:
    """Return why rclpy cannot read a parameter, or an empty text."""
    kind = parameter.value.type
    if kind in TYPES:
        return ''
    return f'{parameter.name[:60]!r} has a value of type {kind}; the types are 0 to {max(TYPES)}'
