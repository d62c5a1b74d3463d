"""Which request got which response, so that no request is carried out twice."""

from __future__ import annotations

import uuid
from collections import OrderedDict

from pool_sim_ros.simulator.shot_request import Response

REMEMBERED_IDS = 1000
"""As many as the request queue holds: a client may repeat a whole burst of requests."""


class RequestHistory:
    """The last response to each of the last requests that are over, by the id that a client chose.

    Ids that are made here are not kept: each is new, and no client may use one.

    Parameters
    ----------
    prefix : str, optional
        How the ids that are made here begin; unique to this process by default.
    capacity : int, optional
        How many requests are remembered.
    """

    def __init__(self, prefix: str | None = None, capacity: int = REMEMBERED_IDS) -> None:
        self.prefix = prefix or uuid.uuid4().hex
        self._capacity = capacity
        self._count = 0
        self._entries: OrderedDict[str, tuple[str, Response]] = OrderedDict()

    def make_id(self) -> str:
        """Return an id that was never used."""
        self._count += 1
        return f'{self.prefix}-{self._count}'

    def is_made(self, request_id: str) -> bool:
        """Return whether an id is one that was made here, or may be one day."""
        return request_id.startswith(self.prefix)

    def find(self, request_id: str) -> tuple[str, Response] | None:
        """Return the content of the request with this id and its last response, or None."""
        return self._entries.get(request_id)

    def add(self, request_id: str, content: str, response: Response) -> None:
        """Remember the last response to a request, and forget the oldest one for it if need be.

        Parameters
        ----------
        request_id : str
        content : str
            The request's `content`.
        response : Response
        """
        if self.is_made(request_id):
            return
        self._entries[request_id] = (content, response)
        if len(self._entries) > self._capacity:
            self._entries.popitem(last=False)
