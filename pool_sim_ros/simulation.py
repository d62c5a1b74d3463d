"""The simulation as its users see it: requests in, responses and frames out; no ROS, no threads."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from pool_sim_ros.ledger import Ledger
from pool_sim_ros.physics import Table, Trajectory, report_table, simulate
from pool_sim_ros.physics.simulate import REPORT_TIME_SLICE
from pool_sim_ros.playback import Frame, Motion, Playback
from pool_sim_ros.protocol import Code, Phase, Request, Response, parse_request, twist_request
from pool_sim_ros.report.log import inches
from pool_sim_ros.report.shots import cue_velocity
from pool_sim_ros.settings import Settings


@dataclass(frozen=True, eq=False)
class Job:
    """A shot to compute: everything that `simulate` needs, as it was at the strike."""

    table: Table
    velocity: tuple[float, float]
    positions: np.ndarray
    integrator: str
    time_slice: float
    until: float

    def run(self) -> Trajectory:
        """Compute the shot; takes from microseconds to seconds, most of it without the GIL."""
        return simulate(
            self.table,
            self.velocity,
            positions=self.positions,
            integrator=self.integrator,
            time_slice=self.time_slice,
            until=self.until,
        )


class Simulation:
    """One table: takes requests, answers them, and plays the shots.

    Whoever owns it computes the jobs that it hands out, elsewhere, and brings back the results; it
    never waits. At most one shot is in hand at a time.

    Parameters
    ----------
    settings : Settings
        May be replaced at any time: `settings` is a plain attribute. What concerns a shot counts
        from the next strike; the balls, the table's size and the rate must stay.
    ledger : Ledger, optional
        The memory of ids.
    """

    def __init__(self, settings: Settings, ledger: Ledger | None = None) -> None:
        self.settings = settings
        table = settings.table
        self.playback = Playback(table.positions, settings.publish_rate, settings.start_paused)
        self._ledger = ledger or Ledger()
        self._job: Job | None = None
        self._response: Response | None = None
        self._trajectory: Trajectory | None = None

    @property
    def moving(self) -> bool:
        """Whether the balls move."""
        return self.playback.motion is Motion.MOVING

    @property
    def computing(self) -> bool:
        """Whether a shot is being computed."""
        return self.playback.motion is Motion.COMPUTING

    def request(self, text: str) -> tuple[Response, Job | None]:
        """Take a request; see `protocol.parse_request`.

        Returns
        -------
        response : Response
            To be published now.
        job : Job or None
            To be computed, and its result given to `computed`.
        """
        return self._take(parse_request(text))

    def strike(
        self, linear: Sequence[float], angular: Sequence[float]
    ) -> tuple[Response, Job | None]:
        """Take a twist of the cue ball, (3,) m/s and (3,) rad/s; returns as `request` does."""
        return self._take(twist_request(linear, angular))

    def computed(self, job: Job, result: Trajectory | Exception) -> list[Response]:
        """Take the result of a job; one that a reset has overtaken changes nothing."""
        if job is not self._job:
            return []
        self._job = None
        if isinstance(result, Exception):
            self.playback.abandon()
            return [self._preempt(Code.FAILED, f'the shot could not be computed: {result}')]
        if not result.complete:
            self.playback.abandon()
            limit = f'max_shot_duration, {job.until:g} s'
            return [self._preempt(Code.TOO_LONG, f'the balls would move for longer than {limit}')]
        self._trajectory = result
        self.playback.computed(result)
        return []

    def reset(self) -> list[Response]:
        """Put the balls back on the start layout; the shot in hand, if any, is preempted."""
        started = self.playback.start_time if self.playback.motion is Motion.MOVING else None
        self.playback.reset(self.settings.table.positions)
        self._job = None
        if self._response is None:
            return []
        return [self._preempt(Code.RESET, 'the table was reset', started)]

    def next_frame(self) -> tuple[Frame, list[Response]]:
        """Go on by one tick.

        Returns
        -------
        frame : Frame
        responses : list of Response
            To be published after the frame.
        """
        frame = self.playback.next_frame()
        return frame, [self._done()] if frame.finished else []

    def _take(self, request: Request) -> tuple[Response, Job | None]:
        if request.id is not None:
            known = self._ledger.find(request.id)
            if known is not None:
                return self._repeated(request, *known), None
        elif request.code is not Code.BAD_REQUEST:
            request = replace(request, id=self._ledger.make_id())
        job = None
        if request.code is not Code.OK:
            response = _rejected(request, request.code, request.reason)
        else:
            response, job = self._consider(request)
        if response.id is not None:
            self._ledger.enter(request, response)
        if job is not None:
            self.playback.strike()
            self._job, self._response = job, response
        return response, job

    def _repeated(self, request: Request, content: str, response: Response) -> Response:
        if request.content == content:
            return response
        reason = 'this id was used for another request; choose a new one for each'
        return _rejected(request, Code.ID_REUSED, reason)

    def _consider(self, request: Request) -> tuple[Response, Job | None]:
        settings, table = self.settings, self.settings.table
        velocity, positions = request.velocity, self.playback.positions
        integrator, as_printed = settings.integrator, None
        if request.shot is not None:
            try:
                velocity = cue_velocity(request.shot, table)
            except ValueError as error:
                return _rejected(request, Code.UNKNOWN_SHOT, str(error)), None
            positions, integrator = table.positions, settings.report_integrator
            as_printed = is_as_printed(settings)
        speed = math.hypot(*velocity)
        if speed > settings.max_cue_speed:
            limit = f'max_cue_speed, {settings.max_cue_speed:g} m/s'
            reason = f'the speed {speed:g} m/s is above {limit}'
            return _rejected(request, Code.TOO_FAST, reason), None
        if self._response is not None:
            doing = 'a shot is being computed' if self.computing else 'the balls are moving'
            return _rejected(request, Code.BUSY, f'{doing}; wait for done or reset'), None
        job = Job(
            table=table,
            velocity=velocity,
            positions=positions,
            integrator=integrator,
            time_slice=settings.time_slice,
            until=settings.max_shot_duration,
        )
        response = Response(
            id=request.id,
            phase=Phase.ACCEPTED,
            shot=request.shot,
            velocity=velocity,
            integrator=integrator,
            as_printed=as_printed,
        )
        return response, job

    def _done(self) -> Response:
        labels = self.settings.table.labels
        places = self._trajectory.final_positions.tolist()
        start = self.playback.start_time
        response = replace(
            self._response,
            phase=Phase.DONE,
            t_start=start,
            t_end=start + self._trajectory.duration,
            events=len(self._trajectory.events),
            final_positions=dict(zip(labels, places, strict=True)),
            final_positions_in={
                label: [inches(x), inches(y)] for label, (x, y) in zip(labels, places, strict=True)
            },
        )
        return self._finish(response)

    def _preempt(self, code: Code, reason: str, t_start: float | None = None) -> Response:
        preempted = {'phase': Phase.PREEMPTED, 'code': code, 'reason': reason, 't_start': t_start}
        return self._finish(replace(self._response, **preempted))

    def _finish(self, response: Response) -> Response:
        self._ledger.update(response)
        self._response = self._trajectory = None
        return response


def is_as_printed(settings: Settings) -> bool:
    """Return whether a report shot under these settings ends where the report printed."""
    if settings.report_integrator != 'time_slice' or settings.time_slice != REPORT_TIME_SLICE:
        return False
    return _without_colors(settings.table) == _without_colors(report_table())


def _without_colors(table: Table) -> Table:
    balls = tuple(replace(ball, color=(0.0, 0.0, 0.0)) for ball in table.balls)
    return replace(table, balls=balls)


def _rejected(request: Request, code: Code, reason: str | None) -> Response:
    return Response(
        id=request.id,
        phase=Phase.REJECTED,
        code=code,
        reason=reason,
        shot=request.shot,
        velocity=request.velocity,
    )
