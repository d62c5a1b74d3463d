"""The simulation as its users see it: requests in, responses and frames out; no ROS, no threads."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.me212 import cue_velocity
from pool_sim_ros.physics import ShotTooLong, Trajectory
from pool_sim_ros.simulator import responses
from pool_sim_ros.simulator.command_log import CommandLog
from pool_sim_ros.simulator.frame import Block, Frame
from pool_sim_ros.simulator.job import MOST_SLICES, Job, make_job
from pool_sim_ros.simulator.next_layout import next_layout, why_refused
from pool_sim_ros.simulator.playback import Motion, Playback
from pool_sim_ros.simulator.request_history import RequestHistory
from pool_sim_ros.simulator.settings import Settings
from pool_sim_ros.simulator.shot_request import (
    Code,
    Request,
    Response,
    parse_request,
    twist_request,
)


@dataclass(eq=False, slots=True)
class _Shot:
    """The shot in hand: from its acceptance until all balls rest, or until it is preempted."""

    request_id: str
    content: str
    response: Response
    job: Job
    settings: Settings
    trajectory: Trajectory | None = None


Taken = tuple[Response, Job | None]


class Simulation:
    """One table: takes requests, answers them, and plays the shots.

    It never waits: its owner computes the jobs that it hands out, and brings back the results.
    At most one shot is in hand at a time. `settings` and `paused` are plain attributes.

    Parameters
    ----------
    settings : Settings
        May be replaced at any time. What concerns a shot counts from the next strike.
    history : RequestHistory, optional
        Which request got which response.
    log : CommandLog, optional
        Where to record what changes the frames.

    Attributes
    ----------
    paused : bool
        Whether its owner asks for no frames; it answers requests all the same.
    """

    def __init__(
        self,
        settings: Settings,
        history: RequestHistory | None = None,
        log: CommandLog | None = None,
    ) -> None:
        self.settings = settings
        self.paused = settings.start_paused
        self._playback = Playback(settings.table.positions, settings.publish_rate)
        self._history = history or RequestHistory()
        self._log = log
        self._layout_changed = False
        self._placed: NDArray[np.float64] | None = None
        self._shot: _Shot | None = None

    @property
    def moving(self) -> bool:
        """Whether the balls move."""
        return self._playback.motion is Motion.MOVING

    @property
    def computing(self) -> bool:
        """Whether a shot is being computed."""
        return self._playback.motion is Motion.COMPUTING

    @property
    def at_rest(self) -> bool:
        """Whether no shot is in hand."""
        return self._shot is None

    @property
    def tick(self) -> int:
        """The latest tick shown; 0 before the first."""
        return self._playback.tick

    @property
    def next_tick(self) -> int:
        """The tick that `next_frame` shows."""
        return self._playback.next_tick

    @property
    def stamp(self) -> int:
        """Sim time of `tick`, ns."""
        return self._playback.stamp

    def request(self, text: str) -> Taken:
        """Take a request as `~/shot/request` carries it; returns as `take` does."""
        return self.take(parse_request(text))

    def strike(self, linear: Sequence[float], angular: Sequence[float]) -> Taken:
        """Take a twist of the cue ball, (3,) m/s and (3,) rad/s; returns as `take` does."""
        return self.take(twist_request(linear, angular))

    def take(self, request: Request) -> tuple[Response, Job | None]:
        """Take a request; without an id it gets one, unless it is unreadable.

        Returns
        -------
        response : Response
            To be published now.
        job : Job or None
            To be computed, and its result given to `computed`.
        """
        if request.id is None:
            if request.code is Code.BAD_REQUEST:
                return responses.rejected(request, request.code, request.reason), None
            request_id = self._history.make_id()
            request = replace(request, id=request_id)
        else:
            request_id = request.id
            if self._history.is_made(request_id):
                reason = f'ids that begin with {self._history.prefix} are made here; choose another'
                return responses.rejected(request, Code.BAD_REQUEST, reason), None
            known = self._find(request_id)
            if known is not None:
                return responses.repeated(request, *known), None
        job = None
        if request.code is not Code.OK:
            response = responses.rejected(request, request.code, request.reason)
        else:
            response, job = self._consider(request)
        if job is None:
            self._history.add(request_id, request.content, response)
        else:
            self._playback.strike()
            self._shot = _Shot(request_id, request.content, response, job, self.settings)
        return response, job

    def computed(self, job: Job, result: Trajectory | Exception) -> list[Response]:
        """Take the result of a job; nothing changes if the table was reset meanwhile."""
        shot = self._shot
        if shot is None or job is not shot.job or not self.computing:
            return []
        if isinstance(result, Exception):
            self._playback.abandon()
            reason = f'the shot could not be computed: {result}'
            code = Code.TOO_LONG if isinstance(result, ShotTooLong) else Code.FAILED
            return [self._preempt(shot, code, reason)]
        if not result.complete:
            self._playback.abandon()
            limit = f'max_shot_duration, {job.until:g} s'
            if job.until < shot.settings.max_shot_duration:
                limit = f'{MOST_SLICES:g} slices of time_slice, {job.until:g} s'
            reason = f'the balls would move for longer than {limit}'
            return [self._preempt(shot, Code.TOO_LONG, reason)]
        shot.trajectory = result
        self._playback.computed(result)
        return []

    def reset(self) -> list[Response]:
        """Put the balls back on the start layout; the shot in hand, if any, is preempted."""
        start_time = self._playback.start_time if self.moving else None
        self._lay_out(None)
        if self._shot is None:
            return []
        return [self._preempt(self._shot, Code.RESET, 'the table was reset', start_time)]

    def place(self, positions: NDArray[np.float64], frame_id: str = '') -> str | None:
        """Put all balls elsewhere.

        Parameters
        ----------
        positions : ndarray of shape (k, 2)
            In the order of the balls, m, in the frame `frame_id`; empty is the node's.

        Returns why this cannot be, and nothing has changed, or None where it was done.
        """
        reason = why_refused(self.settings, positions, frame_id)
        if reason is None and not self.at_rest:
            reason = f'{self._occupation}; wait for done or reset'
        if reason is None:
            self._lay_out(np.array(positions))
        return reason

    def look_ahead(self) -> Block:
        """Return what the next ticks show unless something comes between; nothing changes."""
        return self._playback.look_ahead()

    def next_frame(self) -> tuple[Frame, list[Response]]:
        """Go on by one tick.

        Returns
        -------
        frame : Frame
        responses : list of Response
            To be published after the frame.
        """
        frame, shot = self._playback.next_frame(), self._shot
        if self._log is not None:
            self._record(self._log, frame)
        return frame, [self._done(shot)] if shot is not None and frame.finished else []

    def close(self) -> None:
        """End the log, and give up the shot that is being computed."""
        if self._shot is not None:
            self._shot.job.cancel()
        if self._log is not None:
            self._log.close(self.next_tick)
            self._log = None

    @property
    def _occupation(self) -> str:
        return 'a shot is being computed' if self.computing else 'the balls are moving'

    def _lay_out(self, positions: NDArray[np.float64] | None) -> None:
        self._layout_changed, self._placed = True, positions
        self._playback.reset(self.settings.table.positions if positions is None else positions)

    def _record(self, log: CommandLog, frame: Frame) -> None:
        # Only once the frame is there: it shows the last of all resets and placements in a tick.
        if self._layout_changed:
            log.layout(frame.tick, self._placed)
        self._layout_changed, self._placed = False, None
        if frame.started and self._shot is not None:
            shot = self._shot
            log.strike(frame.tick, shot.settings, shot.response.shot, shot.job.velocity)

    def _find(self, request_id: str) -> tuple[str, Response] | None:
        """Return the content and the latest response of a request that is known, or None."""
        shot = self._shot
        if shot is not None and shot.request_id == request_id:
            return shot.content, shot.response
        return self._history.find(request_id)

    def _consider(self, request: Request) -> tuple[Response, Job | None]:
        """Accept a readable request, or reject it."""
        settings, velocity, as_printed = self.settings, request.velocity, None
        if request.shot is not None:
            try:
                velocity = cue_velocity(request.shot, settings.table)
            except ValueError as error:
                return responses.rejected(request, Code.UNKNOWN_SHOT, str(error)), None
            as_printed = not settings.deviations
        assert velocity is not None, 'a readable request has a shot or a velocity'
        speed = math.hypot(*velocity)
        if speed > settings.max_cue_speed:
            limit = f'max_cue_speed, {settings.max_cue_speed:g} m/s'
            reason = f'the speed {speed:g} m/s is above {limit}'
            return responses.rejected(request, Code.TOO_FAST, reason), None
        if not self.at_rest:
            reason = f'{self._occupation}; wait for done or reset'
            return responses.rejected(request, Code.BUSY, reason), None
        job = make_job(settings, request.shot, velocity, self._playback.positions)
        return responses.accepted(request, job, as_printed), job

    def _done(self, shot: _Shot) -> Response:
        trajectory = shot.trajectory
        assert trajectory is not None, 'a shot that is played was computed'
        table, start_time = self.settings.table, self._playback.start_time
        response = responses.done(shot.response, trajectory, table.labels, start_time)
        layout, reason = next_layout(table, self._playback.positions, shot.job.positions)
        if reason is not None:
            self._lay_out(layout)
        return self._end(shot, replace(response, reason=reason))

    def _preempt(
        self, shot: _Shot, code: Code, reason: str, start_time: float | None = None
    ) -> Response:
        shot.job.cancel()
        return self._end(shot, responses.preempted(shot.response, code, reason, start_time))

    def _end(self, shot: _Shot, response: Response) -> Response:
        self._history.add(shot.request_id, shot.content, response)
        self._shot = None
        return response
