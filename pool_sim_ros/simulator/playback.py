"""Playing a computed shot back, tick by tick: a state machine without ROS, clock or thread."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from itertools import pairwise

import numpy as np

from pool_sim_ros.physics import EventKind, Trajectory
from pool_sim_ros.simulator.shot_request import COLLISION_COLUMNS

NANOSECOND = 1e-9
SECOND_NS = 1_000_000_000

BLOCK = 64
"""Ticks that are looked up, and made into messages, at once: one costs about as much as all."""

BLOCK_BALLS = 4096
"""Balls in a block, all ticks together, where there are many: it bounds how long that takes."""

NO_COLLISIONS = np.empty((0, len(COLLISION_COLUMNS)))


class Motion(Enum):
    """What the balls are doing."""

    AT_REST = 'at rest'
    COMPUTING = 'at rest while a shot is computed'
    READY = 'at rest until the next tick, which starts the shot'
    MOVING = 'moving'


@dataclass(eq=False, slots=True)
class Block:
    """What a row of ticks shows, if nothing comes between.

    Attributes
    ----------
    first_tick, end_tick : int
        The first one, and the one after the last.
    stamps : list of int
        Sim time of each, ns.
    positions, velocities : ndarray of shape (m, n, 2)
        m, m/s. While the balls rest the positions stay one and the same array, block after block.
    collisions : list of ndarray of shape (k, 10)
        Of each, as `Frame.collisions`.
    moving : bool
        Whether a shot is played in it.
    ends_shot : bool
        Whether the last tick is the first in which all balls are at rest again.
    """

    first_tick: int
    end_tick: int
    stamps: list[int]
    positions: np.ndarray
    velocities: np.ndarray
    collisions: list[np.ndarray]
    moving: bool = False
    ends_shot: bool = False


@dataclass(eq=False, slots=True)
class Frame:
    """What one tick shows.

    Attributes
    ----------
    block : Block
        The ticks that were looked up with it.
    index : int
        Its place among these.
    tick : int
        Its number, from 0.
    collisions : ndarray of shape (k, 10)
        Contacts since the last frame, in the columns `COLLISION_COLUMNS`; each is at or before
        this frame's stamp.
    started, finished : bool
        Whether this is a shot's first frame, or the first in which all balls are at rest again.
    """

    block: Block
    index: int
    tick: int
    collisions: np.ndarray
    started: bool = False
    finished: bool = False

    @property
    def stamp(self) -> int:
        """Its sim time, ns."""
        return self.block.stamps[self.index]

    @property
    def positions(self) -> np.ndarray:
        """Where the balls are, (n, 2), m."""
        return self.block.positions[self.index]

    @property
    def velocities(self) -> np.ndarray:
        """How fast they move, (n, 2), m/s."""
        return self.block.velocities[self.index]

    @property
    def moving(self) -> bool:
        """Whether any ball moves."""
        return self.block.moving and not self.finished


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
        self.next_tick = 0
        self._start_tick = 0
        self._block_length = min(max(BLOCK_BALLS // len(layout), 1), BLOCK)
        self._collisions = NO_COLLISIONS
        self._next_seq = 0
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
        """Sim time at which the shot now played, or the last one, started, s."""
        return self.stamp_of(self._start_tick) * NANOSECOND

    @property
    def positions(self) -> np.ndarray:
        """Where the balls rest, or rested when the shot now played began, (n, 2), m."""
        return self._resting[0]

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
        self._block = None
        self.motion = Motion.READY

    def abandon(self) -> None:
        """Drop the shot that is being computed; the balls stay where they are."""
        if self.motion is not Motion.COMPUTING:
            raise RuntimeError(f'abandon while {self.motion.value}')
        self.motion = Motion.AT_REST

    def reset(self, layout: np.ndarray) -> None:
        """Drop any shot; the next tick shows the balls at rest on this layout, (n, 2), m."""
        self.motion = Motion.AT_REST
        self._resting = np.repeat(np.array([layout], dtype=float), self._block_length, axis=0)
        self._trajectory: Trajectory | None = None
        self._block: Block | None = None

    def look_ahead(self) -> Block:
        """Return the block of the next tick; looked up here, unless it already is."""
        block = self._block
        if block is None or block.end_tick == self.next_tick:
            if self.motion is Motion.READY:
                self._begin()
            at_rest = self._trajectory is None
            block = self._block = self._resting_block() if at_rest else self._moving_block()
        return block

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

    def _begin(self) -> None:
        self._start_tick = self.next_tick
        events = self._trajectory.events
        contacts = events[events['kind'] != EventKind.STOP]
        columns = [contacts[name] for name in COLLISION_COLUMNS[1:]]
        self._collisions = np.column_stack([np.zeros(len(contacts)), *columns])
        self._collisions[:, 1] += self.start_time

    def _next_stamps(self) -> np.ndarray:
        first = self.next_tick
        return np.array([self.stamp_of(tick) for tick in range(first, first + self._block_length)])

    def _resting_block(self) -> Block:
        stamps = self._next_stamps()
        velocities = np.zeros_like(self._resting)
        return self._block_of(stamps, self._resting, velocities, [NO_COLLISIONS] * len(stamps))

    def _moving_block(self) -> Block:
        shot, stamps = self._trajectory, self._next_stamps()
        times = (stamps - self.stamp_of(self._start_tick)) * NANOSECOND
        moving = int(np.searchsorted(times, shot.duration))
        ends_shot = moving < len(times)
        positions, velocities = shot.positions(times[:moving]), shot.velocities(times[:moving])
        if ends_shot:
            stamps = stamps[: moving + 1]
            positions = np.concatenate([positions, [shot.final_positions]])
            velocities = np.concatenate([velocities, [shot.final_velocities]])
        collisions = self._next_collisions(stamps, ends_shot)
        return self._block_of(stamps, positions, velocities, collisions, True, ends_shot)

    def _next_collisions(self, stamps: np.ndarray, to_the_end: bool) -> list[np.ndarray]:
        """Take those of the next ticks from what is left."""
        ends = np.searchsorted(self._collisions[:, 1], stamps * NANOSECOND, 'right')
        if to_the_end:
            ends[-1] = len(self._collisions)
        taken, self._collisions = self._collisions[: ends[-1]], self._collisions[ends[-1] :]
        # Numbered here and not at the start: a reset drops the rest, and seq must have no gap.
        taken[:, 0] = np.arange(self._next_seq, self._next_seq + len(taken))
        return [
            taken[start:end] if start < end else NO_COLLISIONS
            for start, end in pairwise([0, *ends.tolist()])
        ]

    def _block_of(self, stamps: np.ndarray, *shown) -> Block:
        first = self.next_tick
        return Block(first, first + len(stamps), stamps.tolist(), *shown)
