"""After `compile_kernels` nothing is left to compile, and it needs neither memory nor time."""

import os
import subprocess
import sys

import pytest

FIRST_SHOTS = """
import dataclasses, gc, sys
import numpy as np
from benchmark.workloads import dense_table
from tables import random_table
from pool_sim_ros.physics import (
    Ball, Table, check_layout, compile_kernels, report_table, simulate, simulate_many
)
from pool_sim_ros.physics import cores
from pool_sim_ros.physics.jit import Kernel

cores.CHUNK = 2  # so that threads share what there is

def compiled():
    kernels = [thing for thing in gc.get_objects() if isinstance(thing, Kernel)]
    return {
        f'{k.__module__}.{k.__qualname__}': len(k.for_python.overloads)
        for k in kernels if 'for_python' in vars(k)
    }

law, balls, warm, integrator = sys.argv[1:]
balls = int(balls)
def table_of(n):
    return dataclasses.replace(dense_table(n, decelerating=True), ball_friction=law)
compile_kernels(table_of(balls if warm == 'same' else 11))
before = compiled()
table = table_of(balls)
n = len(table.balls)
options = dict(integrator=integrator, until=2e-3)
slices = [{}] if integrator == 'event' else [
    {'time_slice': 1e-3}, {'time_slice': 1}, {'time_slice': np.float32(1e-3)}
]
velocities = [
    (1.0, 0.0), [1, 0], np.array([1, 0]), np.float32([1, 0]), np.ones((n, 2)),
    np.ones((n, 2), order='F'), np.ones((n, 4))[:, ::2], np.broadcast_to(1.0, (n, 2)),
]
times = [0.0, 0, [0.0, 1e-3], np.linspace(0, 1e-3, 9)[::2], np.broadcast_to(0.0, 3), (0, 0)]
fixed = np.array(table.positions)
fixed.flags.writeable = False
layouts = [None, table.positions, fixed, fixed.tolist(), np.asfortranarray(fixed),
           np.repeat(fixed, 2, axis=1)[:, ::2]]
for more in slices:
    for velocity in velocities:
        shot = simulate(table, velocity, **options, **more)
        for time in times:
            shot.positions(time), shot.velocities(time)
        shot.path(0)
    for layout in layouts:
        simulate(table, (1.0, 0.0), positions=layout, **options, **more)
        if layout is not None:
            check_layout(table, np.asarray(layout))
    many = np.ones((7, 2))
    for threads in (1, 2):
        for given in (many, many.T.copy().T, many.tolist(), np.ones((7, n, 2)), many[:1]):
            simulate_many(table, given, threads=threads, **options, **more)
        simulate_many(table, many, threads=threads, events=True, **options, **more)
        simulate_many(table, many, threads=threads, positions=fixed, **options, **more)
        shifted = np.stack([fixed] * 7)
        simulate_many(table, many, threads=threads, positions=shifted, **options, **more)
        simulate_many(table, many, positions=shifted - 9.0, errors='mark', **options, **more)
after = compiled()
more = {name: after[name] - before.get(name, 0) for name in after}
print(*(name for name, count in more.items() if count > 0))
print(len(after))
"""


