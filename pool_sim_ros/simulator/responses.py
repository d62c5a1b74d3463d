"""The responses that a request gets: rejected at once, or accepted and then done or preempted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.me212 import inches
from pool_sim_ros.physics import Table, Trajectory
from pool_sim_ros.simulator.job import Job
from pool_sim_ros.simulator.layout import Layout, pockets_at
from pool_sim_ros.simulator.shot_request import Code, Phase, Request, Response


def rejected(request: Request, code: Code, reason: str | None) -> Response:
    """Return the response to a request that is not carried out."""
    return Response(
        id=request.id,
        phase=Phase.REJECTED,
        code=code,
        reason=reason,
        shot=request.shot,
        velocity=request.velocity,
        spin=request.spin,
        cue=request.cue,
        place=request.place,
    )


def repeated(request: Request, content: str, response: Response) -> Response:
    """Return the response to a request whose id is known.

    Parameters
    ----------
    request : Request
    content : str
        What was asked for under this id before.
    response : Response
        The latest one under this id; it is given again if the request asks for the same.
    """
    if request.content == content:
        return response
    reason = 'this id was used for another request; choose a new one for each'
    return rejected(request, Code.ID_REUSED, reason)


def accepted(request: Request, job: Job, as_printed: bool | None) -> Response:
    """Return the response to a request whose shot is going to be computed.

    Parameters
    ----------
    request : Request
    job : Job
    as_printed : bool or None
        See `Response`.
    """
    return Response(
        id=request.id,
        phase=Phase.ACCEPTED,
        shot=request.shot,
        velocity=job.velocity,
        integrator=job.integrator,
        as_printed=as_printed,
        spin=job.spin,
        cue=request.cue,
    )


def done(
    response: Response, trajectory: Trajectory, labels: Sequence[str], start_time: float
) -> Response:
    """Return the response to a shot that was played to its end.

    Parameters
    ----------
    response : Response
        The one that accepted it.
    trajectory : Trajectory
    labels : sequence of n str
        Of the balls, in order.
    start_time : float
        Sim time at which the balls started, s.
    """
    spins = response.spin is not None
    return replace(
        response,
        phase=Phase.DONE,
        t_start=start_time,
        t_end=start_time + trajectory.duration,
        events=len(trajectory.events),
        pocketed=_pocketed(labels, trajectory.pocketed) if spins else None,
        **_positions(labels, trajectory.final_positions),
    )


def placed(request: Request, table: Table, layout: Layout, time: float) -> list[Response]:
    """Return the responses to balls that were placed elsewhere: accepted, and done.

    Parameters
    ----------
    request : Request
    table : Table
    layout : Layout
        How all balls lie then.
    time : float
        Sim time of the tick that shows it, s.
    """
    accepted = Response(id=request.id, phase=Phase.ACCEPTED, place=request.place)
    pockets = pockets_at(table, layout.positions)
    return [
        accepted,
        replace(
            accepted,
            phase=Phase.DONE,
            t_start=time,
            t_end=time,
            events=0,
            pocketed=_pocketed(table.labels, pockets) if table.motion == 'ball' else None,
            **_positions(table.labels, layout.positions),
        ),
    ]


def _pocketed(labels: Sequence[str], pockets: NDArray[np.int64]) -> dict[str, int]:
    """Return the pocket of each ball that lies in one, by labels and (n,) numbers."""
    return {
        label: number for label, number in zip(labels, pockets.tolist(), strict=True) if number >= 0
    }


def _positions(labels: Sequence[str], positions: NDArray[np.float64]) -> dict[str, Any]:
    """Return the fields that say where the balls are, (n, 2) in m."""
    places = list(zip(labels, positions.tolist(), strict=True))
    return dict(
        final_positions=dict(places),
        final_positions_in={label: [inches(x), inches(y)] for label, (x, y) in places},
    )


def preempted(
    response: Response, code: Code, reason: str, start_time: float | None = None
) -> Response:
    """Return the response to a shot that is not played to its end.

    Parameters
    ----------
    response : Response
        The one that accepted it.
    code : Code
    reason : str
    start_time : float or None, optional
        Sim time at which the balls started, s; None where they never did.
    """
    return replace(response, phase=Phase.PREEMPTED, code=code, reason=reason, t_start=start_time)
