"""Playing a computed shot back, tick by tick: a state machine without ROS, clock or thread."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from dataclasses import dataclass
from enum import Enum

import numpy as np

from pool_sim_ros.physics import Trajectory
from pool_sim_ros.physics.record import STOPPED
from pool_sim_ros.protocol import COLLISION_COLUMNS

NANOSECOND = 1e-9
SECOND_NS = 1_000_000_000

BLOCK = 64
"""Ticks that are looked up at once: one look-up costs about as much as 64 more times in it."""


class Motion(Enum):
    """What the balls are doing."""

    AT_REST = 'at rest'
    COMPUTING = 'at rest while a shot is computed'
    READY = 'at rest until the next tick, which starts the shot'
    MOVING = 'moving'


@dataclass(frozen=True)
class Frame:
    """What one tick shows.

    Attributes
    ----------
    tick : int
        Its number, from 0.
    stamp : int
        Its sim time, ns.
    positions, velocities : ndarray of shape (n, 2)
        m, m/s.
    collisions : ndarray of shape (k, 10)
        Contacts since the last frame, in the columns `COLLISION_COLUMNS`; each is at or before
        this frame's stamp.
    started, finished : bool
        Whether this is a shot's first frame, or the first in which all balls are at rest again.
    """

    tick: int
    stamp: int
    positions: np.ndarray
    velocities: np.ndarray
    collisions: np.ndarray
    started: bool = False
    finished: bool = False


class Playback:
    """The balls over time.

    A shot goes through `strike`, `computed`, the frame that starts it and the frame in which all
    balls are at rest again. Until the frame that starts it, frames show the balls where the last
    shot left them, also where the shot starts from another layout: a shot and the layout that it
    starts from appear in one tick, so that this tick alone tells when it was played.

    Time is the tick; it never goes back, and pausing only means that nobody asks for frames.

    Parameters
    ----------
    layout : ndarray of shape (n, 2)
        Where the balls are, m.
    rate : int
        Ticks per second of sim time.
    paused : bool, optional
        Whether to start paused.
    """

    def __init__(self, layout: np.ndarray, rate: int, paused: bool = False) -> None:
        self.rate = rate
        self.paused = paused
        self.motion = Motion.AT_REST
        self.next_tick = 0
        self._at_rest = np.array(layout, dtype=float)
        self._trajectory: Trajectory | None = None
        self._start_tick = 0
        self._block_tick = 0
        self._block_positions = self._block_velocities = np.empty((0, *self._at_rest.shape))
        self._no_collisions = np.empty((0, len(COLLISION_COLUMNS)))
        self._collisions = self._no_collisions
        self._collision_times: list[float] = []
        self._next_collision = 0
        self._next_seq = 0

    @property
    def tick(self) -> int:
        """The latest tick shown; 0 before the first."""
        return max(self.next_tick - 1, 0)

    @property
    def stamp(self) -> int:
        """Sim time of `tick`, ns."""
        return self.stamp_of(self.tick)

    @property
    def start_time(self) -> float:
        """Sim time at which the shot now played, or the last one, started, s."""
        return self.stamp_of(self._start_tick) * NANOSECOND

    @property
    def positions(self) -> np.ndarray:
        """Where the balls rest, or rested when the shot now played began, (n, 2), m."""
        return self._at_rest

    def stamp_of(self, tick: int) -> int:
        """Return the sim time of a tick, ns; never accumulated."""
        return tick * SECOND_NS // self.rate

    def strike(self) -> None:
        """Note that a shot is being computed; the balls must be at rest."""
        if self.motion is not Motion.AT_REST:
            raise RuntimeError(f'strike while {self.motion.value}')
        self.motion = Motion.COMPUTING

    def computed(self, trajectory: Trajectory) -> None:
        """Take the shot that was being computed; the next tick starts it."""
        if self.motion is not Motion.COMPUTING:
            raise RuntimeError(f'a shot was computed while {self.motion.value}')
        self._trajectory = trajectory
        self.motion = Motion.READY

    def abandon(self) -> None:
        """Drop the shot that is being computed; the balls stay where they are."""
        if self.motion is not Motion.COMPUTING:
            raise RuntimeError(f'abandon while {self.motion.value}')
        self.motion = Motion.AT_REST

    def reset(self, layout: np.ndarray) -> None:
        """Drop any shot; the next tick shows the balls at rest on this layout, (n, 2), m."""
        self._at_rest = np.array(layout, dtype=float)
        self._trajectory = None
        self.motion = Motion.AT_REST

    def next_frame(self) -> Frame:
        """Go on by one tick and return what it shows."""
        tick, stamp = self.next_tick, self.stamp_of(self.next_tick)
        self.next_tick += 1
        started = self.motion is Motion.READY
        if started:
            self._start(tick)
        if self.motion is not Motion.MOVING:
            resting = np.zeros_like(self._at_rest)
            return Frame(tick, stamp, self._at_rest, resting, self._no_collisions)

        shot = self._trajectory
        time = (stamp - self.stamp_of(self._start_tick)) * NANOSECOND
        finished = time >= shot.duration
        if finished:
            positions, velocities = shot.final_positions, shot.final_velocities
            collisions = self._collisions_until(len(self._collisions))
            self.reset(positions)
        else:
            positions, velocities = self._look_up(tick)
            end = bisect_right(self._collision_times, stamp * NANOSECOND, self._next_collision)
            collisions = self._collisions_until(end)
        return Frame(tick, stamp, positions, velocities, collisions, started, finished)

    def _start(self, tick: int) -> None:
        self.motion = Motion.MOVING
        self._start_tick = tick
        events = self._trajectory.events
        contacts = events[events['kind'] != STOPPED]
        columns = [contacts[name] for name in COLLISION_COLUMNS[1:]]
        self._collisions = np.column_stack([np.zeros(len(contacts)), *columns])
        self._collisions[:, 1] += self.start_time
        self._collision_times = self._collisions[:, 1].tolist()
        self._next_collision = 0
        self._block_positions = self._block_velocities = self._block_positions[:0]

    def _look_up(self, tick: int) -> tuple[np.ndarray, np.ndarray]:
        index = tick - self._block_tick
        if index >= len(self._block_positions):
            start, shot = self.stamp_of(self._start_tick), self._trajectory
            ticks = range(tick, tick + BLOCK)
            times = [(self.stamp_of(later) - start) * NANOSECOND for later in ticks]
            times = times[: bisect_left(times, shot.duration)]
            self._block_positions = shot.positions(times)
            self._block_velocities = shot.velocities(times)
            self._block_tick, index = tick, 0
        return self._block_positions[index], self._block_velocities[index]

    def _collisions_until(self, end: int) -> np.ndarray:
        # Numbered here and not at the start: a reset drops the rest, and seq must have no gap.
        if end == self._next_collision:
            return self._no_collisions
        rows = self._collisions[self._next_collision : end]
        rows[:, 0] = np.arange(self._next_seq, self._next_seq + len(rows))
        self._next_seq += len(rows)
        self._next_collision += len(rows)
        return rows
