"""The shot in hand: from its acceptance until all balls rest, or until it is preempted."""

from __future__ import annotations

from dataclasses import dataclass

from pool_sim_ros.physics import ShotTooLong, Trajectory
from pool_sim_ros.simulator.job import MOST_SLICES, Job
from pool_sim_ros.simulator.layout import Layout
from pool_sim_ros.simulator.settings import Settings
from pool_sim_ros.simulator.shot_request import Code, Response


@dataclass(eq=False, slots=True)
class ShotInHand:
    """A shot that was accepted.

    Attributes
    ----------
    request_id, content : str
        Of the request.
    response : Response
        The one that accepted it.
    job : Job
    settings : Settings
        Those at the strike.
    start : Layout
        How the balls lie when it starts.
    trajectory : Trajectory or None
        None until it is computed.
    """

    request_id: str
    content: str
    response: Response
    job: Job
    settings: Settings
    start: Layout
    trajectory: Trajectory | None = None


def why_not_played(
    result: Trajectory | Exception, job: Job, settings: Settings
) -> tuple[Code, str]:
    """Return why a result, an error or a shot that was cut, is not played, and in words."""
    if isinstance(result, Exception):
        code = Code.TOO_LONG if isinstance(result, ShotTooLong) else Code.FAILED
        return code, f'the shot could not be computed: {result}'
    limit = f'max_shot_duration, {job.until:g} s'
    if job.until < settings.max_shot_duration:
        limit = f'{MOST_SLICES:g} slices of time_slice, {job.until:g} s'
    return Code.TOO_LONG, f'the balls would move for longer than {limit}'
