"""Play shots with pooltool. Runs in pooltool's own environment, not in the project's.

Reads one JSON object from standard input and writes one to standard output; see `pooltool.py`,
which starts this script. pooltool takes its settings from the home folder, so HOME should be an
empty one.
"""

import json
import sys
import time
from importlib.metadata import version

import numpy as np
import pooltool as pt
from pooltool.constants import rolling, stationary
from pooltool.objects import BallParams, BallState, BilliardTableSpecs
from pooltool.physics import PhysicsEngine
from pooltool.physics.resolve import Resolver
from pooltool.physics.resolve.ball_ball.friction import AverageBallBallFriction
from pooltool.physics.resolve.ball_ball.frictional_inelastic import FrictionalInelastic
from pooltool.physics.resolve.ball_cushion.impulse_frictional_inelastic.model import (
    ImpulseFrictionalInelasticLinear,
)


def main() -> None:
    request = json.load(sys.stdin)
    engine = nearest_engine() if request['engine'] == 'nearest' else PhysicsEngine()
    answer = {name: version(name) for name in ('pooltool-billiards', 'numba', 'numpy')}
    answer['python'] = sys.version.split()[0]
    answer['shots'] = [play(request, shot, engine) for shot in request['shots']]
    answer['seconds'] = [time_once(request, engine) for _ in range(request['rounds'])]
    json.dump(answer, sys.stdout)


def nearest_engine() -> PhysicsEngine:
    """Return the models that are nearest to ours: constant coefficients, impulses at a point."""
    resolver = Resolver.default()
    resolver.ball_ball = FrictionalInelastic(friction=AverageBallBallFriction())
    resolver.ball_linear_cushion = ImpulseFrictionalInelasticLinear()
    return PhysicsEngine(resolver=resolver)


def system(request: dict, velocities: list) -> pt.System:
    """Return the table with its balls; our x and y are pooltool's y and x."""
    length, width = request['length'], request['width']
    radius = request['balls'][0]['radius']
    specs = BilliardTableSpecs(l=length, w=width, cushion_height=radius)
    balls = [
        pt.Ball(id=str(k), state=state(ball, velocity), params=params(request, ball))
        for k, (ball, velocity) in enumerate(zip(request['balls'], velocities, strict=True))
    ]
    return pt.System(
        cue=pt.Cue(cue_ball_id='0'), table=pt.Table.from_table_specs(specs), balls=balls
    )


def state(ball: dict, velocity: list) -> BallState:
    """Return a ball that rolls without slipping, so that the cloth slows it at once."""
    (y, x), (vy, vx), radius = ball['position'], velocity, ball['radius']
    kinematics = np.array([[x, y, radius], [vx, vy, 0.0], [-vy / radius, vx / radius, 0.0]])
    return BallState(kinematics, rolling if vx or vy else stationary)


def params(request: dict, ball: dict) -> BallParams:
    return BallParams(
        m=ball['mass'],
        R=ball['radius'],
        u_s=request['mu_ball_surface'],
        u_r=request['mu_ball_surface'],
        u_b=request['mu_ball_ball'],
        e_b=ball['restitution'],
        e_c=request['e_ball_cushion'],
        f_c=request['mu_ball_cushion'],
        g=request['gravity'],
    )


def play(request: dict, velocities: list, engine: PhysicsEngine) -> dict:
    """Play one shot and tell how it went."""
    shot = system(request, velocities)
    error = None
    try:
        pt.simulate(shot, engine=engine, inplace=True, max_events=request['max_events'])
    except Exception as exception:  # what pooltool raises is the result
        error = f'{type(exception).__name__}: {exception}'
    kinds: dict[str, int] = {}
    for event in shot.events:
        kinds[str(event.event_type)] = kinds.get(str(event.event_type), 0) + 1
    return {
        'error': error,
        'kinds': kinds,
        'duration': float(shot.t),
        'positions': [[float(b.xyz[1]), float(b.xyz[0])] for b in shot.balls.values()],
        'velocities': [[float(b.vel[1]), float(b.vel[0])] for b in shot.balls.values()],
    }


def time_once(request: dict, engine: PhysicsEngine) -> float:
    """Return the processor time, s, of playing all shots once; making the balls does not count."""
    shots = [system(request, velocities) for velocities in request['shots']]
    start = time.process_time()
    for shot in shots:
        pt.simulate(shot, engine=engine, inplace=True)
    return time.process_time() - start


if __name__ == '__main__':
    main()
