"""Which request got which response, so that no request is carried out twice."""

from __future__ import annotations

import uuid
from collections import OrderedDict

from pool_sim_ros.simulator.shot_request import Phase, Response

REMEMBERED_IDS = 1000
"""As many as the request queue holds: a client may repeat a whole burst of requests."""


class RequestHistory:
    """The latest response to each of the last requests, by id.

    Ids that were made here are kept apart from ids that clients chose, so that a flood of requests
    without an id cannot push out those that have one.

    Parameters
    ----------
    prefix : str, optional
        How the ids that are made here begin; unique to this process by default.
    capacity : int, optional
        How many ids of each sort are remembered.
    """

    def __init__(self, prefix: str | None = None, capacity: int = REMEMBERED_IDS) -> None:
        self._prefix = prefix or uuid.uuid4().hex
        self._capacity = capacity
        self._count = 0
        self._chosen: OrderedDict[str, tuple[str, Response]] = OrderedDict()
        self._made: OrderedDict[str, tuple[str, Response]] = OrderedDict()

    def make_id(self) -> str:
        """Return an id that was never used."""
        self._count += 1
        return f'{self._prefix}-{self._count}'

    def find(self, request_id: str) -> tuple[str, Response] | None:
        """Return the content of the request with this id and its latest response, or None."""
        return self._entries(request_id).get(request_id)

    def add(self, request_id: str, content: str, response: Response) -> None:
        """Remember the first response to a request, and forget the oldest one for it if need be.

        The shot in hand is never forgotten: its last response is still to come.

        Parameters
        ----------
        request_id : str
        content : str
            The request's `content`.
        response : Response
        """
        entries = self._entries(request_id)
        entries[request_id] = (content, response)
        while len(entries) > self._capacity:
            oldest_id, (_, oldest) = next(iter(entries.items()))
            if oldest.phase is Phase.ACCEPTED:
                entries.move_to_end(oldest_id)
            else:
                del entries[oldest_id]

    def update(self, request_id: str, response: Response) -> None:
        """Remember a later response to a request that was added."""
        entries = self._entries(request_id)
        content, _ = entries[request_id]
        entries[request_id] = (content, response)
        entries.move_to_end(request_id)

    def _entries(self, request_id: str) -> OrderedDict[str, tuple[str, Response]]:
        return self._made if request_id.startswith(self._prefix) else self._chosen
