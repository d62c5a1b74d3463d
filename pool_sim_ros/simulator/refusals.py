"""Why a request is not carried out."""

from __future__ import annotations

from pool_sim_ros.simulator.shot_request import Code


class RefusedError(Exception):
    """A request that is rejected.

    Parameters
    ----------
    code : Code
    reason : str
        The same in words.
    """

    def __init__(self, code: Code, reason: str) -> None:
        super().__init__(reason)
        self.code = code
        self.reason = reason
