"""Takes requests for plans and answers them; searches in a thread of its own. Without ROS."""

from __future__ import annotations

import threading
import time
import traceback
from collections import OrderedDict, deque
from collections.abc import Callable
from typing import Any

from pool_sim_ros.oracle import Cluster, ClusterError, Plan, find_shots
from pool_sim_ros.ros.oracle_error import OracleCode, OracleError
from pool_sim_ros.ros.plan_json import (
    LAST,
    BadPlanError,
    PlanPhase,
    PlanRequest,
    plan_fields,
    plan_response,
    read_plan_request,
)
from pool_sim_ros.ros.simulator_view import Lying

MOST_WAITING = 100
"""Plans that wait for their turn."""

REMEMBERED = 1000
"""Requests whose last response is kept, so that one that comes again is not carried out again."""

PROGRESS_PERIOD = 0.2
"""Least time in s between two responses that tell how far a search is."""


class Cancelled(Exception):  # noqa: N818
    """A search that nobody wants any more."""


class Checked(Exception):  # noqa: N818
    """A search whose arguments are right."""


class _Job:
    """A plan: waiting, in the making, or over.

    Attributes
    ----------
    phase, response : PlanPhase and str
        The latest.
    """

    def __init__(self, request: PlanRequest, lying: Lying | None = None) -> None:
        self.request, self.lying = request, lying
        self.cancelled = False
        self.phase = PlanPhase.ACCEPTED
        self.response = ''


class PlanDesk:
    """Makes one plan after another, in the order in which they were accepted.

    Each starts from the layout at which it was accepted. A request with a known id is answered with
    the latest response, and never carried out twice.

    Parameters
    ----------
    send : callable
        Takes each response, from any thread.
    look : callable
        Returns how the balls lie; raises OracleError where it cannot tell.
    on_plan : callable
        Called with each plan and the layout from which it starts, in the thread of the search.
    threads : int, optional
        At most so many play; by default one for each core.
    cluster : Cluster, optional
        Where to play instead.
    """

    def __init__(
        self,
        send: Callable[[str], None],
        look: Callable[[], Lying],
        on_plan: Callable[[Plan, Lying], None] = lambda plan, lying: None,
        threads: int | None = None,
        cluster: Cluster | None = None,
    ) -> None:
        self._cluster = cluster
        self._send, self._look, self._on_plan = send, look, on_plan
        self._threads = threads
        self._changed = threading.Condition()
        self._jobs: OrderedDict[str, _Job] = OrderedDict()
        self._waiting: deque[_Job] = deque()
        self._closing = False
        self._thread = threading.Thread(target=self._run, name='plans', daemon=True)
        self._thread.start()

    def take(self, text: str) -> None:
        """Take a request as `~/plan/request` carries it."""
        try:
            request = read_plan_request(text)
        except BadPlanError as error:
            self._refuse(error.id, error)
            return
        with self._changed:
            known = self._jobs.get(request.id)
            if known is None and request.cancel:
                reason = f'no plan with the id {request.id!r:.140} is known'
                self._refuse(request.id, OracleError(OracleCode.UNKNOWN_ID, reason))
            elif known is None:
                self._begin(request)
            elif request.cancel:
                self._cancel(known)
            elif known.request.content != request.content:
                reason = 'this id was used for another request; choose a new one for each'
                self._refuse(request.id, OracleError(OracleCode.ID_REUSED, reason))
            else:
                self._send(known.response)

    def refuse(self, reason: str) -> None:
        """Answer what could not be read."""
        self._refuse(None, OracleError(OracleCode.BAD_REQUEST, reason))

    def close(self, timeout: float) -> bool:
        """Begin no other plan; return whether the one in the making ended within `timeout` s."""
        with self._changed:
            self._closing = True
            for job in self._jobs.values():
                job.cancelled = True
            self._changed.notify()
        self._thread.join(timeout)
        return not self._thread.is_alive()

    def _begin(self, request: PlanRequest) -> None:
        job = _Job(request)
        self._jobs[request.id] = job
        if len(self._jobs) > REMEMBERED:
            self._forget()
        try:
            if len(self._waiting) >= MOST_WAITING:
                raise OracleError(OracleCode.BUSY, f'{MOST_WAITING} plans wait already')
            job.lying = self._look()
            self._check(request, job.lying)
        except OracleError as error:
            self._tell(job, PlanPhase.REJECTED, OracleCode(error.code), reason=error.reason)
            return
        self._tell(job, PlanPhase.ACCEPTED)
        self._waiting.append(job)
        self._changed.notify()

    def _check(self, request: PlanRequest, lying: Lying) -> None:
        def stop(_: int) -> None:
            raise Checked

        try:
            find_shots(lying.table, positions=lying.positions, on_round=stop, **request.search)
        except Checked:
            pass
        except ValueError as error:
            codes = {'goal': OracleCode.BAD_GOAL, 'noise': OracleCode.BAD_NOISE}
            code = codes.get(str(error).partition(':')[0], OracleCode.BAD_REQUEST)
            raise OracleError(code, str(error)) from None

    def _cancel(self, job: _Job) -> None:
        if job.phase in LAST:
            self._send(job.response)
            return
        job.cancelled = True
        if job in self._waiting:
            self._waiting.remove(job)
            self._tell_cancelled(job)

    def _forget(self) -> None:
        """Forget the oldest request that is over."""
        for request_id, job in self._jobs.items():
            if job.phase in LAST:
                del self._jobs[request_id]
                return

    def _run(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._closing or self._waiting)
                if self._closing:
                    return
                job = self._waiting.popleft()
            try:
                self._search(job)
            except Cancelled:
                self._tell_cancelled(job)
            except ClusterError as error:
                self._tell(job, PlanPhase.CANCELLED, OracleCode.FAILED, reason=str(error))
            except Exception as error:
                traceback.print_exc()
                reason = f'the search failed: {" ".join(str(error).split()):.300}'
                self._tell(job, PlanPhase.CANCELLED, OracleCode.FAILED, reason=reason)

    def _search(self, job: _Job) -> None:
        lying, told = job.lying, 0.0
        assert lying is not None, 'it was accepted'

        def on_round(played: int) -> None:
            nonlocal told
            if job.cancelled:
                raise Cancelled
            if time.monotonic() - told > PROGRESS_PERIOD:
                told = time.monotonic()
                self._tell(job, PlanPhase.PROGRESS, played=played)

        plan = find_shots(
            lying.table,
            positions=lying.positions,
            threads=self._threads,
            on_round=on_round,
            cluster=self._cluster,
            **job.request.search,
        )
        self._tell(job, PlanPhase.DONE, **plan_fields(plan, lying.table.labels, lying.positions))
        try:
            self._on_plan(plan, lying)
        except Exception:  # the request has its last response
            traceback.print_exc()

    def _tell_cancelled(self, job: _Job) -> None:
        reason = 'somebody cancelled it'
        self._tell(job, PlanPhase.CANCELLED, OracleCode.CANCELLED, reason=reason)

    def _tell(
        self, job: _Job, phase: PlanPhase, code: OracleCode = OracleCode.OK, **more: Any
    ) -> None:
        job.response = plan_response(job.request.id, phase, code, **more)
        job.phase = phase
        self._send(job.response)

    def _refuse(self, request_id: str | None, error: OracleError) -> None:
        code = OracleCode(error.code)
        self._send(plan_response(request_id, PlanPhase.REJECTED, code, reason=error.reason))