def run(script, *arguments):
    """Return what a process writes that runs a script."""
    done = subprocess.run(
        [sys.executable, '-c', script, *arguments],
        env={**os.environ, 'PYTHONPATH': os.pathsep.join(sys.path)},
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert (done.returncode, done.stderr) == (0, '')
    return done.stdout


@pytest.mark.parametrize('integrator', ['event', 'time_slice'])
@pytest.mark.parametrize(
    ('law', 'balls', 'warm'),
    [
        ('report', '11', 'same'),
        ('coulomb', '45', 'another'),
        *(
            pytest.param(*given, marks=pytest.mark.soak)
            for given in [
                ('coulomb', '45', 'same'),
                ('report', '45', 'another'),
                ('coulomb', '1', 'another'),
                ('report', '1', 'same'),
                ('coulomb', '2', 'same'),
            ]
        ),
    ],
)
def test_the_first_shots_compile_nothing_more(law, balls, warm, integrator):
    """Whatever their arguments are; nor do they load what was kept, which would take time too."""
    more, count = run(FIRST_SHOTS, law, balls, warm, integrator).split('\n')[:2]
    assert more == ''
    assert int(count) >= 6  # else nothing was looked at


FIRST_SHOTS_WITH_SPIN = """
import dataclasses, gc, sys
import numpy as np
from pool_sim_ros.physics import compile_kernels, pool_table, rack, simulate, simulate_many
from pool_sim_ros.physics.jit import Kernel

def compiled():
    kernels = [thing for thing in gc.get_objects() if isinstance(thing, Kernel)]
    return sum(len(k.for_python.overloads) for k in kernels if 'for_python' in vars(k))

name, = sys.argv[1:]
table = pool_table(name)
n = len(table.balls)
compile_kernels(table)
before = compiled()
one, all_of_them = np.ones(3), np.ones((n, 3))
turned = np.asfortranarray(all_of_them)
for spins in (None, one, one.tolist(), np.float32(one), all_of_them, turned):
    shot = simulate(table, (1.0, 0.0), spins=spins, until=0.1)
    for times in (0.0, [0.0, 0.1], np.linspace(0.0, 0.1, 9)[::2]):
        shot.positions(times), shot.spins(times), shot.orientations(times)
    shot.orientations(0.0, shot.orientations(0.1)), shot.path(0), shot.pocketed
for spins in (None, one, np.ones((4, 3)), np.ones((4, n, 3))):
    for positions in (None, table.positions, np.stack([table.positions] * 4)):
        given = dict(spins=spins, positions=positions, until=0.1, events=True)
        simulate_many(table, np.ones((4, 2)), **given)
dataclasses.replace(table, balls=rack(table, 'carom'), cushion_model='mathavan')
print(before > 3, compiled() - before)
"""


@pytest.mark.parametrize('name', ['7ft', 'carom'])
def test_nor_do_those_on_a_pool_table(name):
    """With pockets and without."""
    assert run(FIRST_SHOTS_WITH_SPIN, name) == 'True 0\n'


OTHER_TABLES = """
import dataclasses
from tables import table_of
from pool_sim_ros.physics import compile_kernels, report_table

plain = table_of([(0.3, 0.5), (0.4, 0.5), (1.2, 0.5)])
last = [dataclasses.replace(ball, is_cue=ball.label == '1') for ball in plain.balls]
for table in (
    dataclasses.replace(plain, balls=last),
    dataclasses.replace(plain, mu_ball_surface=0.0, e_cue_ball=1.0, e_ball_ball=1.0),
    dataclasses.replace(plain, mu_ball_ball=1000.0),
    dataclasses.replace(plain, gravity=1e-6, mu_ball_surface=1e-3),
    dataclasses.replace(plain, gravity=1e6, mu_ball_surface=1e3),
    dataclasses.replace(plain, balls=plain.balls[:1]),
):
    compile_kernels(table)
print('compiled')
"""


def test_any_table_will_do():
    """Wherever its cue ball is, and whatever its coefficients are."""
    assert run(OTHER_TABLES) == 'compiled\n'


only_on_linux = pytest.mark.skipif(sys.platform != 'linux', reason='reads /proc')

MEMORY = """
from benchmark.workloads import dense_table
from peak_memory import peak_megabytes
from pool_sim_ros.physics import compile_kernels, report_table

compile_kernels(report_table())  # so that what numba itself needs is there
table = dense_table(20_000, decelerating=True)
before = peak_megabytes()
compile_kernels(table)
print(peak_megabytes() - before)
"""


@only_on_linux
def test_twenty_thousand_balls_need_no_memory():
    """All their pairs, which slicing looks at, would be 2e8."""
    assert float(run(MEMORY)) < 50.0


NODE = """
from dataclasses import replace
from benchmark.workloads import dense_table
from fakes import Recorder
from peak_memory import peak_megabytes
from pool_sim_ros.simulator.parameter_table import default_values
from pool_sim_ros.simulator.runner import Runner
from pool_sim_ros.simulator.settings import build_settings
from waiting import wait_until

settings = replace(build_settings(default_values()), real_time_factor=1.0)
table = dense_table(20_000, decelerating=True)
class Counter(Recorder):
    frames = 0
    def frame(self, frame):  # kept, they would be the memory that is measured
        self.frames += 1

output = Counter()
runner = Runner(replace(settings, table=table), output)
wait_until(lambda: runner.ready.is_set() or output.all('fail'), 'ready')
wait_until(lambda: output.frames > 3, 'frames')
runner.stop(60.0)
print(len(output.all('fail')), peak_megabytes())
"""


@only_on_linux
def test_a_simulator_of_twenty_thousand_balls_starts_in_little_memory():
    run('from pool_sim_ros.physics import *\ncompile_kernels(report_table())')  # takes memory too
    failures, megabytes = run(NODE).split()
    assert failures == '0' and float(megabytes) < 1000.0
