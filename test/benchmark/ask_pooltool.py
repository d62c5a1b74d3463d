"""Play the shots of a table with pooltool, in a process and an environment of its own."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics import Table

SCRIPT = Path(__file__).with_name('play_pooltool.py')
BALLS_SCRIPT = Path(__file__).with_name('play_pooltool_balls.py')
MOST_EVENTS = 20_000
TIMEOUT = 600.0
ENGINES = ('nearest', 'default')


class Shots(NamedTuple):
    """Shots of balls that spin: of all balls, in m, m/s and rad/s."""

    positions: NDArray[np.float64]  # (m, n, 2)
    velocities: NDArray[np.float64]  # (m, n, 2)
    spins: NDArray[np.float64]  # (m, n, 3)


@dataclass(frozen=True)
class Pooltool:
    """pooltool under the interpreter `python`; `home` is the folder it takes settings from."""

    python: Path
    home: Path

    def play(self, table: Table, shots: Sequence, rounds: int = 0, engine: str = 'nearest') -> dict:
        """Play shots on a table as near to ours as pooltool's model allows.

        pooltool's balls all have one mass, that of the last ball here, and a restitution each, of
        which a pair has the mean. They start rolling without slipping.

        Parameters
        ----------
        table : Table
        shots : sequence of array_like of shape (2,) or (n, 2)
            Velocities of the cue ball alone or of all balls, m/s.
        rounds : int, optional
            How often to play all shots with a stop watch.
        engine : {'nearest', 'default'}, optional
            The models nearest to ours, or those that pooltool takes when nothing is said.

        Returns
        -------
        dict
            `shots`: for each its `error` or None, `kinds` (how many events of each),
            `duration`, `positions`, `velocities`. `seconds`: one time per round, for all shots.

        Raises
        ------
        RuntimeError
            Where the process fails; what it printed.
        """
        request = described(table)
        request['shots'] = [for_every_ball(table, shot) for shot in shots]
        request.update(rounds=rounds, engine=engine, max_events=MOST_EVENTS)
        return self._ask(SCRIPT, request)

    def play_balls(self, table: Table, shots: Shots, rounds: int = 0) -> dict:
        """Play shots on a table of motion `ball` with the same models and coefficients.

        Where `table` has pockets, pooltool takes its own seven-foot table.

        Parameters
        ----------
        table : Table
        shots : Shots
        rounds : int, optional
            How often to play all shots with a stop watch.

        Returns
        -------
        dict
            `shots`: for each its `error` or None, `contacts` (rows of t, kind, a, b and the place
            of cushion or pocket), `events` (their number), `duration`, `positions`. `seconds`: one
            processor time per round, for all shots.

        Raises
        ------
        RuntimeError
            Where the process fails; what it printed.
        ValueError
            Where pooltool cannot play on such a table; what it has no match for.
        """
        request = described_balls(table)
        request['shots'] = [
            {'positions': x.tolist(), 'velocities': v.tolist(), 'spins': w.tolist()}
            for x, v, w in zip(*shots, strict=True)
        ]
        request.update(rounds=rounds, max_events=MOST_EVENTS)
        return self._ask(BALLS_SCRIPT, request)

    def versions(self) -> dict[str, str]:
        """Return the versions of pooltool and of the numba that it runs on."""
        code = (
            'import json; from importlib.metadata import version as v;'
            "print(json.dumps({'pooltool': v('pooltool-billiards'), 'its numba': v('numba')}))"
        )
        return json.loads(self._run(['-c', code], ''))

    def _ask(self, script: Path, request: dict) -> dict:
        return json.loads(self._run([str(script)], json.dumps(request)))

    def _run(self, arguments: list[str], text: str) -> str:
        done = subprocess.run(
            [str(self.python), *arguments],
            input=text,
            capture_output=True,
            text=True,
            timeout=TIMEOUT,
            env=self._environment(),
        )
        if done.returncode:
            raise RuntimeError(f'pooltool under {self.python}: {done.stderr.strip()}')
        return done.stdout

    def _environment(self) -> dict[str, str]:
        mine = ('PYTHONPATH', 'LD_LIBRARY_PATH', '_ROS_WHEELS_BOOTSTRAP_COMPLETE')
        kept = {name: value for name, value in os.environ.items() if name not in mine}
        return {**kept, 'HOME': str(self.home)}


def described(table: Table) -> dict:
    """Return what pooltool is told of a table."""
    mass = table.balls[-1].mass
    # The mean of two balls' restitutions is then e_cue_ball or e_ball_ball, as it must be.
    cue = 2.0 * table.e_cue_ball - table.e_ball_ball
    balls = [
        {
            'mass': mass,
            'radius': ball.radius,
            'position': ball.position,
            'restitution': cue if ball.is_cue else table.e_ball_ball,
        }
        for ball in table.balls
    ]
    names = ('length', 'width', 'mu_ball_surface', 'mu_ball_ball', 'mu_ball_cushion')
    fields = {name: getattr(table, name) for name in (*names, 'e_ball_cushion', 'gravity')}
    return {**fields, 'balls': balls}


def described_balls(table: Table) -> dict:
    """Return what pooltool is told of a table on which balls spin."""
    if table.e_cue_ball != table.e_ball_ball or len(set(table.masses)) > 1:
        raise ValueError('pooltool has one mass and one restitution of all balls')
    if table.friction_bound != 'restitution':
        raise ValueError("friction_bound: pooltool has 'restitution' only")
    names = ('length', 'width', 'nose_height', 'mu_slide', 'mu_roll', 'mu_spin', 'gravity')
    laws = ('ball_friction', 'cushion_model', 'mu_ball_ball', 'mu_ball_cushion')
    fields = {
        name: getattr(table, name) for name in (*names, *laws, 'e_ball_ball', 'e_ball_cushion')
    }
    ball = table.balls[0]
    return {**fields, 'mass': ball.mass, 'radius': ball.radius, 'pockets': len(table.pockets) > 0}


def for_every_ball(table: Table, velocities) -> list[list[float]]:
    """Return velocities of all balls, the others at rest where only the cue ball's is given."""
    all_balls = np.zeros((len(table.balls), 2))
    given = np.atleast_2d(np.asarray(velocities, dtype=float))
    all_balls[: len(given)] = given
    return all_balls.tolist()
