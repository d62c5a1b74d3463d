"""The simulation as its users see it: requests in, responses and frames out; no ROS, no threads."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import Trajectory
from pool_sim_ros.simulator import responses
from pool_sim_ros.simulator.command_log import CommandLog
from pool_sim_ros.simulator.frame import Block, Frame
from pool_sim_ros.simulator.job import Job, make_job
from pool_sim_ros.simulator.layout import Layout, layout_at, start_layout
from pool_sim_ros.simulator.next_layout import (
    check_cue_ball,
    next_layout,
    why_refused,
    with_placed,
)
from pool_sim_ros.simulator.playback import Motion, Playback
from pool_sim_ros.simulator.refusals import RefusedError
from pool_sim_ros.simulator.request_history import RequestHistory
from pool_sim_ros.simulator.settings import Settings
from pool_sim_ros.simulator.shot_in_hand import ShotInHand, why_not_played
from pool_sim_ros.simulator.shot_request import (
    Code,
    Request,
    Response,
    parse_request,
    twist_request,
)
from pool_sim_ros.simulator.strikes import strike_of

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
        self._playback = Playback(start_layout(settings.table), settings.publish_rate)
        self._history = history or RequestHistory()
        self._log = log
        self._layout_changed = False
        self._placed: Layout | None = None
        self._shot: ShotInHand | None = None
        self._more: list[Response] = []

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
    def pocketed(self) -> list[str]:
        """Labels of the balls in pockets, in the order in which they fell."""
        labels = self.settings.table.labels
        return [labels[ball] for ball in self._playback.pocketed]

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
        spins = self.settings.table.motion == 'ball'
        return self.take(twist_request(linear, angular, spins))

    def take(self, request: Request) -> tuple[Response, Job | None]:
        """Take a request; without an id it gets one, unless it is unreadable.

        Returns
        -------
        response : Response
            To be published now.
        job : Job or None
            To be computed, and its result given to `computed`; where there is none, there may be
            `more_responses`.
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
        try:
            if request.code is not Code.OK:
                raise RefusedError(request.code, request.reason or '')
            if request.place is not None:
                return self._place_some(request, request.place), None
            return self._accept(request_id, request)
        except RefusedError as refused:
            response = responses.rejected(request, refused.code, refused.reason)
            self._history.add(request_id, request.content, response)
            return response, None

    def more_responses(self) -> list[Response]:
        """Return what is to be published after the response that `take` has returned."""
        more, self._more = self._more, []
        return more

    def computed(self, job: Job, result: Trajectory | Exception) -> list[Response]:
        """Take the result of a job; nothing changes if the table was reset meanwhile."""
        shot = self._shot
        if shot is None or job is not shot.job or not self.computing:
            return []
        if isinstance(result, Exception) or not result.complete:
            self._playback.abandon()
            return [self._preempt(shot, *why_not_played(result, job, shot.settings))]
        shot.trajectory = result
        self._playback.computed(result, shot.start)
        return []

    def reset(self) -> list[Response]:
        """Put the balls back on the start layout; the shot in hand, if any, is preempted."""
        start_time = self._playback.start_time if self.moving else None
        self._lay_out(None)
        if self._shot is None:
            return []
        return [self._preempt(self._shot, Code.RESET, 'the table was reset', start_time)]

    def place(
        self,
        positions: NDArray[np.float64],
        frame_id: str = '',
        orientations: NDArray[np.float64] | None = None,
    ) -> str | None:
        """Put all balls elsewhere; return why this cannot be, or None where it was done.

        Parameters
        ----------
        positions : ndarray of shape (k, 2)
            In the order of the balls, m, in the frame `frame_id`; empty is the node's.
        orientations : ndarray of shape (k, 4), optional
            Where balls spin; by default they are not turned.
        """
        reason = why_refused(self.settings, positions, frame_id)
        if reason is not None:
            return reason
        try:
            self._check_at_rest()
        except RefusedError as refused:
            return refused.reason
        before = self._playback.layout.pocketed
        self._lay_out(layout_at(self.settings.table, np.array(positions), orientations, before))
        return None

    def look_ahead(self) -> Block:
        """Return what the next ticks show unless something comes between; nothing changes."""
        return self._playback.look_ahead()

    def next_frame(self) -> tuple[Frame, list[Response]]:
        """Go on by one tick; return its frame, and the responses to be published after it."""
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

    def _lay_out(self, layout: Layout | None) -> None:
        self._layout_changed, self._placed = True, layout
        self._playback.reset(start_layout(self.settings.table) if layout is None else layout)

    def _place_some(self, request: Request, places: dict[str, tuple[float, float]]) -> Response:
        """Put single balls elsewhere."""
        self._check_at_rest()
        table, time = self.settings.table, self._playback.time_of(self.next_tick)
        layout = with_placed(table, self._playback.layout, places)
        self._lay_out(layout)
        accepted, done = responses.placed(request, table, layout, time)
        self._more.append(done)
        self._history.add(str(request.id), request.content, done)
        return accepted

    def _check_at_rest(self) -> None:
        if not self.at_rest:
            doing = 'a shot is being computed' if self.computing else 'the balls are moving'
            raise RefusedError(Code.BUSY, f'{doing}; wait for done or reset')

    def _record(self, log: CommandLog, frame: Frame) -> None:
        # Only once the frame is there: it shows the last of all resets and placements in a tick.
        if self._layout_changed:
            log.layout(frame.tick, self._placed)
        self._layout_changed, self._placed = False, None
        if frame.started and self._shot is not None:
            shot = self._shot
            job = shot.job
            log.strike(frame.tick, shot.settings, shot.response.shot, job.velocity, job.spin)

    def _find(self, request_id: str) -> tuple[str, Response] | None:
        """Return the content and the latest response of a request that is known, or None."""
        shot = self._shot
        if shot is not None and shot.request_id == request_id:
            return shot.content, shot.response
        return self._history.find(request_id)

    def _accept(self, request_id: str, request: Request) -> tuple[Response, Job]:
        """Accept a strike; raise RefusedError where it cannot be."""
        settings = self.settings
        strike = strike_of(request, settings)
        self._check_at_rest()
        start = self._playback.layout if request.shot is None else start_layout(settings.table)
        check_cue_ball(settings.table, start)
        job = make_job(settings, request.shot, strike.velocity, start.positions, strike.spin)
        as_printed = None if request.shot is None else not settings.deviations
        response = responses.accepted(request, job, as_printed)
        self._playback.strike()
        self._shot = ShotInHand(request_id, request.content, response, job, settings, start)
        return response, job

    def _done(self, shot: ShotInHand) -> Response:
        trajectory = shot.trajectory
        assert trajectory is not None, 'a shot that is played was computed'
        table, start_time = self.settings.table, self._playback.start_time
        response = responses.done(shot.response, trajectory, table.labels, start_time)
        lies = self._playback.layout
        positions, reason = next_layout(table, lies.positions, shot.job.positions)
        if reason is not None:
            self._lay_out(layout_at(table, positions, lies.orientations, lies.pocketed))
        return self._end(shot, replace(response, reason=reason))

    def _preempt(
        self, shot: ShotInHand, code: Code, reason: str, start_time: float | None = None
    ) -> Response:
        shot.job.cancel()
        return self._end(shot, responses.preempted(shot.response, code, reason, start_time))

    def _end(self, shot: ShotInHand, response: Response) -> Response:
        self._history.add(shot.request_id, shot.content, response)
        self._shot = None
        return response
