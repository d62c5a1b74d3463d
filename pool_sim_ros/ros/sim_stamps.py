"""The sim time at which a simulator sent what a recorder heard: pure, and of any speed."""

from __future__ import annotations

import json
import struct
from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from typing import Any, NamedTuple

from rclpy.serialization import deserialize_message

from pool_sim_ros.ros import interface
from pool_sim_ros.simulator import SECOND_NS

CLOCK_SLACK = SECOND_NS
"""Time in ns by which a clock may be before the first poses or after the last; one that is further
off is of some other simulator."""

_HEAD = 4
"""Bytes before a serialised message itself (CDR encapsulation)."""


class Heard(NamedTuple):
    """A message: when it was sent by its sender's wall clock (ns), topic, full name, CDR bytes."""

    sent: int
    topic: interface.Topic
    name: str
    data: bytes


class Recorded(NamedTuple):
    """A message: when it was sent in sim time (ns), topic, full name of the topic, CDR bytes."""

    time: int
    topic: interface.Topic
    name: str
    data: bytes


def in_sim_time(heard: Sequence[Heard]) -> list[Recorded]:
    """Return messages with the sim time at which they were sent, in that order.

    The balls' poses have a stamp. Messages of the same tick were sent just before (clock,
    collisions) or after them; any other message belongs to the latest tick before it, and what was
    latched earlier to the first tick. A request comes no later than the answer to it, though the
    clock of its sender may be wrong.

    Parameters
    ----------
    heard : sequence of Heard
        In any order; without poses the result is empty.
    """
    sent = sorted(heard, key=lambda message: message.sent)
    poses = [(place, _stamp(m)) for place, m in enumerate(sent) if m.topic is interface.BALL_POSES]
    places = [place for place, stamp in poses if stamp is not None]
    stamps = [stamp for _, stamp in poses if stamp is not None]
    if not stamps:
        return []
    recorded = []
    for place, message in enumerate(sent):
        before = stamps[max(bisect_right(places, place) - 1, 0)]
        after = stamps[min(bisect_left(places, place), len(stamps) - 1)]
        recorded.append(Recorded(_time(message, before, after), *message[1:]))
    answered = _first_answers(recorded)
    recorded = [
        m._replace(time=min(m.time, answered.get(_id(m), m.time)))
        if m.topic is interface.SHOT_REQUEST
        else m
        for m in recorded
    ]
    return sorted(recorded, key=lambda message: message.time)


def _time(message: Heard, before: int, after: int) -> int:
    """Return the sim time of a message between two ticks; on a tick, both are its stamp."""
    if message.topic is interface.COLLISIONS:
        return after
    if message.topic is interface.CLOCK:
        stamp = _stamp(message)
        if stamp is None:
            return before
        near = before - CLOCK_SLACK <= stamp <= after + CLOCK_SLACK
        return stamp if near else min(max(stamp, before), after)
    return before


def _stamp(message: Heard) -> int | None:
    """Return the stamp with which a message begins, ns; None if it is too short for one."""
    try:
        order = '<' if message.data[1] & 1 else '>'
        seconds, nanoseconds = struct.unpack_from(f'{order}iI', message.data, _HEAD)
    except (IndexError, struct.error):
        return None
    return int(seconds * SECOND_NS + nanoseconds)


def _first_answers(messages: Sequence[Recorded]) -> dict[object, int]:
    """Return the time of the first response to each request, by its id."""
    times: dict[object, int] = {}
    for message in messages:
        if message.topic is interface.SHOT_RESPONSE:
            times.setdefault(_id(message), message.time)
    times.pop(None, None)
    return times


def _id(message: Recorded) -> object:
    """Return the id in a request or a response; None if there is none."""
    try:
        fields: Any = json.loads(deserialize_message(message.data, message.topic.type).data)
        found = fields['id']
    except Exception:  # anybody may send anything
        return None
    return found if isinstance(found, str) else None
