"""The simulation as its users see it: requests in, responses and frames out; no ROS, no threads."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from pool_sim_ros.me212 import cue_velocity, inches
from pool_sim_ros.physics import Trajectory, check_layout
from pool_sim_ros.simulator.command_log import CommandLog
from pool_sim_ros.simulator.job import Job, make_job
from pool_sim_ros.simulator.playback import Frame, Motion, Playback
from pool_sim_ros.simulator.request_history import Ledger
from pool_sim_ros.simulator.settings import Settings
from pool_sim_ros.simulator.shot_request import (
    Code,
    Phase,
    Request,
    Response,
    parse_request,
    twist_request,
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
    log : CommandLog, optional
        Where to record what changes the frames.
    """

    def __init__(
        self,
        settings: Settings,
        ledger: Ledger | None = None,
        log: CommandLog | None = None,
    ) -> None:
        self.settings = settings
        table = settings.table
        self.playback = Playback(table.positions, settings.publish_rate, settings.start_paused)
        self._ledger = ledger or Ledger()
        self._log = log
        self._layout_changed = False
        self._placed: np.ndarray | None = None
        self._settings_at_strike = settings
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
        """Take a request; see `shot_request.parse_request`.

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
        self._lay_out(None)
        self._job = None
        if self._response is None:
            return []
        return [self._preempt(Code.RESET, 'the table was reset', started)]

    def place(self, positions: np.ndarray) -> str | None:
        """Put all balls elsewhere.

        Parameters
        ----------
        positions : ndarray of shape (k, 2)
            In the order of the balls, m.

        Returns
        -------
        str or None
            Why this cannot be, and nothing has changed; None where it was done.
        """
        table = self.settings.table
        if len(positions) != len(table.balls):
            return f'{len(positions)} positions; the table has {len(table.balls)} balls'
        if self._response is not None:
            return f'{self._doing}; wait for done or reset'
        try:
            check_layout(table, positions)
        except ValueError as error:
            return str(error)
        self._lay_out(np.array(positions))
        return None

    def close(self) -> None:
        """End the log."""
        if self._log is not None:
            self._log.close(self.playback.next_tick)
            self._log = None

    def next_frame(self) -> tuple[Frame, list[Response]]:
        """Go on by one tick.

        Returns
        -------
        frame : Frame
        responses : list of Response
            To be published after the frame.
        """
        frame = self.playback.next_frame()
        if self._log is not None:
            self._record(frame)
        return frame, [self._done()] if frame.finished else []

    @property
    def _doing(self) -> str:
        return 'a shot is being computed' if self.computing else 'the balls are moving'

    def _lay_out(self, positions: np.ndarray | None) -> None:
        self._layout_changed, self._placed = True, positions
        self.playback.reset(self.settings.table.positions if positions is None else positions)

    def _record(self, frame: Frame) -> None:
        # Not before the frame: of all resets and placings in a tick only the last one is seen.
        if self._layout_changed:
            self._log.layout(frame.tick, self._placed)
        self._layout_changed, self._placed = False, None
        if frame.started:
            response = self._response
            self._log.strike(frame.tick, self._settings_at_strike, response.shot, response.velocity)

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
            self._settings_at_strike = self.settings
        return response, job

    def _repeated(self, request: Request, content: str, response: Response) -> Response:
        if request.content == content:
            return response
        reason = 'this id was used for another request; choose a new one for each'
        return _rejected(request, Code.ID_REUSED, reason)

    def _consider(self, request: Request) -> tuple[Response, Job | None]:
        settings, table = self.settings, self.settings.table
        velocity, as_printed = request.velocity, None
        if request.shot is not None:
            try:
                velocity = cue_velocity(request.shot, table)
            except ValueError as error:
                return _rejected(request, Code.UNKNOWN_SHOT, str(error)), None
            as_printed = not settings.deviations
        speed = math.hypot(*velocity)
        if speed > settings.max_cue_speed:
            limit = f'max_cue_speed, {settings.max_cue_speed:g} m/s'
            reason = f'the speed {speed:g} m/s is above {limit}'
            return _rejected(request, Code.TOO_FAST, reason), None
        if self._response is not None:
            return _rejected(request, Code.BUSY, f'{self._doing}; wait for done or reset'), None
        job = make_job(settings, request.shot, velocity, self.playback.positions)
        response = Response(
            id=request.id,
            phase=Phase.ACCEPTED,
            shot=request.shot,
            velocity=velocity,
            integrator=job.integrator,
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


def _rejected(request: Request, code: Code, reason: str | None) -> Response:
    return Response(
        id=request.id,
        phase=Phase.REJECTED,
        code=code,
        reason=reason,
        shot=request.shot,
        velocity=request.velocity,
    )
