"""A subscription for a reader that looks now and then."""

from __future__ import annotations

from typing import Any

from pool_sim_ros.ros import interface
from pool_sim_ros.ros.simulator_link import SimulatorLink


class Inbox:
    """Keeps the latest messages of a topic until somebody takes them.

    No executor may know the node of its link: it would take the messages away. One that wakes for
    each of 60 messages a second costs three times as much.

    Parameters
    ----------
    link : SimulatorLink
        Not started, and never spun.
    topic : Topic
    depth, past, raw
        As in `SimulatorLink.subscribe`.
    """

    def __init__(
        self,
        link: SimulatorLink,
        topic: interface.Topic,
        *,
        depth: int | None = None,
        past: bool = True,
        raw: bool = False,
    ) -> None:
        self._raw = raw
        self._subscription = link.subscribe(topic, lambda _: None, depth=depth, past=past, raw=raw)

    def take(self) -> list[tuple[Any, int]]:
        """Return what came since the last call: messages, and when each came, ns since 1970."""
        found = []
        subscription = self._subscription
        with subscription.handle:  # keeps it alive
            while taken := subscription.handle.take_message(subscription.msg_type, self._raw):
                found.append((taken[0], taken[1]['received_timestamp']))
        return found
