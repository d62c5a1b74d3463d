"""What somebody sees of a simulator who looks only when he is asked: its table, its balls."""

from __future__ import annotations

import time
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from rclpy.context import Context

from pool_sim_ros.physics import Table
from pool_sim_ros.ros import interface
from pool_sim_ros.ros.cdr_reader import read_poses
from pool_sim_ros.ros.inbox import Inbox
from pool_sim_ros.ros.oracle_error import OracleCode, OracleError
from pool_sim_ros.ros.simulator_link import SimulatorLink
from pool_sim_ros.simulator import (
    SECOND_NS,
    Phase,
    response_from_json,
    state_from_json,
    table_from_json,
)

SILENCE = 5.0
"""Seconds without a `~/state`, of which one comes every second, after which nobody is there."""

FRAME_ID = 'table'

FRAME_PATIENCE = 0.1
"""Seconds to wait for the frame that goes with a state: both are under way at the same time."""

TICK_SHARE = 1e-6
"""Seconds, far below a tick: times that differ less are those of one tick."""


class Lying(NamedTuple):
    """A table, and where its balls lie, (n, 2) in m, while all rest."""

    table: Table
    positions: NDArray[np.float64]


class SimulatorView:
    """Looks at one simulator. Nothing runs in between.

    Parameters
    ----------
    context : Context
        Initialised; stays the caller's.
    simulator : str
        Name of the node, relative to the namespace of this process or absolute.
    kind : str
        Who looks; a part of the name of the node.
    """

    def __init__(self, context: Context, simulator: str, kind: str) -> None:
        self._link = SimulatorLink(context, simulator, kind, enable_rosout=False)
        self._tables = Inbox(self._link, interface.TABLE)
        self._states = Inbox(self._link, interface.STATE)
        self._poses = Inbox(self._link, interface.BALL_POSES, depth=1, raw=True)
        self._responses = Inbox(self._link, interface.SHOT_RESPONSE, past=False)
        self._table: Table | None = None
        self.frame_id = FRAME_ID
        """Of the latest balls that were shown; until then the default one of a simulator."""
        self._state: dict[str, Any] | None = None
        self._state_came = 0
        self._shown: tuple[float, NDArray[np.float64]] | None = None
        self._placed: tuple[float, dict[str, list[float]]] | None = None

    @property
    def simulator(self) -> str:
        """Full name of the simulator."""
        return self._link.simulator

    def table(self) -> Table | None:
        """Return the table as it is from the next strike on; None before there is one."""
        for message, _ in self._tables.take():
            try:
                self._table = table_from_json(message.data)
            except ValueError as error:
                self._link.left_out(error)
        return self._table

    def lying(self) -> Lying:
        """Return how the balls lie.

        Raises
        ------
        OracleError
            While they move, and where nobody shows them; says which.
        """
        table = self.table()
        self._look()
        state = self._state
        age = (time.time_ns() - self._state_came) / SECOND_NS
        if table is None or state is None or age > SILENCE:
            raise OracleError(
                OracleCode.NO_SIMULATOR,
                f'no simulator is heard as {self.simulator}; is sim_node running, with the same '
                'ROS_DOMAIN_ID?',
            )
        if state['moving'] or state['computing']:
            doing = 'the balls are moving' if state['moving'] else 'a shot is being computed'
            raise OracleError(OracleCode.MOVING, f'{doing}; ask again when all rest')
        return Lying(table, self._positions(table, state))

    def has_changed(self, lying: Lying) -> bool:
        """Return whether the balls move, or lie otherwise, or on another table.

        A shot may begin and end between two looks. Where nobody is heard, nothing is known to have
        changed.
        """
        try:
            table, positions = self.lying()
        except OracleError as error:
            return error.code == OracleCode.MOVING
        return table != lying.table or not np.array_equal(positions, lying.positions)

    def close(self) -> None:
        """Leave ROS."""
        self._link.close()

    def _positions(self, table: Table, state: dict[str, Any]) -> NDArray[np.float64]:
        end = time.monotonic() + FRAME_PATIENCE
        at_least = (state.get('sim_time') or 0.0) - TICK_SHARE
        while (self._shown is None or self._shown[0] < at_least) and time.monotonic() < end:
            time.sleep(1e-3)
            self._look_at_poses()
        if self._shown is None:
            raise OracleError(
                OracleCode.NO_SIMULATOR,
                f'{self.simulator} has not shown its balls yet; a paused one shows none: resume it',
            )
        shown, positions = self._shown
        if self._placed is not None and self._placed[0] > shown + TICK_SHARE:
            places = self._placed[1]
            if places.keys() == set(table.labels):
                return np.array([places[label] for label in table.labels], dtype=float)
        if len(positions) != len(table.balls):
            raise OracleError(
                OracleCode.NO_SIMULATOR,
                f'{self.simulator} shows {len(positions)} balls, and its table has '
                f'{len(table.balls)}; do several simulators have this name?',
            )
        return positions

    def _look(self) -> None:
        for message, came in self._states.take():
            try:
                state = state_from_json(message.data)
            except ValueError as error:
                self._link.left_out(error)
                continue
            if self._state is not None and state['tick'] < self._state['tick']:
                self._shown = self._placed = None  # the simulator was started anew
            self._state, self._state_came = state, came
        for message, _ in self._responses.take():
            self._hear(message.data)
        self._look_at_poses()

    def _look_at_poses(self) -> None:
        for message, _ in self._poses.take():
            try:
                stamp, frame_id, positions = read_poses(message)
            except ValueError as error:
                self._link.left_out(error)
            else:
                self._shown = stamp / SECOND_NS, positions
                self.frame_id = frame_id

    def _hear(self, text: str) -> None:
        """Note balls that were placed: the frame that shows them comes later, or while the table is
        paused never."""
        try:
            response = response_from_json(text)
        except ValueError as error:
            self._link.left_out(error)
            return
        if response['phase'] == Phase.DONE and response['place'] is not None:
            self._placed = response['t_end'], response['final_positions']
