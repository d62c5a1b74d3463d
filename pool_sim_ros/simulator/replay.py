"""Plays a log of commands again: the same frames, bit for bit; no ROS, no clock."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from pool_sim_ros.simulator.command_log import LogError
from pool_sim_ros.simulator.frame import Frame
from pool_sim_ros.simulator.parameter_table import PARAMETERS, Change
from pool_sim_ros.simulator.parameter_values import ParameterError
from pool_sim_ros.simulator.settings import Settings, build_settings, values_of
from pool_sim_ros.simulator.shot_request import Phase, Request
from pool_sim_ros.simulator.simulation import Simulation


def replay_frames(settings: Settings, commands: Sequence[dict[str, Any]]) -> Iterator[Frame]:
    """Give the commands of a log to a simulation, and take its frames.

    Parameters
    ----------
    settings : Settings
        At the start.
    commands : sequence of dict
        As `command_log.read_log` returns them.

    Yields
    ------
    Frame
        Every tick from 0 to the end; until all balls rest where the log has no end.

    Raises
    ------
    LogError
        At a command that cannot be carried out; names the tick.
    """
    simulation = Simulation(settings)
    for command in commands:
        while simulation.next_tick < command['tick']:
            yield simulation.next_frame()[0]
        if command['command'] == 'end':
            return
        try:
            _carry_out(simulation, command)
        except ValueError as error:
            raise LogError(f'tick {command["tick"]}, {command["command"]}: {error}') from None
    yield simulation.next_frame()[0]
    while not simulation.at_rest:
        yield simulation.next_frame()[0]


def _carry_out(simulation: Simulation, command: dict[str, Any]) -> None:
    """Carry out one command, and compute its shot at once; raise ValueError where it cannot be."""
    match command['command']:
        case 'set':
            simulation.settings = _changed(simulation.settings, command['parameters'])
        case 'reset':
            simulation.reset()
        case 'place':
            # The log has the last layout of a tick only: a reset before it let the balls be placed.
            simulation.reset()
            if command['positions'].shape[1] != 2:
                raise ValueError('positions must be rows of two numbers')
            turned = command.get('orientations')
            refusal = simulation.place(command['positions'], orientations=turned)
            if refusal is not None:
                raise ValueError(refusal)
        case 'strike':
            _play(simulation, Request(velocity=command['velocity'], spin=command.get('spin')))
        case 'shot':
            _play(simulation, Request(shot=command['shot']))


def _changed(settings: Settings, parameters: dict[str, object]) -> Settings:
    for name in parameters:
        if PARAMETERS[name].change is Change.NEVER:
            raise ParameterError(f'{name} is {Change.NEVER.value}')
    return build_settings({**values_of(settings), **parameters})


def _play(simulation: Simulation, request: Request) -> None:
    response, job = simulation.take(request)
    responses = [response] if job is None else simulation.computed(job, job.run())
    for response in responses:
        if response.phase is not Phase.ACCEPTED:
            raise ValueError(response.reason)
