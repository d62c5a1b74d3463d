"""The memory of what was answered to whom, so that no request is carried out twice."""

from __future__ import annotations

import uuid
from collections import OrderedDict

from pool_sim_ros.simulator.shot_request import Phase, Request, Response

REMEMBERED_IDS = 1000
"""As many as the request queue holds: a client may repeat a whole burst of requests."""


class Ledger:
    """The latest response under each of the last ids.

    Ids that were made here are remembered apart from those that clients chose, so that a flood of
    requests without an id cannot push out the memory of those that have one.

    Parameters
    ----------
    prefix : str, optional
        What made ids start with; unique to this process by default.
    capacity : int, optional
        How many ids of each sort are remembered.
    """

    def __init__(self, prefix: str | None = None, capacity: int = REMEMBERED_IDS) -> None:
        self._prefix = prefix or uuid.uuid4().hex
        self._capacity = capacity
        self._count = 0
        self._given: OrderedDict[str, tuple[str, Response]] = OrderedDict()
        self._made: OrderedDict[str, tuple[str, Response]] = OrderedDict()

    def make_id(self) -> str:
        """Return an id that was never used."""
        self._count += 1
        return f'{self._prefix}-{self._count}'

    def find(self, request_id: str) -> tuple[str, Response] | None:
        """Return the content of the request under this id and its latest response."""
        return self._memory(request_id).get(request_id)

    def enter(self, request: Request, response: Response) -> None:
        """Remember the first response to a request.

        The oldest id is forgotten for it where the memory is full, but never that of the shot in
        hand, whose last response is still to come.
        """
        memory = self._memory(response.id)
        memory[response.id] = (request.content, response)
        while len(memory) > self._capacity:
            oldest_id, (_, oldest) = next(iter(memory.items()))
            if oldest.phase is Phase.ACCEPTED:
                memory.move_to_end(oldest_id)
            else:
                del memory[oldest_id]

    def update(self, response: Response) -> None:
        """Remember a later response under an id."""
        memory = self._memory(response.id)
        content, _ = memory[response.id]
        memory[response.id] = (content, response)
        memory.move_to_end(response.id)

    def _memory(self, request_id: str) -> OrderedDict[str, tuple[str, Response]]:
        return self._made if request_id.startswith(self._prefix) else self._given
