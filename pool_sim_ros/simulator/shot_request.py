"""The JSON of `~/shot/request` and `~/shot/response`: parsing and formatting, pure."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from enum import Enum

from pool_sim_ros.me212 import SHOT_NUMBERS
from pool_sim_ros.simulator.request_fields import (
    FieldError,
    NotFiniteError,
    cue_from,
    numbers_from,
    places_from,
    quote,
)
from pool_sim_ros.simulator.strict_json import read_json_object

Velocity = tuple[float, float]
Spin = tuple[float, float, float]

MAX_REQUEST_LENGTH = 4096
"""Characters of a request. A sensible one has at most about 250; parsing stays cheap."""

KINDS = ('shot', 'velocity', 'cue', 'place')
"""The keys of which a request has exactly one."""

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
    BAD_LAYOUT = 'BAD_LAYOUT'
    CUE_POCKETED = 'CUE_POCKETED'
    BUSY = 'BUSY'
    TOO_LONG = 'TOO_LONG'
    ID_REUSED = 'ID_REUSED'
    RESET = 'RESET'
    FAILED = 'FAILED'


@dataclass(frozen=True)
class Request:
    """What a client asked for: a strike (a report shot, a velocity, a cue), or to place balls.

    Attributes
    ----------
    id : str or None
        The client's id; None where it gave none, or an unreadable one.
    shot : int or None
        Number of a report shot.
    velocity : tuple of float or None
        (x, y) of the cue ball, m/s.
    spin : tuple of float or None
        (x, y, z) of the cue ball, with `velocity`, rad/s.
    cue : dict or None
        Arguments of `cue_strike`.
    place : dict or None
        Label -> (x, y) of the balls to place elsewhere, m.
    code : Code
        OK, or what is wrong with the request.
    reason : str or None
        The same in words.
    content : str
        Two requests have equal content exactly when they ask for the same.
    """

    id: str | None = None
    shot: int | None = None
    velocity: Velocity | None = None
    spin: Spin | None = None
    cue: dict[str, float] | None = None
    place: dict[str, Velocity] | None = None
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
    spin : tuple of float or None
        Of the cue ball, (x, y, z), rad/s; None on a table of discs.
    cue : dict or None
        What was asked of the cue.
    place : dict or None
        Label -> [x, y] of the balls that were to be placed, m.
    pocketed : dict or None
        Label -> number of the pocket of each ball that lies in one at the end; None on a table of
        discs.
    """

    id: str | None
    phase: Phase
    code: Code = Code.OK
    reason: str | None = None
    shot: int | None = None
    velocity: Velocity | None = None
    integrator: str | None = None
    t_start: float | None = None
    t_end: float | None = None
    events: int | None = None
    final_positions: dict[str, list[float]] | None = None
    final_positions_in: dict[str, list[float]] | None = None
    as_printed: bool | None = None
    spin: Spin | None = None
    cue: dict[str, float] | None = None
    place: dict[str, Velocity] | None = None
    pocketed: dict[str, int] | None = None

    def to_json(self) -> str:
        """Return the response as `~/shot/response` carries it."""
        return json.dumps(asdict(self), allow_nan=False)


