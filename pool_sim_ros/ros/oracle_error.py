"""Why an oracle does not answer what it was asked."""

from __future__ import annotations

from enum import Enum

from pool_sim_ros.console import CommandError


class OracleCode(str, Enum):
    """The reason in one word."""

    OK = 'OK'
    BAD_REQUEST = 'BAD_REQUEST'
    BAD_FRAME = 'BAD_FRAME'
    BAD_FIELDS = 'BAD_FIELDS'
    BAD_CANDIDATE = 'BAD_CANDIDATE'
    BAD_GOAL = 'BAD_GOAL'
    BAD_NOISE = 'BAD_NOISE'
    TOO_MANY = 'TOO_MANY'
    NO_SIMULATOR = 'NO_SIMULATOR'
    MOVING = 'MOVING'
    ID_REUSED = 'ID_REUSED'
    UNKNOWN_ID = 'UNKNOWN_ID'
    CANCELLED = 'CANCELLED'
    BUSY = 'BUSY'
    FAILED = 'FAILED'


class OracleError(CommandError):
    """The oracle did not do what was asked; the message is for the user.

    Attributes
    ----------
    code : str
        A value of `OracleCode`; an oracle of another version may have others.
    reason : str
    """

    def __init__(self, code: str, reason: str) -> None:
        self.code = code.value if isinstance(code, OracleCode) else code
        self.reason = reason
        super().__init__(f'{self.code}: {reason}')
