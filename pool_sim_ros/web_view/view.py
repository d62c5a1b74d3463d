"""Between simulator and pages: what the pages show, and what they may ask for."""

from __future__ import annotations

import asyncio
import struct
from collections.abc import Coroutine
from typing import Any

import numpy as np
from rclpy.context import Context

from pool_sim_ros.me212 import is_report_table, published_final_positions
from pool_sim_ros.physics import Table, compile_kernels, table_to_fields
from pool_sim_ros.ros import interface, messages
from pool_sim_ros.simulator import Phase, response_from_json, state_from_json, table_from_json
from pool_sim_ros.web_view.bridge import Bridge, NoAnswerError
from pool_sim_ros.web_view.commands import Command, parse_command
from pool_sim_ros.web_view.frames import are_collisions, check_count, frame_positions, page_frame
from pool_sim_ros.web_view.helping import Helper
from pool_sim_ros.web_view.pages import Page, Pages, message
from pool_sim_ros.web_view.prediction import predict
from pool_sim_ros.web_view.strikes import Strikes, places_to_undo

SILENCE = 4
"""The simulator is gone after so many looks, one a second, without a `~/state`, which comes every
second. A time alone would not do: after a pause of this process, it still has to read what came
meanwhile."""

FRAME_PERIOD = 1 / 100
"""Seconds between two looks for a new frame; at real speed one comes every 1/60 s. If the simulator
runs faster, the pages see the latest."""

COMPILE_NOTICE = 1.0
"""Seconds after which the kernels are being compiled, not merely loaded."""