def parse_request(text: str) -> Request:
    """Read a request as `~/shot/request` carries it.

    Parameters
    ----------
    text : str
        ``1`` to ``4``, or JSON like ``{"id": "...", "shot": 3}``; instead of `shot` it may have
        `velocity`, and with it `spin`, or `cue`, or `place`.

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
            f'{quote(text)} is neither a shot number, 1 to 4, nor a JSON object: {error}', text
        )
    return _parse_fields(fields, text)


def unreadable_request(reason: str) -> Request:
    """Return the request that stands for a message that nobody could read."""
    return _bad(reason)


def twist_request(
    linear: Sequence[float], angular: Sequence[float], spins: bool = False
) -> Request:
    """Turn a twist of the cue ball into a request.

    Parameters
    ----------
    linear, angular : sequence of 3 floats
        m/s and rad/s; z of linear must be 0.
    spins : bool, optional
        Whether balls of the table spin; otherwise angular must be 0 too.
    """
    names = ('linear.z', 'angular.x', 'angular.y', 'angular.z')
    values = (linear[2], *(() if spins else angular))
    for name, value in zip(names, values, strict=False):
        if value != 0.0:
            only = 'linear.x and linear.y' + (', and angular' if spins else '')
            return Request(
                code=Code.BAD_VELOCITY,
                reason=f'{name} is {value:g}; a ball on the table has {only} only',
            )
    spin = (angular[0], angular[1], angular[2]) if spins else None
    return _velocity(None, linear[0], linear[1], spin)


def _parse_fields(fields: dict[str, object], text: str) -> Request:
    request_id: str | None = None
    if 'id' in fields:
        given = fields['id']
        if not isinstance(given, str) or not 0 < len(given) <= MAX_ID_LENGTH:
            return _bad(f'id must be a string of 1 to {MAX_ID_LENGTH} characters', text)
        request_id = given
    unknown = sorted(set(fields) - {'id', 'spin', *KINDS})
    if unknown:
        keys = 'id, shot, velocity, spin, cue and place'
        return _bad(f'unknown key {quote(unknown[0])}; the keys are {keys}', text, request_id)
    kinds = [name for name in KINDS if name in fields]
    if 'spin' in fields and kinds != ['velocity']:
        return _bad('spin goes with velocity, and with nothing else', text, request_id)
    if len(kinds) != 1:
        return _bad('give either shot or velocity, or cue, or place', text, request_id)
    try:
        return _parse_kind(kinds[0], fields, request_id)
    except FieldError as error:
        return _bad(str(error), text, request_id)


def _parse_kind(kind: str, fields: dict[str, object], request_id: str | None) -> Request:
    """Read the one field that says what is asked for; raise FieldError for a wrong form."""
    value = fields[kind]
    if kind == 'shot':
        if type(value) is not int:
            raise FieldError('shot must be an integer, 1 to 4')
        return _report_shot(request_id, str(value))
    if kind == 'velocity':
        vx, vy = numbers_from('velocity', value, 'xy', 'm/s')
        if 'spin' not in fields:
            return _velocity(request_id, vx, vy)
        wx, wy, wz = numbers_from('spin', fields['spin'], 'xyz', 'rad/s')
        return _velocity(request_id, vx, vy, (wx, wy, wz))
    content = f'{kind} {json.dumps(value, sort_keys=True)}'
    code = Code.BAD_VELOCITY if kind == 'cue' else Code.BAD_LAYOUT
    try:
        if kind == 'cue':
            return Request(id=request_id, cue=cue_from(value), content=content)
        return Request(id=request_id, place=places_from(value), content=content)
    except NotFiniteError as error:
        return Request(id=request_id, code=code, reason=str(error), content=content)


def _report_shot(request_id: str | None, digits: str) -> Request:
    content = f'shot {digits}'
    known = {str(number): number for number in SHOT_NUMBERS}
    if digits not in known:
        first, last = min(SHOT_NUMBERS), max(SHOT_NUMBERS)
        return Request(
            id=request_id,
            code=Code.UNKNOWN_SHOT,
            reason=f'there is no shot {quote(digits)}; the report has {first} to {last}',
            content=content,
        )
    return Request(id=request_id, shot=known[digits], content=content)


def _velocity(request_id: str | None, x: float, y: float, spin: Spin | None = None) -> Request:
    content = f'velocity {x!r} {y!r}' + ('' if spin is None else f' spin {spin!r}')
    reason = None
    if not (math.isfinite(x) and math.isfinite(y)):
        reason = f'the velocity [{x:g}, {y:g}] is not finite'
    elif spin is not None and not all(map(math.isfinite, spin)):
        reason = f'the spin [{", ".join(f"{w:g}" for w in spin)}] is not finite'
    elif x == 0.0 and y == 0.0 and not any(spin or ()):
        reason = 'the velocity is zero; the cue ball would not move'
    if reason:
        return Request(id=request_id, code=Code.BAD_VELOCITY, reason=reason, content=content)
    return Request(id=request_id, velocity=(x, y), spin=spin, content=content)


def _bad(reason: str, text: str = '', request_id: str | None = None) -> Request:
    return Request(id=request_id, code=Code.BAD_REQUEST, reason=reason, content=f'bad {text}')
