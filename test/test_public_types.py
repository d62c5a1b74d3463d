"""A user's script passes `mypy --strict`, and mypy finds what is wrong in one."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from pool_sim_ros import me212, oracle, physics, ros, study

for needed in ('mypy', 'gymnasium', 'matplotlib', 'rclpy', 'rosbags'):
    pytest.importorskip(needed)

PROJECT = Path(__file__).parents[1]
ROOMS = (physics, oracle, study, me212, ros)
IMPORTS = '\n'.join(f'from {room.__name__} import {", ".join(room.__all__)}' for room in ROOMS)
HEAD = f"""\
import dataclasses
from pathlib import Path

import gymnasium
import numpy as np
from numpy.typing import NDArray
from rclpy.context import Context

{IMPORTS}

table: Table = report_table()
"""
RIGHT = """\
table = dataclasses.replace(table, ball_friction='coulomb', e_cue_ball=0.95)
ball: Ball = table.balls[0]
shot: Trajectory = simulate(table, (-4.0, 0.0), integrator='event')
shot = simulate(table, np.zeros((11, 2)), positions=table.positions, until=1.0)
shot = simulate(table, [-4.0, 0.0], integrator='time_slice', time_slice=REPORT_TIME_SLICE)
seconds: float = shot.duration
whole: bool = shot.complete
ends: NDArray[np.float64] = shot.final_positions
ends = shot.positions([0.0, 0.5, 1.0])[-1]
ends = shot.velocities(np.linspace(0.0, seconds, 10))[0]
stops = shot.events[shot.events['kind'] == EventKind.STOP]
outcomes = simulate_many(table, [(-4.0, 0.1), (-4.0, 0.2)])
ends, durations = outcomes[0][0], outcomes[1]
longest: np.float64 = durations.max()
meeting: TwoBallCollision = two_ball_collision(
    0.17, 0.17, (1.0, 0.0), (0.0, 0.0), 0.028, 0.028, offset=0.01, restitution=0.95, friction=0.06
)
angle: float = meeting.impact_angle
diameter: float = 2 * ball.radius / INCH
model: CushionModel = 'stronge'
bound: FrictionBound = 'restitution'
kind: RackKind = 'nine_ball'
spin: NDArray[np.float64] = np.zeros(3)
spin = collide_balls(
    (1.0, 0.0, 0.0), spin, np.zeros(3), np.zeros(3), (1.0, 0.0), m1=0.17, m2=0.17, R=0.0286, e=0.95,
    friction='alciatore', friction_bound=bound,
)[1]
after, spin = collide_cushion(
    (1.0, 0.0, 0.0), spin, (1.0, 0.0), R=0.0286, h=0.0366, e=0.85, f=0.2, model=model, mu_slide=0.2
)
velocity, spin = cue_strike(table, speed=2.0, azimuth=180.0, side=0.2, above=-0.3)
balls: tuple[Ball, ...] = rack(table, kind, spacing=1e-4, seed=3)
points: NDArray[np.float64] = Cushions(np.zeros((0, 6)), np.zeros((0, 3))).noses
pool: Table = pool_table('7ft')
pool = dataclasses.replace(pool, balls=rack(pool, kind), cushion_model=model, friction_bound=bound)
shot = simulate(pool, velocity, spins=spin, max_events=10_000)
turned: NDArray[np.float64] = shot.orientations([0.0, 0.1], orientations0=shot.orientations(0.0))
ends = shot.spins(seconds)
ends = shot.path(pool.index('9'))
holes: NDArray[np.int64] = shot.pocketed
azimuth: float = aim_at(pool, 'C', '9', positions=shot.final_positions)
many: Outcomes = simulate_many(
    pool, [velocity], spins=[spin], positions=pool.positions, events=True, errors='mark', threads=1
)
holes, failures = many.pocketed, many.failed
if many.events is not None and many.offsets is not None:
    stops = many.events[many.offsets[0] : many.offsets[1]]
many = simulate_many(pool, [velocity], spins=spin, out=many)
pool.save('pool.json')
pool = Table.load('pool.json')
shot.save('shot.npz')
shot = Trajectory.load('shot.npz')
try:
    check_layout(pool, pool.positions)
except ShotTooLong:
    pool = table_from_fields(table_to_fields(pool))
shot.plot(axes=shot.plot()).set_title('a shot')
shot.animate(speed=0.5, fps=25).save('shot.mp4')
shot.events_frame().groupby('kind')
many.events_frame(pool).groupby('shot')
many.to_xarray(pool).sel(ball='9')
compile_kernels(table)
goal: Goal = Goal(ball='9', to=(0.3, 0.2), within=0.1) & Goal(keep='C')
noise: Noise = 0.5 * Noise(speed=0.1, azimuth=0.2, camera=1e-3)
noise = Noise.preset('fastfiz')
plan: Plan = find_shots(table, goal, noise, shots=2000, seed=1, speeds=(0.5, 3.0))
plan = find_shots(table, {'first_hit': '1'}, 'sjtu', positions=table.positions, seconds=1.0)
best: RankedShot = plan[0]
chance: float = best.chance + best.low
misses: tuple[Failure, ...] = best.failures
for ranked in plan:
    ends = ranked.mean
