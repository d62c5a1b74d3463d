"""The JSON of `~/plan/request` and `~/plan/response`: pure, without ROS."""

from __future__ import annotations

import json
import uuid
from dataclasses import dataclass, field
from enum import Enum
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.ros.oracle_error import OracleCode, OracleError
from pool_sim_ros.simulator import read_json_object

if TYPE_CHECKING:  # they load the physics
    from pool_sim_ros.oracle import Plan, RankedShot

LONGEST_REQUEST = 16_384
"""Characters of a request: a goal of 100 parts has some 8000."""

LONGEST_ID = 128
"""Characters of an id, as in `~/shot/request`."""

MOST_SHOTS = 100_000_000
"""Of a plan: more would keep all others waiting for minutes."""

MOST_COUNT = 100
"""Shots of an answer."""

NEEDED = ('goal', 'noise')
SEARCH = (*NEEDED, 'shots', 'seconds', 'seed', 'count', 'speeds', 'offset')
"""What a request may say of the search; `find_shots` has the same names."""


class PlanPhase(str, Enum):
    """How far a plan has got."""

    ACCEPTED = 'accepted'
    REJECTED = 'rejected'
    PROGRESS = 'progress'
    DONE = 'done'
    CANCELLED = 'cancelled'


LAST = (PlanPhase.REJECTED, PlanPhase.DONE, PlanPhase.CANCELLED)
"""After which a request gets no other response."""


@dataclass(frozen=True)
class PlanRequest:
    """What a client asked for.

    Attributes
    ----------
    id : str
        The client's, or a new one where it gave none.
    search : dict
        Arguments of `find_shots`; empty where it cancels.
    cancel : bool
    content : str
        Two requests have equal content exactly when they ask for the same.
    """

    id: str
    search: dict[str, Any] = field(default_factory=dict)
    cancel: bool = False
    content: str = ''


class BadPlanError(OracleError):
    """A request that cannot be carried out.

    Attributes
    ----------
    id : str or None
        Its id, None where that cannot be read.
    """

    def __init__(self, code: OracleCode, reason: str, request_id: str | None) -> None:
        super().__init__(code, reason)
        self.id = request_id


def read_plan_request(text: str) -> PlanRequest:
    """Read a request as `~/plan/request` carries it.

    Raises
    ------
    BadPlanError
        Where it is none; says what would be right. Goal and noise are not looked at yet.
    """

    def refuse(reason: str) -> BadPlanError:
        return BadPlanError(OracleCode.BAD_REQUEST, reason, request_id)

    request_id: str | None = None
    if len(text) > LONGEST_REQUEST:
        raise refuse(f'the request has {len(text)} characters; at most {LONGEST_REQUEST} are read')
    try:
        fields = read_json_object(text)
    except ValueError as error:
        raise refuse(f'{" ".join(text.split())!r:.60}: {error}') from None
    given = fields.pop('id', None)
    if given is not None and not (isinstance(given, str) and 0 < len(given) <= LONGEST_ID):
        raise refuse(f'id: must be a string of 1 to {LONGEST_ID} characters')
    request_id = given
    if 'cancel' in fields:
        if given is None or fields != {'cancel': True}:
            raise refuse('cancel: a request that cancels is {"id": "...", "cancel": true}')
        return PlanRequest(given, cancel=True)
    for name in fields:
        if name not in SEARCH:
            raise refuse(f'unknown key {name!r:.60}; the keys are id, cancel, {", ".join(SEARCH)}')
    for name in NEEDED:
        if fields.get(name) is None:
            raise refuse(f'there is no {name}; a plan needs {" and ".join(NEEDED)}')
    for name, most in (('shots', MOST_SHOTS), ('count', MOST_COUNT)):
        value = fields.get(name)
        if isinstance(value, (int, float)) and value > most:
            raise refuse(f'{name}: {value:g} must be at most {most}')
    try:
        content = json.dumps(fields, sort_keys=True)
    except RecursionError:
        raise refuse('it is nested too deeply') from None
    search = {name: value for name, value in fields.items() if value is not None}
    return PlanRequest(given or uuid.uuid4().hex, search, content=content)


def plan_response(
    request_id: str | None, phase: PlanPhase, code: OracleCode = OracleCode.OK, **more: Any
) -> str:
    """Return a response as `~/plan/response` carries it."""
    fields = {'id': request_id, 'phase': phase.value, 'code': code.value, 'reason': None, **more}
    return json.dumps(fields, allow_nan=False)


def read_plan_response(text: str) -> dict[str, Any]:
    """Return the fields of a response.

    Raises
    ------
    ValueError
        Where it is none.
    """
    fields = read_json_object(text)
    known = [phase.value for phase in PlanPhase]
    right = isinstance(fields.get('id', 0), (str, type(None))) and fields.get('phase') in known
    done = fields.get('phase') == PlanPhase.DONE.value
    if not right or (done and not isinstance(fields.get('shots'), list)):
        raise ValueError('this is no response to a request for a plan')
    return fields


def plan_fields(
    plan: Plan, labels: tuple[str, ...], positions: NDArray[np.float64]
) -> dict[str, Any]:
    """Return what the last response says of a plan.

    Parameters
    ----------
    plan : Plan
    labels : tuple of n str
        Of the balls.
    positions : ndarray of shape (n, 2)
        Where they lie, m.

    Returns
    -------
    dict
        ``shots``, best first; ``played``, ``cut``; ``positions``: label -> [x, y].
    """
    return {
        'shots': [_shot_fields(shot, labels) for shot in plan],
        'played': plan.played,
        'cut': plan.cut,
        'positions': dict(zip(labels, positions.tolist(), strict=True)),
    }


def _shot_fields(shot: RankedShot, labels: tuple[str, ...]) -> dict[str, Any]:
    def places(values: NDArray[np.float64]) -> dict[str, Any]:
        """A ball that never ends on the cloth has none."""
        return {
            label: place if np.isfinite(place).all() else None
            for label, place in zip(labels, values.tolist(), strict=True)
        }

    return {
        'velocity': shot.velocity.tolist(),
        'spin': None if shot.spin is None else shot.spin.tolist(),
        'cue': shot.cue,
        'speed': shot.speed,
        'azimuth': shot.azimuth,
        'chance': shot.chance,
        'low': shot.low,
        'high': shot.high,
        'final_positions': places(shot.mean),
        'spread': places(shot.spread),
        'caught': dict(zip(labels, shot.caught.tolist(), strict=True)),
        'failures': [failure._asdict() for failure in shot.failures],
        'shots': shot.shots,
    }
