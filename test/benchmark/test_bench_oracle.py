"""How fast the oracle answers: one row for each promise.

    python -m pytest test/benchmark/test_bench_oracle.py

Simulator, oracle and whoever asks are processes of their own, on the report's table. Medians over
rounds, and the load of the machine beside them.
"""

import contextlib
import json
import os
import time
from pathlib import Path

import numpy as np
import pytest
from process_harness import Process

HERE = Path(__file__).parent
PROFILE = HERE.parents[1] / 'config' / 'large_messages.xml'
ROUNDS = '20'

SETUPS = {
    'profile': {'FASTRTPS_DEFAULT_PROFILES_FILE': str(PROFILE)},
    'no profile': {},
}
TARGETS = {
    'profile': {'1': '1 ms', '10000': '10 ms', '50000': '60 ms'},
    'no profile': {'1': '', '10000': '30 ms', '50000': ''},
}
AS_USERS = ('env', '-u', 'FASTDDS_BUILTIN_TRANSPORTS')
"""The tests' own transport is another one."""


@pytest.fixture
def tell(results):
    def tell(what, figure, target=''):
        load = os.getloadavg()[0]
        results.note('The oracle over topics', what, f'{figure} (load {load:.1f})', target)

    return tell


@contextlib.contextmanager
def process(module, *args, env):
    with Process(module, *args, prefix=AS_USERS, env=env) as made:
        yield made.wait_for('ready')


@pytest.mark.parametrize('setup', SETUPS)
def test_what_if(domain, tell, setup):
    env = SETUPS[setup]
    with (
        process('cli.sim_node', env=env),
        process('cli.oracle', env=env),
        process(HERE / 'echo.py', env=env),
    ):
        with Process(HERE / 'ask_oracle.py', ROUNDS, prefix=AS_USERS, env=env) as asker:
            assert asker.wait() == 0, asker.stderr
    found = json.loads(asker.stdout)
    for count, seconds in found['times'].items():
        alone = found['alone'][count] * 1e3
        figure = f'{seconds * 1e3:.2f} ms, of which the engine alone {alone:.2f}'
        tell(f'{int(count):,} candidates, {setup}', figure, TARGETS[setup][count])
    tell(f'ROS alone there and back, {setup}', f'{found["echo"] * 1e3:.2f} ms')
    tell(f'burst of 20 x 10,000, {setup}', f'all answered in {found["burst"]:.2f} s', 'all')
    assert found['equal']


def test_frames_are_not_late_for_it(domain, tell):
    env = SETUPS['profile']
    lateness = {}
    for asked in (False, True):
        with process(HERE / 'lateness.py', 'node', env=env) as node:
            with process('cli.oracle', env=env):
                if asked:
                    call = HERE / 'ask_oracle.py', '120', '--only-ask'
                    with Process(*call, prefix=AS_USERS, env=env) as asker:
                        assert asker.wait() == 0, asker.stderr
                else:
                    time.sleep(15.0)
            node.interrupt()
            node.wait()
        frames = json.loads(node.stdout)[60:]
        lateness[asked] = np.percentile(frames, [50, 99]) * 1e3
    for asked, (p50, p99) in lateness.items():
        what = 'while 10,000 and 50,000 are asked for' if asked else 'while nobody asks'
        tell(f'lateness of frames {what}: median, p99', f'{p50:.2f}, {p99:.2f} ms')
