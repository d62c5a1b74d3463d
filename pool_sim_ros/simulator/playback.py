"""Playing a computed shot back, tick by tick: a state machine without ROS, clock or thread."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import EventKind, Trajectory
from pool_sim_ros.simulator.frame import (
    COLLISION_COLUMNS,
    NO_COLLISIONS,
    SPIN_COLUMNS,
    VELOCITY_COLUMNS,
    Block,
    Frame,
)
from pool_sim_ros.simulator.layout import Layout
from pool_sim_ros.simulator.sim_time import stamp_to_seconds, tick_to_stamp
from pool_sim_ros.simulator.turning import Turning

BLOCK = 64
"""Ticks that are looked up, and made into messages, together: one costs about as much as all."""

BLOCK_BALLS = 4096
"""Most balls in a block, counted over all its ticks: it bounds how long a large table takes."""

SHOWN_KINDS = (EventKind.BALL_BALL, EventKind.CUSHION, EventKind.POCKETED)
"""The events that are collisions; that a ball rolls or stops is none."""

KIND, BALL = COLLISION_COLUMNS.index('kind'), COLLISION_COLUMNS.index('a')


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
    layout : Layout
        How the balls lie at first.
    rate : int
        Ticks per second of sim time.
    """

    def __init__(self, layout: Layout, rate: int) -> None:
        self.motion = Motion.AT_REST
        self.rate = rate
        self.next_tick = 0
        self._block_length = min(max(BLOCK_BALLS // len(layout.positions), 1), BLOCK)
        self._trajectory: Trajectory | None = None
        self._turning: Turning | None = None
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
        return self.time_of(self._start_tick)

    @property
    def layout(self) -> Layout:
        """How the balls lie at rest, or lay before the shot that moves them."""
        return self._layout

    @property
    def pocketed(self) -> tuple[int, ...]:
        """The balls in pockets, in the order in which they fell, as the latest tick of a shot has
        it, or as they lie at rest."""
        return self._pocketed if self.motion is Motion.MOVING else self._layout.pocketed

    @property
    def positions(self) -> NDArray[np.float64]:
        """Where the balls rest, or rested before the shot that moves them, (n, 2), m."""
        return self._layout.positions

    def stamp_of(self, tick: int) -> int:
        """Return the sim time of a tick, ns; it is never accumulated."""
        return tick_to_stamp(tick, self.rate)

    def time_of(self, tick: int) -> float:
        """Return the sim time of a tick, s."""
        return stamp_to_seconds(self.stamp_of(tick))

    def strike(self) -> None:
        """Note that a shot is being computed; the balls must be at rest."""
        if self.motion is not Motion.AT_REST:
            raise RuntimeError(f'strike while {self.motion.value}')
        self.motion = Motion.COMPUTING

    def computed(self, trajectory: Trajectory, start: Layout | None = None) -> None:
        """Take the shot that was being computed; the next tick starts it.

        Parameters
        ----------
        trajectory : Trajectory
        start : Layout, optional
            How the balls lie when it starts; by default as they rest.
        """
        if self.motion is not Motion.COMPUTING:
            raise RuntimeError(f'a shot was computed while {self.motion.value}')
        self.motion = Motion.READY
        self._trajectory = trajectory
        start = self._layout if start is None else start
        self._pocketed = start.pocketed
        turned = start.orientations
        self._turning = None if turned is None else Turning(trajectory, turned)
        self._start_tick = self.next_tick
        self._first_seq = self._next_seq
        self._collisions = self._collisions_of(trajectory)
        self._block = None

    def abandon(self) -> None:
        """Drop the shot that is being computed; the balls stay where they are."""
        if self.motion is not Motion.COMPUTING:
            raise RuntimeError(f'abandon while {self.motion.value}')
        self.motion = Motion.AT_REST

    def reset(self, layout: Layout) -> None:
        """Drop any shot; the next tick shows the balls at rest on this layout."""
        self.motion = Motion.AT_REST
        self._layout = layout
        self._pocketed = layout.pocketed
        self._resting = self._repeated(layout.positions)
        turned = layout.orientations
        self._turned = None if turned is None else self._repeated(turned)
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
        self._pocketed = block.pocketed[index]
        finished = block.ends_shot and self.next_tick == block.end_tick
        if finished:
            turned = None if block.orientations is None else block.orientations[index]
            self.reset(Layout(block.positions[index], turned, self._pocketed))
        return Frame(block, index, tick, collisions, started, finished)

    def _collisions_of(self, trajectory: Trajectory) -> NDArray[np.float64]:
        """Return all collisions of the shot that starts next, (k, 10)."""
        events = trajectory.events
        contacts = events[np.isin(events['kind'], SHOWN_KINDS)]
        # A reset drops those not shown yet, and the next shot uses their numbers: seq has no gap.
        seq = np.arange(self._next_seq, self._next_seq + len(contacts), dtype=float)
        rows = np.column_stack([seq, *(contacts[name] for name in COLLISION_COLUMNS[1:])])
        rows[:, 1] += self.start_time
        return rows

    def _next_stamps(self) -> NDArray[np.int64]:
        ticks = range(self.next_tick, self.next_tick + self._block_length)
        return np.array([self.stamp_of(tick) for tick in ticks], dtype=np.int64)

    def _repeated(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.repeat(np.array([values], dtype=float), self._block_length, axis=0)

    def _resting_block(self) -> Block:
        stamps = self._next_stamps().tolist()
        m, n, _ = self._resting.shape
        columns = VELOCITY_COLUMNS if self._turned is None else SPIN_COLUMNS
        return Block(
            self.next_tick,
            self.next_tick + len(stamps),
            stamps,
            self._resting,
            np.zeros((m, n, len(columns))),
            [NO_COLLISIONS] * len(stamps),
            orientations=self._turned,
            pocketed=[self._layout.pocketed] * len(stamps),
        )

    def _moving_block(self, shot: Trajectory) -> Block:
        stamps = self._next_stamps()
        times = stamp_to_seconds(stamps - self.stamp_of(self._start_tick))
        moving = int(np.searchsorted(times, shot.duration))
        ends_shot = moving < len(times)
        positions, velocities = shot.positions(times[:moving]), shot.velocities(times[:moving])
        orientations = None
        if self._turning is not None:
            until = np.append(times[:moving], shot.duration) if ends_shot else times[:moving]
            orientations = self._turning.at(until)
            velocities = np.concatenate([velocities, shot.spins(times[:moving])], axis=2)
        if ends_shot:
            stamps = stamps[: moving + 1]
            positions = np.concatenate([positions, [shot.final_positions]])
            rest = np.zeros(velocities.shape[1:])
            rest[:, :2] = shot.final_velocities
            velocities = np.concatenate([velocities, [rest]])
        collisions = self._next_collisions(stamps, ends_shot)
        return Block(
            self.next_tick,
            self.next_tick + len(stamps),
            stamps.tolist(),
            positions,
            velocities,
            collisions,
            moving=True,
            ends_shot=ends_shot,
            orientations=orientations,
            pocketed=self._next_pocketed(collisions),
        )

    def _next_pocketed(self, collisions: Sequence[NDArray[np.float64]]) -> list[tuple[int, ...]]:
        """Return the balls in pockets at each of the next ticks, given the collisions of each."""
        pocketed, each = self._pocketed, []
        for rows in collisions:
            caught = rows[rows[:, KIND] == EventKind.POCKETED, BALL]
            pocketed = (*pocketed, *map(int, caught)) if len(caught) else pocketed
            each.append(pocketed)
        return each

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