class View:
    """Shows one simulator to the pages, and does what they ask.

    Parameters
    ----------
    context : Context
        Initialised; stays the caller's.
    simulator : str
        Name of the node.
    """

    def __init__(self, context: Context, simulator: str) -> None:
        self.pages = Pages()
        self._table: Table | None = None
        self._compiled = False
        self._state: dict[str, Any] | None = None
        self._frame: bytes | None = None
        self._early: bytes | None = None
        self._struck: str | None = None
        self._strikes = Strikes(self._tell_strike, self._time_slice)
        self._printed = published_final_positions()
        self._helper = Helper()
        self._loop = asyncio.get_running_loop()
        self._silence: asyncio.TimerHandle | None = None
        self._tasks: set[asyncio.Task[None]] = set()
        self._bridge = Bridge(context, simulator, self)
        self._tell_whether_there()
        self._look = self._loop.call_soon(self._look_for_frame)

    @property
    def simulator(self) -> str:
        """Full name of the simulator."""
        return self._bridge.simulator

    def close(self) -> None:
        """Leave ROS."""
        self._look.cancel()
        if self._silence is not None:
            self._silence.cancel()
        for task in self._tasks:
            task.cancel()
        self._bridge.close()

    async def obey(self, page: Page, text: str) -> None:
        """Do what a page asks; tell the page if this fails, and why."""
        try:
            await self._obey(page, parse_command(text))
        except (ValueError, NoAnswerError) as error:
            page.tell(message('problem', str(error)))

    async def _obey(self, page: Page, command: Command) -> None:
        if self._state is None:
            raise NoAnswerError(self._absence())
        if command.name == 'aim':
            page.tell(message('prediction', await self._predict(command.value)))
        elif command.name == 'strike':
            await self._bridge.request(**command.value)
        elif command.name == 'shot':
            await self._bridge.request(shot=command.value)
        elif command.name == 'place':
            await self._bridge.request(place=command.value)
        elif command.name == 'undo':
            await self._undo()
        elif command.name == 'help':
            self._help(page, command.value)
        else:
            succeeded, words = await self._call(command)
            if not succeeded:
                raise ValueError(words)

    async def _call(self, command: Command) -> tuple[bool, str]:
        if command.name == 'pause':
            return await self._bridge.call(interface.SET_PAUSED, data=command.value)
        if command.name == 'speed':
            return await self._bridge.set_parameter('real_time_factor', command.value)
        service = interface.STEP if command.name == 'step' else interface.RESET
        return await self._bridge.call(service)

    async def _predict(self, strike: dict[str, Any]) -> dict[str, object] | None:
        """Return what a strike would do, or None if there is nothing to predict from."""
        lying = self._lying()
        if lying is None or not self._compiled:
            return None
        if 'velocity' in strike and not any(strike['velocity']):
            return None
        # Not in the loop: on a table with many balls it takes longer than a frame.
        return await asyncio.to_thread(predict, *lying, strike)

    def _help(self, page: Page, goal: dict[str, Any]) -> None:
        lying = self._lying()
        if lying is None:
            raise ValueError('wait until the balls are at rest')
        self._run(self._helper.help(page, *lying, goal))

    def _lying(self) -> tuple[Table, np.ndarray] | None:
        """Return the table, and where its balls rest; None while they move."""
        table, frame, state = self._table, self._frame, self._state
        if table is None or frame is None or state is None or state['moving']:
            return None
        return table, frame_positions(frame, whole=self._turns)

    async def _undo(self) -> None:
        """Put the balls back to where they were before the latest strike."""
        start, frame, table = self._strikes.start, self._frame, self._table
        if start is None or frame is None or table is None:
            raise ValueError('there is no strike to undo')
        moved = places_to_undo(table, start, frame_positions(frame, whole=self._turns))
        if moved:
            await self._bridge.request(place=moved)

    @property
    def _turns(self) -> bool:
        """Whether balls turn and fall into pockets on this table."""
        return self._table is not None and self._table.motion == 'ball'

    def on_collisions(self, collisions: Any) -> None:
        """Show the collisions; see `bridge.Listener`."""
        rows = messages.from_rows(collisions)
        if self._table is None:
            return  # it is latched, and comes in a moment
        if not are_collisions(rows, len(self._table.balls)):
            self._bridge.left_out(ValueError('these are no collisions on this table'))
            return
        self.pages.tell('collisions', rows.tolist())

    def on_response(self, response: Any) -> None:
        """Show the response to a request, beside what the report printed."""
        content = response_from_json(response.data)
        if self._is_repeated(content):
            return
        done = content['phase'] == Phase.DONE and content['velocity'] is not None
        self._follow(content, done)
        printed = self._printed.get(content['shot']) if done and content['as_printed'] else None
        if printed is not None and not printed.keys() >= content['final_positions_in'].keys():
            raise ValueError('a response as printed has other balls than the print')
        self.pages.tell('response', {**content, 'printed': printed})
        if done:
            self.pages.tell('result', {**content, 'printed': printed}, keep=True)

    def _is_repeated(self, content: dict[str, Any]) -> bool:
        """Return whether a request was sent again, so that this is no news."""
        phase, request_id = content['phase'], content['id']
        if content['velocity'] is None or phase == Phase.REJECTED:
            return False
        if phase == Phase.ACCEPTED:
            before, self._struck = self._struck, request_id
            return bool(before == request_id)
        return self._struck not in (None, request_id)

    def _follow(self, content: dict[str, Any], done: bool) -> None:
        """Keep the latest strike."""
        if self._table is None:
            return
        if content['phase'] == Phase.ACCEPTED and content['velocity'] is not None:
            self.pages.forget('result')
            self._run(self._strikes.accepted(self._table, content))
        elif content['phase'] == Phase.PREEMPTED:
            self._strikes.forget()
        elif done:
            self._run(self._strikes.done(self._table, content))

    def _tell_strike(self, fields: dict[str, Any] | None) -> None:
        self.pages.tell('strike', fields, keep=True)

    async def _time_slice(self) -> float:
        return await self._bridge.number_parameter('time_slice')

    def on_state(self, state: Any) -> None:
        """Show what goes on."""
        content = state_from_json(state.data)
        came = self._state is None
        if came and not self._bridge.is_matched():
            return  # the next one comes within a second
        self._state = content
        self.pages.tell('state', self._state, keep=True)
        if came:
            self._tell_whether_there()
        if self._silence is not None:
            self._silence.cancel()
        self._silence = self._loop.call_later(1.0, self._miss, 1)

    def on_table(self, table: Any) -> None:
        """Show the table."""
        self._table = table_from_json(table.data)
        self._frame = None
        self.pages.forget('result')
        self._strikes.forget()
        fields = {**table_to_fields(self._table), 'is_report': is_report_table(self._table)}
        self.pages.tell('table', fields, keep=True)
        early, self._early = self._early, None
        if early is not None:
            self._show_poses(early)
        self._run(self._compile(self._table))

    async def _compile(self, table: Table) -> None:
        notice = self._loop.call_later(COMPILE_NOTICE, self._tell_of_compiling, True)
        try:
            await asyncio.to_thread(compile_kernels, table)
        finally:
            notice.cancel()
            self._tell_of_compiling(False)
        self._compiled = True
        self.pages.tell('predicts', True, keep=True)

    def _tell_of_compiling(self, compiling: bool) -> None:
        self.pages.tell('compiling', compiling, keep=True)

    def _look_for_frame(self) -> None:
        self._look = self._loop.call_later(FRAME_PERIOD, self._look_for_frame)
        poses = self._bridge.latest_poses()
        if poses is not None:
            self._show_poses(poses)

    def _show_poses(self, poses: bytes) -> None:
        table, whole = self._table, self._turns
        try:
            frame = page_frame(poses, whole=whole)
            if table is not None:
                check_count(frame, len(table.balls), whole=whole)
        except ValueError as error:
            self._bridge.left_out(error)
            return
        if table is None:
            self._early = poses
            return
        (stamp,) = struct.unpack_from('<d', frame)
        self._strikes.saw(stamp, frame_positions(frame, whole=whole))
        self._frame = frame
        self.pages.show(frame)

    def _miss(self, looks: int) -> None:
        if looks < SILENCE:
            self._silence = self._loop.call_later(1.0, self._miss, looks + 1)
            return
        self._state = self._frame = self._struck = None
        self.pages.forget('state')
        self.pages.forget('result')
        self._strikes.forget()
        self.pages.show(None)
        self._tell_whether_there()

    def _tell_whether_there(self) -> None:
        problem = self._absence() if self._state is None else None
        self.pages.tell('simulator', {'name': self.simulator, 'problem': problem}, keep=True)

    def _absence(self) -> str:
        return (
            f'No simulator answers as {self.simulator}. Start one with '
            '"ros2 run pool_sim_ros sim_node", under the same ROS_DOMAIN_ID.'
        )

    def _run(self, coroutine: Coroutine[Any, Any, None]) -> None:
        task = self._loop.create_task(coroutine)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
