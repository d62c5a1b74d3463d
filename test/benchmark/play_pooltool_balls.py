"""Play shots of balls that spin with pooltool, in pooltool's own environment.

Reads one JSON object from standard input and writes one to standard output; `ask_pooltool.py`
starts this script. Our x and y are pooltool's y and x, so the shot is a mirror image: a spin, which
is an axial vector, changes its sign besides.
"""

import json
import sys
import time

import numpy as np
import pooltool as pt
from pooltool.constants import rolling, sliding, spinning, stationary
from pooltool.events import Event
from pooltool.objects import BallParams, BallState, BilliardTableSpecs, PocketTableSpecs
from pooltool.physics import PhysicsEngine
from pooltool.physics.resolve import Resolver
from pooltool.physics.resolve.ball_ball.friction import (
    AlciatoreBallBallFriction,
    AverageBallBallFriction,
)
from pooltool.physics.resolve.ball_ball.frictional_inelastic import FrictionalInelastic
from pooltool.physics.resolve.ball_cushion import ball_ccushion_models, ball_lcushion_models

CUSHION_MODELS = {
    'han': 'han_2005',
    'impulse': 'impulse_frictional_inelastic',
    'stronge': 'stronge_compliant',
    'mathavan': 'mathavan_2010',
}
KINDS = {'ball_ball': 0, 'ball_linear_cushion': 1, 'ball_circular_cushion': 1, 'ball_pocket': 3}
"""Our numbers of the events that are compared."""


def main() -> None:
    request = json.load(sys.stdin)
    engine = engine_for(request['ball_friction'], request['cushion_model'])
    table = table_for(request)
    answer = {'shots': [play(request, table, shot, engine) for shot in request['shots']]}
    answer['seconds'] = [time_once(request, table, engine) for _ in range(request['rounds'])]
    json.dump(answer, sys.stdout)


def engine_for(ball_friction: str, cushion_model: str) -> PhysicsEngine:
    """Return an engine with the models of these names, ours."""
    resolver = Resolver.default()
    law = {'coulomb': AverageBallBallFriction, 'alciatore': AlciatoreBallBallFriction}
    resolver.ball_ball = FrictionalInelastic(friction=law[ball_friction]())
    model = CUSHION_MODELS[cushion_model]
    # Of the two values that pooltool has for this model, its default engine takes 1.8.
    options = {'omega_ratio': 1.8} if cushion_model == 'stronge' else {}
    resolver.ball_linear_cushion = ball_lcushion_models[model](**options)
    resolver.ball_circular_cushion = ball_ccushion_models[model](**options)
    return PhysicsEngine(resolver=resolver)


def table_for(request: dict) -> pt.Table:
    """Return pooltool's own table of this size: with pockets its seven-foot one."""
    specs = PocketTableSpecs if request['pockets'] else BilliardTableSpecs
    size = dict(l=request['length'], w=request['width'], cushion_height=request['nose_height'])
    return pt.Table.from_table_specs(specs(**size))


def system(request: dict, table: pt.Table, shot: dict) -> pt.System:
    radius = request['radius']
    params = BallParams(
        m=request['mass'],
        R=radius,
        u_s=request['mu_slide'],
        u_r=request['mu_roll'],
        u_sp_proportionality=request['mu_spin'] / radius,
        u_b=request['mu_ball_ball'],
        e_b=request['e_ball_ball'],
        e_c=request['e_ball_cushion'],
        f_c=request['mu_ball_cushion'],
        g=request['gravity'],
    )
    moves = zip(shot['positions'], shot['velocities'], shot['spins'], strict=True)
    balls = [
        pt.Ball(id=str(k), state=state(radius, *move), params=params)
        for k, move in enumerate(moves)
    ]
    return pt.System(cue=pt.Cue(cue_ball_id='0'), table=table.copy(), balls=balls)


def state(radius: float, position: list, velocity: list, spin: list) -> BallState:
    (y, x), (vy, vx), (wy, wx, wz) = position, velocity, spin
    kinematics = np.array([[x, y, radius], [vx, vy, 0.0], [-wx, -wy, -wz]])
    # Of the point that touches the cloth.
    slip = np.hypot(vx + radius * wy, vy - radius * wx)
    if slip > 1e-14 * (1.0 + radius * np.hypot(wx, wy)):
        return BallState(kinematics, sliding)
    if vx or vy:
        return BallState(kinematics, rolling)
    return BallState(kinematics, spinning if wz else stationary)


def play(request: dict, table: pt.Table, shot: dict, engine: PhysicsEngine) -> dict:
    """Play one shot and tell how it went."""
    played = system(request, table, shot)
    error = None
    try:
        pt.simulate(played, engine=engine, inplace=True, max_events=request['max_events'])
    except Exception as exception:  # what pooltool raises is the result
        error = f'{type(exception).__name__}: {exception}'
    balls = played.balls.values()
    return {
        'error': error,
        'contacts': [told(played.table, e) for e in played.events if str(e.event_type) in KINDS],
        'events': sum(str(e.event_type) != 'none' for e in played.events),
        'duration': float(played.t),
        'positions': [[float(b.xyz[1]), float(b.xyz[0])] for b in balls],
    }


def told(table: pt.Table, event: Event) -> tuple[float, int, int, int, tuple[float, float]]:
    """Return time, kind, balls (-1 for none), and where the cushion or the pocket is."""
    name = str(event.event_type)
    place = (0.0, 0.0)
    if name == 'ball_ball':
        a, b = sorted(int(ball) for ball in event.ids)
        return float(event.time), KINDS[name], a, b, place
    a, other = int(event.ids[0]), event.ids[1]
    if name == 'ball_linear_cushion':
        cushion = table.cushion_segments.linear[other]
        place = (cushion.p1 + cushion.p2) / 2.0
    elif name == 'ball_circular_cushion':
        place = table.cushion_segments.circular[other].center
    else:
        place = table.pockets[other].center
    return float(event.time), KINDS[name], a, -1, (float(place[1]), float(place[0]))


def time_once(request: dict, table: pt.Table, engine: PhysicsEngine) -> float:
    """Return the processor time, s, of playing all shots once; making the balls does not count."""
    shots = [system(request, table, shot) for shot in request['shots']]
    start = time.process_time()
    for shot in shots:
        try:
            pt.simulate(shot, engine=engine, inplace=True, max_events=request['max_events'])
        except Exception:  # noqa: S110  what was played counts, `play` tells the error
            pass
    return time.process_time() - start


if __name__ == '__main__':
    main()
