"""The interface between the runner and whoever sends what it plays."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from pool_sim_ros.simulator.frame import Block, Frame
from pool_sim_ros.simulator.health import Diagnosis
from pool_sim_ros.simulator.settings import Settings
from pool_sim_ros.simulator.shot_request import Response


class Output(Protocol):
    """Sends what the runner plays; called by one thread at a time."""

    def prepare(self, block: Block) -> None:
        """Prepare what the next ticks send unless something comes between."""

    def frame(self, frame: Frame) -> None:
        """Send a tick: the clock, the collisions up to it, then the balls."""

    def clock(self, stamp: int) -> None:
        """Send the sim time in ns."""

    def responses(self, responses: Sequence[Response]) -> None:
        """Send responses."""

    def state(self, state: dict[str, object]) -> None:
        """Send the state."""

    def table(self, settings: Settings) -> None:
        """Send the table of these settings."""

    def diagnostics(self, stamp: int, diagnosis: Diagnosis) -> None:
        """Send how the simulator is doing, at a sim time in ns."""

    def tell(self, line: str) -> None:
        """Tell the user what is going on."""

    def fail(self, line: str) -> None:
        """Tell the user why nothing can go on, and end the process."""

    def is_open(self) -> bool:
        """Return whether anything can still be sent."""