many = what_if(table, [best.velocity], events=True, threads=1)
budget: ErrorBudget = error_budget(table, goal, best, noise=noise, shots=100)
allowed: dict[str, float] = budget.tolerance(0.8)
budget.plot().savefig('budget.png')
tracks: list[Track] = read_tracks(table, ['shot1.csv', Path('shot2.csv')])
found: Fit = fit(table, [*tracks, Track(np.arange(3.0), np.zeros((3, 11, 2)))], noise=5e-4)
table = found.table
register_environments()
env: gymnasium.Env[NDArray[np.float64], NDArray[np.float64]] = PlaceEnv(table, ball='9')
seen, info = env.reset(seed=1)
seen, reward, ended, cut, info = env.step(np.zeros(2))
pots: PotVectorEnv = PotVectorEnv(64, table='7ft', speed=2.0)
seen, rewards, over, truncated, infos = pots.step(np.zeros((64, 4)))
single: PotEnv | PlaceVectorEnv = PotEnv('9ft', starts=100)
for number in SHOT_NUMBERS:
    strike: tuple[float, float] = cue_velocity(number, table)
    text: str = format_shot(number, strike, [(table.labels[0], table.balls[0].position)])
printed: dict[str, tuple[float, float]] = published_final_positions()[1]
differences: list[str] = deviations(table, 'event', REPORT_TIME_SLICE)


def play(context: Context) -> str:
    client = ShotClient(context, NODE_NAME)
    recorder = Recorder(context, client.simulator)
    try:
        client.wait_for_simulator(5.0)
        client.call(interface.SET_PAUSED, data=False, timeout=5.0)
        client.place({'9': (0.5, 0.4)}, timeout=5.0)
        outcome = client.play(velocity=(-2.0, 0.3), timeout=5.0)
        client.play(cue={'speed': 2.0, 'azimuth': 180.0}, timeout=5.0)
        write_bag(Path('shot.mcap'), recorder.messages)
        return str(outcome['phase'])
    except SimulatorError as error:
        return str(error)
    finally:
        client.close()


node: SimNode = SimNode(namespace='left')
failed: bool = node.failed
laws: list[str] = [*BALL_FRICTION_LAWS, *INTEGRATORS]
"""
WRONG = """\
simulate(table)
simulate(table, (1.0, 0.0), integrator='runge-kutta')
simulate(table, (1.0, 0.0), speed=2.0)
simulate_many((1.0, 0.0), table)
table.colour
dataclasses.replace(table, ball_friction='none')
simulate(table, (1.0, 0.0)).final_position
Table(length='2.2 m', width=1.1, balls=())
Table(length=2.2, width=1.1, balls=(), ball_friction='none')
Table(length=2.2, width=1.1, balls=(), size=9)
two_ball_collision(0.17, 0.17, (1.0, 0.0))
cue_strike(table, 2.0)
rack(table, 'pyramid')
pool_table('10ft')
simulate_many(table, [(1.0, 0.0)], errors='ignore')
simulate(table, (1.0, 0.0)).spins()
aim_at(table, 0, 1)
simulate(table, (1.0, 0.0)).animate(speed='slow')
simulate_many(table, [(1.0, 0.0)]).to_xarray('report')
table.index(9)
find_shots(table, Goal(first_hit='1'), 'pro')
Goal(ball=9)
Noise(wind=1.0)
what_if([(1.0, 0.0)])
error_budget(table, Goal(first_hit='1'))
find_shots(table, Goal(first_hit='1'), 'sjtu')[0].velocities
PlaceEnv(7)
cue_velocity(table, 1)
SimNode(name='left')
ShotClient()
collide_cushion((1.0, 0.0, 0.0), 3, (1.0, 0.0), R=0.03, h=0.04, e=0.9, f=0.2, model='x')
"""


LIBRARIES = ('dask', 'gymnasium', 'matplotlib', 'pandas', 'rosbags', 'scipy', 'xarray', 'zarr')
"""Their own types are left out: it takes mypy long to read them, and they say nothing of ours."""


@pytest.fixture(scope='module')
def told(tmp_path_factory):
    """Return what `mypy --strict` says of both scripts; what it thinks of our modules is left out.

    numpy's own types take it long to read the first time, so its cache stays in the project.
    """
    folder = tmp_path_factory.mktemp('scripts')
    (folder / 'right.py').write_text(HEAD + RIGHT)
    (folder / 'wrong.py').write_text(HEAD + WRONG)
    left_out = ','.join(f'mypy-{name}.*' for name in LIBRARIES)
    (folder / 'mypy.ini').write_text(
        f'[mypy]\n[{left_out}]\nfollow_imports = skip\nignore_missing_imports = True\n'
    )
    done = subprocess.run(
        [sys.executable, '-m', 'mypy', '--strict', '--follow-imports=silent']
        + ['--config-file', 'mypy.ini', '--cache-dir', PROJECT / '.mypy_cache' / 'user']
        + ['right.py', 'wrong.py'],
        cwd=folder,
        env=os.environ | {'MYPYPATH': str(PROJECT)},
        capture_output=True,
        text=True,
        timeout=900,
    )
    assert not done.stderr, done.stderr
    return done.stdout


def test_a_script_with_every_public_name_passes(told):
    wrong = [line for line in told.splitlines() if line.startswith('right.py')]
    assert not wrong, '\n'.join(wrong)


def test_what_is_wrong_in_a_script_is_found(told):
    found = {int(number) for number in re.findall(r'^wrong\.py:(\d+): error', told, re.M)}
    first = HEAD.count('\n') + 1
    missed = [line for k, line in enumerate(WRONG.splitlines(), first) if k not in found]
    assert not missed, 'mypy has nothing against:\n' + '\n'.join(missed)
