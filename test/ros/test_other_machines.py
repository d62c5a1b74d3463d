"""What keeps another machine out, as docs/security.md has it.

Two network namespaces stand for two machines. Making them needs root and `ip`, of iproute2.
"""

import contextlib
import os
import random
import shutil
import subprocess
from pathlib import Path

import pytest
from process_harness import Process
from waiting import PATIENCE

CONFIG = Path(__file__).resolve().parents[2] / 'config'
SEARCH = 3.0
"""Seconds for which one looks for a node that does not let it in; one that is let in takes one."""

FAST = {'report_integrator': 'event', 'real_time_factor': '20.0'}


class Machine:
    """A network namespace with one address."""

    def __init__(self, name, address):
        self.name, self.address = name, address

    def run(self, module, *args, **env):
        """Start a command of the package there."""
        prefix = ('ip', 'netns', 'exec', self.name)
        return Process(module, *args, prefix=prefix, env=env)

    def node(self, **env):
        settings = [word for item in FAST.items() for word in ('-p', '{}:={}'.format(*item))]
        return self.run('cli.sim_node', '--ros-args', *settings, **env).wait_for('ready')

    def plays(self, search=PATIENCE, **env):
        """Return whether a client there can play a shot on the node."""
        with self.run('cli.shot', '3', '--timeout', str(search), **env) as client:
            return client.wait() == 0

    def is_kept_out(self, **env):
        """Return whether a client there finds no node."""
        return not self.plays(SEARCH, **env)


def ip(*words):
    done = subprocess.run(['ip', *words], capture_output=True, text=True, check=False)
    if done.returncode:
        pytest.skip(f'no network namespaces: ip {" ".join(words)}: {done.stderr.strip()}')


@pytest.fixture(scope='module')
def machines(domain):
    """Two machines that share a wire."""
    if shutil.which('ip') is None:
        pytest.skip('no network namespaces: there is no command ip')
    mark = f'{os.getpid()}-{random.randrange(10**6)}'
    net = f'10.{random.randrange(64, 250)}.{random.randrange(256)}'
    ends = [Machine(f'pool-{mark}-{number}', f'{net}.{number}') for number in (1, 2)]
    with contextlib.ExitStack() as stack:
        for end in ends:
            ip('netns', 'add', end.name)
            stack.callback(subprocess.run, ['ip', 'netns', 'del', end.name], check=False)
        wires = [f'pw{random.randrange(16**8):08x}' for _ in ends]
        ip('link', 'add', wires[0], 'netns', ends[0].name, 'type', 'veth', 'peer', 'name', wires[1],
           'netns', ends[1].name)  # fmt: skip
        for end, wire in zip(ends, wires, strict=True):
            ip('-n', end.name, 'address', 'add', f'{end.address}/24', 'dev', wire)
            for device in ('lo', wire):
                ip('-n', end.name, 'link', 'set', device, 'up', 'multicast', 'on')
            ip('-n', end.name, 'route', 'add', '224.0.0.0/4', 'dev', wire)
        yield ends


def ranges(value, **others):
    return {'ROS_AUTOMATIC_DISCOVERY_RANGE': value, **others}


def test_a_subnet_lets_everybody_in(machines):
    home, other = machines
    with home.node(**ranges('SUBNET')):
        assert other.plays(**ranges('SUBNET'))


def test_localhost_keeps_out_only_who_does_not_name_this_host(machines):
    home, other = machines
    with home.node(**ranges('LOCALHOST')):
        assert other.is_kept_out(**ranges('SUBNET'))
        assert other.plays(**ranges('SUBNET', ROS_STATIC_PEERS=home.address))
        assert home.plays(**ranges('LOCALHOST'))


def test_off_keeps_everybody_out_clients_on_this_host_too(machines):
    home, other = machines
    with home.node(**ranges('OFF')):
        assert other.is_kept_out(**ranges('SUBNET', ROS_STATIC_PEERS=home.address))
        assert home.is_kept_out(**ranges('LOCALHOST'))


def test_the_loopback_profile_keeps_other_machines_out_and_lets_this_one_in(machines):
    home, other = machines
    profile = {'FASTRTPS_DEFAULT_PROFILES_FILE': str(CONFIG / 'loopback_only.xml')}
    with home.node(**ranges('LOCALHOST', **profile)):
        assert other.is_kept_out(**ranges('SUBNET', ROS_STATIC_PEERS=home.address))
        assert home.plays(**ranges('LOCALHOST', **profile))
