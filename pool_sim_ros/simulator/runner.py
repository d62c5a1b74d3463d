"""Plays a simulation in real time: one thread shows the frames, another computes the shots."""

from __future__ import annotations

import math
import threading
import time
import traceback
from collections.abc import Sequence
from concurrent.futures import Future

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import ShotCancelled, Trajectory, compile_kernels
from pool_sim_ros.simulator.command_log import CommandLog
from pool_sim_ros.simulator.health import Health, energy_rise
from pool_sim_ros.simulator.job import Job
from pool_sim_ros.simulator.naps import is_just_before, nap
from pool_sim_ros.simulator.output import Output
from pool_sim_ros.simulator.pacer import Pacer
from pool_sim_ros.simulator.settings import Settings
from pool_sim_ros.simulator.shot_request import (
    Phase,
    Request,
    Response,
    parse_request,
    twist_request,
)
from pool_sim_ros.simulator.sim_time import stamp_to_seconds
from pool_sim_ros.simulator.simulation import Simulation
from pool_sim_ros.simulator.steps import Stepped, Steps
from pool_sim_ros.simulator.worker import Worker

STATE_PERIOD = 1.0
"""Seconds between two states while nothing changes: a heartbeat for clients."""

PAUSED_CLOCK_PERIOD = 0.1
"""Seconds between two clock messages while paused: a late subscriber must not wait long."""

LONGEST_BATCH = 0.002
"""Longest row of frames under the lock, in s of wall time: it bounds how long a request waits."""

BUSY_PERIOD = 0.05
"""Seconds after a request in which another one is expected."""

HEALTH_PERIOD = 1.0
"""Seconds between two diagnostics; their readers expect one a second."""

COMPILE_NOTICE = 1.0
"""Seconds after which the kernels are being compiled, not merely loaded."""


