"""Playing a computed shot back, tick by tick: a state machine without ROS, clock or thread."""

from __future__ import annotations

from enum import Enum
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import EventKind, Trajectory
from pool_sim_ros.simulator.frame import COLLISION_COLUMNS, NO_COLLISIONS, Block, Frame
from pool_sim_ros.simulator.sim_time import stamp_to_seconds, tick_to_stamp

BLOCK = 64
"""Ticks that are looked up, and made into messages, together: one costs about as much as all."""

BLOCK_BALLS = 4096
"""Most balls in a block, counted over all its ticks: it bounds how long a large table takes."""


class Motion(Enum):
    """What the balls are doing."""

    AT_REST = 'at rest'
    COMPUTING = 'at rest while a shot is computed'
    READY = 'at rest until the next tick, which starts the shot'
    MOVING = 'moving'


class Playback:
    """The balls over time.

    A shot goes through `strike`, `computed`, the frame that starts it and the frame in which all
    balls are at rest again. Until the frame that starts it, frames show the balls where the last
    shot left them, even if the shot starts from another layout: a shot and its start layout appear
    in one tick, so this tick alone tells when the shot was played.

    Time is the tick. It never goes back; while paused, nobody asks for frames.

    Parameters
    ----------
    layout : ndarray of shape (n, 2)
        Positions of the balls, m.
    rate : int
        Ticks per second of sim time.
    """

    def __init__(self, layout: NDArray[np.float64], rate: int) -> None:
        self.motion = Motion.AT_REST
        self.rate = rate
        self.next_tick = 0
        self._block_length = min(max(BLOCK_BALLS // len(layout), 1), BLOCK)
        self._trajectory: Trajectory | None = None
        self._start_tick = 0
        self._collisions = NO_COLLISIONS
        self._first_seq = self._next_seq = 0
        self._block: Block | None = None
        self.reset(layout)

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
        """Sim time at which the latest shot starts or started, s."""
        return stamp_to_seconds(self.stamp_of(self._start_tick))

    @property
    def positions(self) -> NDArray[np.float64]:
        """Where the balls rest, or rested before the shot that moves them, (n, 2), m."""
        positions: NDArray[np.float64] = self._resting[0]
        return positions

    def stamp_of(self, tick: int) -> int:
        """Return the sim time of a tick, ns; it is never accumulated."""
        return tick_to_stamp(tick, self.rate)

    def strike(self) -> None:
        """Note that a shot is being computed; the balls must be at rest."""
        if self.motion is not Motion.AT_REST:
            raise RuntimeError(f'strike while {self.motion.value}')
        self.motion = Motion.COMPUTING

    def computed(self, trajectory: Trajectory) -> None:
        """Take the shot that was being computed; the next tick starts it."""
        if self.motion is not Motion.COMPUTING:
            raise RuntimeError(f'a shot was computed while {self.motion.value}')
        self.motion = Motion.READY
        self._trajectory = trajectory
        self._start_tick = self.next_tick
        self._first_seq = self._next_seq
        self._collisions = self._collisions_of(trajectory)
        self._block = None

    def abandon(self) -> None:
        """Drop the shot that is being computed; the balls stay where they are."""
        if self.motion is not Motion.COMPUTING:
            raise RuntimeError(f'abandon while {self.motion.value}')
        self.motion = Motion.AT_REST

    def reset(self, layout: NDArray[np.float64]) -> None:
        """Drop any shot; the next tick shows the balls at rest on this layout, (n, 2), m."""
        self.motion = Motion.AT_REST
        self._resting = np.repeat(np.array([layout], dtype=float), self._block_length, axis=0)
        self._trajectory = None
        self._block = None

    def look_ahead(self) -> Block:
        """Return the block of the next tick; it is kept, and nothing else changes."""
        if self._block is None or self._block.end_tick == self.next_tick:
            shot = self._trajectory
            self._block = self._resting_block() if shot is None else self._moving_block(shot)
        return self._block

    def next_frame(self) -> Frame:
        """Go on by one tick and return what it shows."""
        block, tick = self.look_ahead(), self.next_tick
        index = tick - block.first_tick
        collisions = block.collisions[index]
        self.next_tick += 1
        if not block.moving:
            return Frame(block, index, tick, collisions)
        started = self.motion is Motion.READY
        self.motion = Motion.MOVING
        self._next_seq += len(collisions)
        finished = block.ends_shot and self.next_tick == block.end_tick
        if finished:
            self.reset(block.positions[index])
        return Frame(block, index, tick, collisions, started, finished)

    def _collisions_of(self, trajectory: Trajectory) -> NDArray[np.float64]:
        """Return all collisions of the shot that starts next, (k, 10)."""
        events = trajectory.events
        contacts = events[events['kind'] != EventKind.STOP]
        # A reset drops those not shown yet, and the next shot uses their numbers: seq has no gap.
        seq = np.arange(self._next_seq, self._next_seq + len(contacts), dtype=float)
        rows = np.column_stack([seq, *(contacts[name] for name in COLLISION_COLUMNS[1:])])
        rows[:, 1] += self.start_time
        return rows

    def _next_stamps(self) -> NDArray[np.int64]:
        ticks = range(self.next_tick, self.next_tick + self._block_length)
        return np.array([self.stamp_of(tick) for tick in ticks], dtype=np.int64)

    def _resting_block(self) -> Block:
        stamps = self._next_stamps().tolist()
        return Block(
            self.next_tick,
            self.next_tick + len(stamps),
            stamps,
            self._resting,
            np.zeros_like(self._resting),
            [NO_COLLISIONS] * len(stamps),
        )

    def _moving_block(self, shot: Trajectory) -> Block:
        stamps = self._next_stamps()
        times = stamp_to_seconds(stamps - self.stamp_of(self._start_tick))
        moving = int(np.searchsorted(times, shot.duration))
        ends_shot = moving < len(times)
        positions, velocities = shot.positions(times[:moving]), shot.velocities(times[:moving])
        if ends_shot:
            stamps = stamps[: moving + 1]
            positions = np.concatenate([positions, [shot.final_positions]])
            velocities = np.concatenate([velocities, [shot.final_velocities]])
        return Block(
            self.next_tick,
            self.next_tick + len(stamps),
            stamps.tolist(),
            positions,
            velocities,
            self._next_collisions(stamps, ends_shot),
            moving=True,
            ends_shot=ends_shot,
        )

    def _next_collisions(
        self, stamps: NDArray[np.int64], to_the_end: bool
    ) -> list[NDArray[np.float64]]:
        """Return the collisions of each of the next ticks, with `to_the_end` all that are left."""
        ends = np.searchsorted(self._collisions[:, 1], stamp_to_seconds(stamps), 'right')
        if to_the_end:
            ends[-1] = len(self._collisions)
        shown = self._next_seq - self._first_seq
        return [
            self._collisions[start:end] if start < end else NO_COLLISIONS
            for start, end in pairwise([shown, *ends.tolist()])
        ]
