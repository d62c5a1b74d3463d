"""A session played again from its log: the same frames, bit for bit; no ROS, no clock."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from pool_sim_ros.me212 import cue_velocity
from pool_sim_ros.physics import check_layout
from pool_sim_ros.simulator.command_log import LogError
from pool_sim_ros.simulator.job import make_job
from pool_sim_ros.simulator.playback import Frame, Motion, Playback
from pool_sim_ros.simulator.settings import (
    PARAMETERS,
    Change,
    ParameterError,
    Settings,
    build_settings,
    values_of,
)


def replay_frames(settings: Settings, commands: Sequence[dict]) -> Iterator[Frame]:
    """Play a session again.

    Parameters
    ----------
    settings : Settings
        At the start.
    commands : sequence of dict
        As `command_log.read_log` returns them.

    Yields
    ------
    Frame
        Every tick from 0 to the end; where the log has none, until the balls rest.

    Raises
    ------
    LogError
        At a command that cannot be carried out; names the tick.
    """
    session = _Session(settings)
    playback = session.playback
    for command in commands:
        while playback.next_tick < command['tick']:
            yield playback.next_frame()
        if command['command'] == 'end':
            return
        try:
            session.do(command)
        except ValueError as error:
            raise LogError(f'tick {command["tick"]}, {command["command"]}: {error}') from None
    yield playback.next_frame()
    while playback.motion is not Motion.AT_REST:
        yield playback.next_frame()


class _Session:
    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self.playback = Playback(settings.table.positions, settings.publish_rate)

    def do(self, command: dict) -> None:
        """Carry out a command; raise ValueError where this cannot be."""
        table = self._settings.table
        match command['command']:
            case 'set':
                self._set(command['parameters'])
            case 'reset':
                self.playback.reset(table.positions)
            case 'place':  # also while balls move: a reset in the same tick has made room
                self._place(command['positions'])
            case 'strike':
                self._require_rest()
                self._strike(None, command['velocity'])
            case 'shot':
                self._require_rest()
                self._strike(command['shot'], cue_velocity(command['shot'], table))

    def _set(self, values: dict[str, object]) -> None:
        for name in values:
            if PARAMETERS[name].change is Change.NEVER:
                raise ParameterError(f'{name} is {Change.NEVER.value}')
        self._settings = build_settings({**values_of(self._settings), **values})

    def _place(self, positions) -> None:
        table = self._settings.table
        if positions.shape != (len(table.balls), 2):
            raise ValueError(f'positions must be {len(table.balls)} rows of two numbers')
        check_layout(table, positions)
        self.playback.reset(positions)

    def _strike(self, shot: int | None, velocity: tuple[float, float]) -> None:
        job = make_job(self._settings, shot, velocity, self.playback.positions)
        trajectory = job.run()
        if not trajectory.complete:
            raise ValueError('the balls move for longer than max_shot_duration')
        self.playback.strike()
        self.playback.computed(trajectory)

    def _require_rest(self) -> None:
        if self.playback.motion is not Motion.AT_REST:
            raise ValueError('the balls are moving')