class Runner:
    """Plays a simulation in real time.

    One lock guards the simulation, the pacer and the order of what is sent. A thread that holds it
    may use all three, and must not compute or sleep. Any thread may call any method.

    Parameters
    ----------
    settings : Settings
    output : Output
    log : CommandLog, optional
        Where to record; `stop` closes it.
    """

    def __init__(self, settings: Settings, output: Output, log: CommandLog | None = None) -> None:
        self.ready = threading.Event()
        """Set once the kernels are compiled and the output was told so."""
        self._simulation = Simulation(settings, log=log)
        self._health = Health()
        self._pacer = Pacer(settings.publish_rate, settings.real_time_factor)
        self._output = output
        self._lock = threading.Lock()
        self._steps = Steps(self._simulation, self._show_next_frame)
        self._stopping = threading.Event()
        self._shown_state: dict[str, object] = {}
        self._shown_pocketed = 0
        now = time.monotonic()
        self._last_request = self._next_state = self._next_clock = self._next_health = now
        output.table(settings)
        self._worker = Worker('compute', self._prepare)
        self._playing = threading.Thread(target=self._play, name='playback', daemon=True)
        self._playing.start()

    def request(self, text: str) -> Response:
        """Take and answer a request as `~/shot/request` carries it."""
        return self.take(parse_request(text))

    def strike(self, linear: Sequence[float], angular: Sequence[float]) -> Response:
        """Take and answer a twist of the cue ball, (3,) m/s and (3,) rad/s."""
        spins = self._simulation.settings.table.motion == 'ball'
        return self.take(twist_request(linear, angular, spins))

    def take(self, request: Request) -> Response:
        """Take and answer a request."""
        with self._lock:
            return self._answer(*self._simulation.take(request))

    def refuse(self, reason: str) -> None:
        """Note that a command was refused before it was read."""
        with self._lock:
            self._health.rejected(reason)

    def reset(self) -> bool:
        """Put the balls back on the start layout; return whether a shot was preempted."""
        with self._lock:
            preempted = self._simulation.reset()
            self._output.responses(preempted)
            self._show_state()
            return bool(preempted)

    def place(self, positions: NDArray[np.float64], frame_id: str = '') -> str | None:
        """Put the balls at (k, 2) positions in m in a frame; return why this cannot be, or None."""
        with self._lock:
            self._last_request = time.monotonic()
            refusal = self._simulation.place(positions, frame_id)
            if refusal is not None:
                self._health.rejected(f'set_ball_poses: {refusal}')
            self._show_state()
            return refusal

    def set_paused(self, paused: bool) -> None:
        """Pause or resume."""
        with self._lock:
            self._simulation.paused = paused
            self._pacer.restart()
            self._show_state()

    def step(self) -> Future[Stepped]:
        """Advance by `step_ticks` while paused; the result says whether this was done, and more.

        While a shot is being computed the result comes later, from another thread.
        """
        with self._lock:
            return self._steps.add()

    def apply(self, settings: Settings) -> None:
        """Take new settings; what concerns a shot counts from the next strike."""
        with self._lock:
            old, self._simulation.settings = self._simulation.settings, settings
            if settings.table != old.table:
                self._output.table(settings)
            if settings.real_time_factor != old.real_time_factor:
                self._pacer.real_time_factor = settings.real_time_factor
            self._show_state()

    def stop(self, timeout: float) -> bool:
        """Send nothing more; return whether the shot being computed ended within `timeout` s."""
        self._stopping.set()
        self._playing.join()
        with self._lock:  # the other thread may be handing over a result
            self._simulation.close()
            self._steps.close()
        return self._worker.stop(timeout)

    @property
    def _running(self) -> bool:
        return not self._stopping.is_set() and self._output.is_open()

    def _answer(self, response: Response, job: Job | None) -> Response:
        self._last_request = time.monotonic()
        if response.phase is Phase.REJECTED:
            self._health.rejected(f'{response.code.value}: {response.reason}')
        self._output.responses([response, *self._simulation.more_responses()])
        self._show_state()
        if job is not None:
            self._worker.submit(lambda: self._compute(job))
        return response

    def _prepare(self) -> None:
        notice = threading.Timer(COMPILE_NOTICE, self._tell_of_compiling)
        notice.daemon = True
        notice.start()
        try:
            compile_kernels(self._simulation.settings.table)
            if self._running:
                self._output.tell('ready')
                self.ready.set()
        except Exception:
            self._fail('the physics kernels could not be compiled')
        finally:
            notice.cancel()

    def _tell_of_compiling(self) -> None:
        if self._running:
            self._output.tell(
                'compiling the physics kernels, on the first run only: this takes about 20 s'
            )

    def _compute(self, job: Job) -> None:
        start, rise = time.monotonic(), None
        result: Trajectory | Exception
        try:
            result = job.run()
            took = time.monotonic() - start
            rise = energy_rise(result)
        except ShotCancelled:
            return
        except Exception as error:
            result, took = error, time.monotonic() - start
        try:
            with self._lock:
                self._health.shot(took, rise, job.table.ball_friction == 'report')
                if self._running:
                    self._output.responses(self._simulation.computed(job, result))
                    self._look_ahead()
                    self._show_state()
        except Exception:
            self._fail('a shot could not be taken over')

    def _play(self) -> None:
        just_before = False
        try:
            while not self._stopping.is_set():
                with self._lock:
                    self._steps.serve()
                    due = time.monotonic() + self._show_due_frames()
                    if not just_before:
                        self._show_signs_of_life()
                        self._look_ahead()
                    # What was done meanwhile took some of the time until the next frame.
                    wait = min(due - time.monotonic(), self._steps.wait)
                time.sleep(nap(wait, time.monotonic() - self._last_request < BUSY_PERIOD))
                just_before = is_just_before(wait) and not just_before
        except Exception:
            self._fail('playback failed')

    def _look_ahead(self) -> None:
        """Prepare what comes next while there is time for it."""
        self._output.prepare(self._simulation.look_ahead())

    def _show_due_frames(self) -> float:
        """Show all frames that are due; return the seconds until the next one, inf while paused."""
        if self._simulation.paused:
            return math.inf
        end = time.monotonic() + LONGEST_BATCH
        while (wait := self._pacer.wait(self._simulation.moving)) <= 0.0:
            self._show_next_frame()
            self._pacer.shown()
            self._health.frame(self._pacer.lateness)
            if time.monotonic() > end:
                return 0.0
        return wait

    def _show_next_frame(self) -> None:
        frame, responses = self._simulation.next_frame()
        self._output.frame(frame)
        if frame.started or frame.finished or len(frame.pocketed) != self._shown_pocketed:
            self._show_state()
            self._output.responses(responses)

    def _show_signs_of_life(self) -> None:
        now = time.monotonic()
        if now >= self._next_state:
            self._show_state(always=True)
        if self._simulation.paused and now >= self._next_clock:
            self._output.clock(self._simulation.stamp)
            self._next_clock = max(self._next_clock + PAUSED_CLOCK_PERIOD, now)
        if now >= self._next_health:
            self._next_health = now + HEALTH_PERIOD
            self._show_health(now)

    def _show_health(self, now: float) -> None:
        stamp, pacer = self._simulation.stamp, self._pacer
        behind = 0 if self._simulation.paused else pacer.ticks_behind
        diagnosis = self._health.diagnose(now, stamp, pacer.real_time_factor, behind, pacer.slips)
        self._output.diagnostics(stamp, diagnosis)

    def _show_state(self, always: bool = False) -> None:
        """Send the state if anything but the time has changed in it, or `always`."""
        simulation = self._simulation
        state: dict[str, object] = {
            'paused': simulation.paused,
            'moving': simulation.moving,
            'computing': simulation.computing,
            'real_time_factor': self._pacer.real_time_factor,
            'pocketed': simulation.pocketed,
        }
        if state == self._shown_state and not always:
            return
        self._shown_state = state
        self._shown_pocketed = len(simulation.pocketed)
        self._next_state = time.monotonic() + STATE_PERIOD
        sim_time = stamp_to_seconds(simulation.stamp)
        self._output.state({**state, 'tick': simulation.tick, 'sim_time': sim_time})

    def _fail(self, what: str) -> None:
        if self._running:  # otherwise it failed because ROS was shut down meanwhile
            self._output.fail(f'{what}:\n{traceback.format_exc()}')
