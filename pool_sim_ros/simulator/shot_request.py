"""The JSON of `~/shot/request` and `~/shot/response`: parsing and formatting, pure."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from enum import Enum

from pool_sim_ros.me212 import SHOT_NUMBERS
from pool_sim_ros.simulator.strict_json import read_json_object

MAX_REQUEST_LENGTH = 4096
"""Characters of a request. A sensible one has at most about 250; parsing stays cheap."""

MAX_ID_LENGTH = 128
"""Characters of an id: enough for any UUID or URN; it bounds the memory of the request history."""


class Phase(str, Enum):
    """How far a request has got."""

    ACCEPTED = 'accepted'
    REJECTED = 'rejected'
    DONE = 'done'
    PREEMPTED = 'preempted'


class Code(str, Enum):
    """Why a response is as it is."""

    OK = 'OK'
    BAD_REQUEST = 'BAD_REQUEST'
    UNKNOWN_SHOT = 'UNKNOWN_SHOT'
    BAD_VELOCITY = 'BAD_VELOCITY'
    TOO_FAST = 'TOO_FAST'
    BUSY = 'BUSY'
    TOO_LONG = 'TOO_LONG'
    ID_REUSED = 'ID_REUSED'
    RESET = 'RESET'
    FAILED = 'FAILED'


@dataclass(frozen=True)
class Request:
    """What a client asked for: a report shot, or a velocity of the cue ball.

    Attributes
    ----------
    id : str or None
        The client's id; None where it gave none, or an unreadable one.
    shot : int or None
        Number of a report shot.
    velocity : tuple of float or None
        (x, y) of the cue ball, m/s.
    code : Code
        OK, or what is wrong with the request.
    reason : str or None
        The same in words.
    content : str
        Two requests have equal content exactly when they ask for the same.
    """

    id: str | None = None
    shot: int | None = None
    velocity: tuple[float, float] | None = None
    code: Code = Code.OK
    reason: str | None = None
    content: str = ''


@dataclass(frozen=True)
class Response:
    """One response; a field that does not apply is None.

    Attributes
    ----------
    id : str or None
        The request's; None where it could not be read.
    phase : Phase
    code : Code
    reason : str or None
        Why, in words.
    shot : int or None
        Number of the report shot.
    velocity : tuple of float or None
        Of the cue ball, (x, y), m/s.
    integrator : str or None
        The one that computes the shot.
    t_start, t_end : float or None
        Sim time at which the balls start and at which the last one stops, s.
    events : int or None
        How many contacts and stops the shot had.
    final_positions : dict or None
        Label -> [x, y], m.
    final_positions_in : dict or None
        Label -> [x, y], inches to two decimals, as the report's log has them.
    as_printed : bool or None
        For a report shot: whether table, integrator and slice are the report's, so that the
        final positions are the printed ones.
    """

    id: str | None
    phase: Phase
    code: Code = Code.OK
    reason: str | None = None
    shot: int | None = None
    velocity: tuple[float, float] | None = None
    integrator: str | None = None
    t_start: float | None = None
    t_end: float | None = None
    events: int | None = None
    final_positions: dict[str, list[float]] | None = None
    final_positions_in: dict[str, list[float]] | None = None
    as_printed: bool | None = None

    def to_json(self) -> str:
        """Return the response as `~/shot/response` carries it."""
        return json.dumps(asdict(self), allow_nan=False)


def parse_request(text: str) -> Request:
    """Read a request as `~/shot/request` carries it.

    Parameters
    ----------
    text : str
        ``1`` to ``4``, or JSON ``{"id": "...", "shot": 3}`` or
        ``{"id": "...", "velocity": [-4.0, 0.0]}``.

    Returns
    -------
    Request
        With a `code` other than OK where it cannot be carried out.
    """
    if len(text) > MAX_REQUEST_LENGTH:
        return _bad(
            f'the request has {len(text)} characters; at most {MAX_REQUEST_LENGTH} are read'
        )
    text = text.strip()
    if re.fullmatch(r'[+-]?[0-9]+', text):
        return _report_shot(None, text.lstrip('+'))
    try:
        # Any number is answered as what it is: no shot has so many digits.
        fields = read_json_object(text, MAX_REQUEST_LENGTH)
    except ValueError as error:
        return _bad(
            f'{_quote(text)} is neither a shot number, 1 to 4, nor a JSON object: {error}', text
        )
    return _parse_fields(fields, text)


def unreadable_request(reason: str) -> Request:
    """Return the request that stands for a message that nobody could read."""
    return _bad(reason)


def twist_request(linear: Sequence[float], angular: Sequence[float]) -> Request:
    """Turn a twist of the cue ball into a request.

    Parameters
    ----------
    linear, angular : sequence of 3 floats
        m/s and rad/s; only linear x and y may be other than 0.
    """
    names = ('linear.z', 'angular.x', 'angular.y', 'angular.z')
    for name, value in zip(names, (linear[2], *angular), strict=True):
        if value != 0.0:
            return Request(
                code=Code.BAD_VELOCITY,
                reason=f'{name} is {value:g}; a ball on the table has linear.x and linear.y only',
            )
    return _velocity(None, linear[0], linear[1])


def _parse_fields(fields: dict[str, object], text: str) -> Request:
    request_id: str | None = None
    if 'id' in fields:
        given = fields['id']
        if not isinstance(given, str) or not 0 < len(given) <= MAX_ID_LENGTH:
            return _bad(f'id must be a string of 1 to {MAX_ID_LENGTH} characters', text)
        request_id = given
    unknown = sorted(set(fields) - {'id', 'shot', 'velocity'})
    if unknown:
        reason = f'unknown key {_quote(unknown[0])}; the keys are id, shot and velocity'
        return _bad(reason, text, request_id)
    if ('shot' in fields) == ('velocity' in fields):
        return _bad('give either shot or velocity', text, request_id)
    if 'shot' in fields:
        shot = fields['shot']
        if type(shot) is not int:
            return _bad('shot must be an integer, 1 to 4', text, request_id)
        return _report_shot(request_id, str(shot))
    velocity = fields['velocity']
    if not (isinstance(velocity, list) and len(velocity) == 2 and all(map(_is_number, velocity))):
        return _bad('velocity must be two numbers, [x, y] in m/s', text, request_id)
    return _velocity(request_id, *map(_float, velocity))


def _report_shot(request_id: str | None, digits: str) -> Request:
    content = f'shot {digits}'
    known = {str(number): number for number in SHOT_NUMBERS}
    if digits not in known:
        first, last = min(SHOT_NUMBERS), max(SHOT_NUMBERS)
        return Request(
            id=request_id,
            code=Code.UNKNOWN_SHOT,
            reason=f'there is no shot {_quote(digits)}; the report has {first} to {last}',
            content=content,
        )
    return Request(id=request_id, shot=known[digits], content=content)


def _velocity(request_id: str | None, x: float, y: float) -> Request:
    content = f'velocity {x!r} {y!r}'
    reason = None
    if not (math.isfinite(x) and math.isfinite(y)):
        reason = f'the velocity [{x:g}, {y:g}] is not finite'
    elif x == 0.0 and y == 0.0:
        reason = 'the velocity is zero; the cue ball would not move'
    if reason:
        return Request(id=request_id, code=Code.BAD_VELOCITY, reason=reason, content=content)
    return Request(id=request_id, velocity=(x, y), content=content)


def _bad(reason: str, text: str = '', request_id: str | None = None) -> Request:
    return Request(id=request_id, code=Code.BAD_REQUEST, reason=reason, content=f'bad {text}')


def _is_number(value: object) -> bool:
    return type(value) in (int, float)


def _float(number: float) -> float:
    try:
        return float(number)
    except OverflowError:
        return math.inf if number > 0 else -math.inf


def _quote(text: str, limit: int = 40) -> str:
    return json.dumps(text if len(text) <= limit else text[:limit] + '...')
