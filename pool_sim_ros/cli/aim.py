"""The command `aim`: find the shots that most likely meet a goal, and play the best."""

from __future__ import annotations

import argparse
import sys
import time
from typing import TYPE_CHECKING, Any

from pool_sim_ros.cli.aim_arguments import AimParser, noise_of, parts_of
from pool_sim_ros.console import CommandError, ProgressLine
from pool_sim_ros.ros import ros_command

if TYPE_CHECKING:
    from rclpy.context import Context

    from pool_sim_ros.oracle import Goal, Plan, RankedShot
    from pool_sim_ros.ros import ShotClient

LOOK_PERIOD = 0.02
"""Seconds between two looks at the simulator, until it has shown itself."""


@ros_command('aim', AimParser, interrupted='aim: interrupted')
def main(context: Context, options: argparse.Namespace) -> None:
    """Search, print, and play the best where that is asked for."""
    from pool_sim_ros.oracle import Goal
    from pool_sim_ros.ros import ShotClient

    try:
        goal = Goal(all=parts_of(options))  # type: ignore[arg-type]
    except ValueError as error:
        raise CommandError(str(error)) from None
    client = ShotClient(context, options.node)
    try:
        client.wait_for_simulator(options.timeout)
        plan = _search(context, options, goal)
        print(plan)
        if options.shoot and not len(plan):
            raise CommandError('there is no shot to play')
        if options.shoot:
            _shoot(client, plan[0], options.timeout)
    finally:
        client.close()


def _search(context: Context, options: argparse.Namespace, goal: Goal) -> Plan:
    """Return what a search finds from the balls as they lie."""
    from pool_sim_ros.oracle import find_shots
    from pool_sim_ros.physics import compile_kernels

    table, positions = _look(context, options)
    line = ProgressLine(sys.stdout)

    def show(played: int) -> None:
        if line.wanted:
            line.show(f'{played:,} of about {options.shots:,} shots played')

    compile_kernels(table)
    try:
        return find_shots(
            table,
            goal,
            noise_of(options),
            options.shots,
            options.seed,
            options.seconds,
            positions=positions,
            count=options.count,
            offset=options.offset,
            on_round=show,
        )
    except ValueError as error:
        raise CommandError(str(error)) from None
    finally:
        line.clear()


def _look(context: Context, options: argparse.Namespace) -> Any:
    from pool_sim_ros.ros import OracleError, SimulatorView

    view = SimulatorView(context, options.node, 'aim')
    end = time.monotonic() + options.timeout
    try:
        while True:
            try:
                return view.lying()
            except OracleError as error:
                if error.code != 'NO_SIMULATOR' or time.monotonic() > end:
                    raise
            time.sleep(LOOK_PERIOD)
    finally:
        view.close()


def _shoot(client: ShotClient, shot: RankedShot, timeout: float) -> None:
    what: dict[str, Any] = {'velocity': tuple(shot.velocity.tolist())}
    if shot.cue is not None:
        what = {'cue': shot.cue}
    response = client.play(**what, timeout=timeout)
    places = (f'{label} [{x:.3f}, {y:.3f}]' for label, (x, y) in _ends(response))
    print(f'played; the balls end at {", ".join(places)} m')
    if response['pocketed']:
        caught = (f'{label} in {pocket}' for label, pocket in response['pocketed'].items())
        print(f'in pockets: {", ".join(caught)}')


def _ends(response: dict[str, Any]) -> list[tuple[str, list[float]]]:
    caught = response['pocketed'] or {}
    return [item for item in response['final_positions'].items() if item[0] not in caught]


if __name__ == '__main__':
    sys.exit(main())
