"""A copy of the package, and processes that run on it as a user in some trouble would run them."""

import functools
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from forked import Forked, start_starter

import pool_sim_ros

PACKAGE = Path(pool_sim_ros.__file__).parent

CHECK = """
from numba.core import event
with event.install_recorder('numba:compile') as recorder:
    from pool_sim_ros.physics import Ball, Table
    try:
        Table(2.0, 1.0, [Ball('a', 0.1, 0.05, ({x}, 0.5))])
        print('inside', len(recorder.buffer) > 0)
    except ValueError:
        print('outside', len(recorder.buffer) > 0)
"""
"""Runs the kernel that takes least time to compile; says what it found, and whether it compiled."""

OUTSIDE = 0.05 - 1e-6
"""Where a ball of radius 0.05 m overlaps the cushion x = 0 by more than a table allows, m."""

OVERLAP_ALLOWED = 'OVERLAP = 1e-9', 'OVERLAP = 1e-3'
"""An edit of `tolerances.py`, for which it lies inside."""

STRANGER = 54321
"""A user who is nobody on this machine: no name, no home, no rights."""


LEFT_OUT = ('NUMBA_', 'XDG_', 'PYTHON', 'COVERAGE_')
"""Settings with these beginnings are the tests' own, or are read while Python or numba loads."""

READ_AGAIN = {'PYTHONPATH', 'NUMBA_CACHE_DIR'}
"""Those that a forked process has too: its folder comes first on its path, and it runs AGAIN."""

AGAIN = 'import numba.core.config; numba.core.config.reload_config(); del numba\n'


@dataclass(frozen=True)
class Ended:
    """A process that has ended."""

    status: int
    stdout: str
    stderr: str

    @property
    def words(self):
        """What it wrote, where that is all that happened: no fault, no notice."""
        assert (self.status, self.stderr) == (0, ''), self
        return self.stdout.split()

    @property
    def words_after_a_notice(self):
        """What it wrote, where it also said in one line that it keeps nothing."""
        assert self.status == 0, self
        assert self.stderr.count('\n') == 1 and 'cannot keep' in self.stderr, self
        return self.stdout.split()


@dataclass
class OwnPackage:
    """A copy of the package in a folder, and the environment of the processes that use it.

    `anew` starts them as a user does; else they are forked from one that has loaded numba, and
    nothing of the package, where that is the same.
    """

    folder: Path
    env: dict = field(default_factory=dict)
    wrapper: list = field(default_factory=list)
    anew: bool = False

    @property
    def physics(self):
        """The folder of the room."""
        return self.folder / 'pool_sim_ros' / 'physics'

    @property
    def kept(self):
        """All compiled kernels beside the package."""
        return sorted(self.physics.glob('__pycache__/kernels-*/*'))

    def command(self, script):
        """Return a command that runs a script."""
        return [*self.wrapper, sys.executable, '-c', script]

    def start(self, script, **options):
        """Start a process that runs a script."""
        at_start = {name for name in self.env if name.startswith(LEFT_OUT)}
        can_fork = self.env['PYTHONPATH'] == str(self.folder) and at_start <= READ_AGAIN
        if can_fork and not (self.anew or self.wrapper or options):
            order = {'script': AGAIN + script}
            return Forked(order, subprocess.PIPE, self.env, self.folder, _starter()[0])
        return subprocess.Popen(
            self.command(script),
            env=self.env,
            cwd=self.folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            **options,
        )

    def run(self, script, **options):
        """Run a script to its end."""
        process = self.start(script, **options)
        try:
            stdout, stderr = process.communicate(timeout=300)
        finally:
            process.kill()
        return Ended(process.returncode, stdout, stderr)

    def check(self, x=0.5, **options):
        """Look whether a ball lies on a table."""
        return self.run(CHECK.format(x=x), **options)

    def edit(self, name, old, new):
        """Edit a file of the room; later than all that was done before, also by coarse clocks."""
        path = self.physics / name
        text = path.read_text()
        assert text.count(old) == 1
        path.write_text(text.replace(old, new))
        later = path.stat().st_mtime + 10.0
        os.utime(path, (later, later))


def copy_package(folder):
    """Return a copy of the package, with a home and no settings of its own."""
    shutil.copytree(
        PACKAGE, folder / 'pool_sim_ros', ignore=shutil.ignore_patterns('__pycache__', '*.tmp')
    )
    home = folder / 'home'
    home.mkdir()
    return OwnPackage(folder, {**_bare(), 'HOME': str(home), 'PYTHONPATH': str(folder)})


def _bare():
    return {name: value for name, value in os.environ.items() if not name.startswith(LEFT_OUT)}


@functools.cache
def _starter():
    """Return the socket that takes orders of processes that have loaded numba, and itself."""
    return start_starter(_bare(), 'warm_numba')


def as_stranger():
    """Return what to put before a command so that a user runs it who may write nowhere.

    The interpreter of the tests may lie in a home that others cannot enter, so all may be read.
    """
    if not hasattr(os, 'geteuid') or os.geteuid() != 0:
        return []
    wrapper = _setpriv(f'--reuid={STRANGER}', f'--regid={STRANGER}', '--clear-groups', keep=True)
    return _that_works(wrapper)


def without_capabilities():
    """Return what to put before a command so that permissions bind it, even one that root runs."""
    if not hasattr(os, 'geteuid') or os.geteuid() != 0:
        return []
    return _that_works(_setpriv())


def _setpriv(*words, keep=False):
    which = '-all,+dac_read_search' if keep else '-all'
    sets = [f'--{name}={which}' for name in ('inh-caps', 'ambient-caps', 'bounding-set')]
    return ['setpriv', *words, *sets]


def _that_works(wrapper):
    try:
        done = subprocess.run([*wrapper, sys.executable, '-c', ''], capture_output=True, text=True)
    except OSError as error:
        pytest.skip(f'needs setpriv, to run as another user: {error}')
    if done.returncode != 0:
        pytest.skip(f'root cannot give up its rights here: {done.stderr.strip()}')
    return wrapper
