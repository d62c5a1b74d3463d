"""A cluster on this machine, in a process of its own."""

import subprocess
import sys

import distributed  # noqa: F401, what is started
import psutil
import pytest
from waiting import wait_until

from pool_sim_ros.study import local_cluster as module
from pool_sim_ros.study.errors import SweepError
from pool_sim_ros.study.local_cluster import local_cluster

SCRIPT = """
print('begins', flush=True)
import sys
from pool_sim_ros.study.local_cluster import local_cluster
with local_cluster(1) as address:
    print(address, flush=True)
    sys.stdin.read()
"""


def test_it_ends_with_whoever_started_it_even_one_that_is_killed(tmp_path):
    """A script without `if __name__ == '__main__'`, as users write them: no worker runs it too."""
    script = tmp_path / 'mine.py'
    script.write_text(SCRIPT)
    user = subprocess.Popen(
        [sys.executable, script], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    try:
        assert user.stdout.readline() == 'begins\n'
        assert user.stdout.readline().startswith('tcp://127.0.0.1:')
        children = psutil.Process(user.pid).children(recursive=True)
        assert len(children) >= 2
    finally:
        user.kill()
        user.wait()
        user.stdin.close(), user.stdout.close()
    wait_until(lambda: not any(map(_runs, children)), 'the cluster to end')


def _runs(process):
    try:
        return process.is_running() and process.status() != psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return False


def test_one_that_does_not_start_says_why(monkeypatch):
    real = subprocess.Popen

    def broken(command, **given):
        return real([sys.executable, '-c', 'raise OSError("no ports left")'], **given)

    monkeypatch.setattr(module.subprocess, 'Popen', broken)
    with pytest.raises(SweepError, match='did not start: OSError: no ports left'):
        with local_cluster(1):
            pass
