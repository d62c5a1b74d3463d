"""A Dask cluster on this machine, in a process of its own that ends with whoever started it.

In a process of its own, so that a script needs no ``if __name__ == '__main__'``: workers that are
started by the script itself would run it once more.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from pool_sim_ros.study.errors import SweepError

PATIENCE = 10.0
"""Seconds in which the cluster ends by itself before it is killed."""


@contextmanager
def local_cluster(workers: int) -> Iterator[str]:
    """Start so many workers of one thread each; give the address of their scheduler.

    Raises
    ------
    SweepError
        Where it does not start; the last line of what it said.
    """
    folders = [str(Path(__file__).parents[2]), os.environ.get('PYTHONPATH', '')]
    with tempfile.TemporaryFile('w+') as said:
        process = subprocess.Popen(
            [sys.executable, '-m', __name__, str(workers)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=said,
            text=True,
            env={**os.environ, 'PYTHONPATH': os.pathsep.join(filter(None, folders))},
            start_new_session=True,  # Ctrl-C is for this process alone
        )
        assert process.stdin is not None and process.stdout is not None
        try:
            address = process.stdout.readline().strip()
            if not address:
                process.wait()
                said.seek(0)
                lines = said.read().strip().splitlines() or ['it said nothing']
                raise SweepError(f'workers: the local cluster did not start: {lines[-1]}')
            yield address
        finally:
            process.stdin.close()
            try:
                process.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
            process.stdout.close()


def main() -> None:
    """Run the cluster until standard input ends."""
    from distributed import LocalCluster

    with LocalCluster(
        n_workers=int(sys.argv[1]),
        threads_per_worker=1,
        processes=True,
        host='127.0.0.1',
        dashboard_address=None,
        memory_limit=None,  # a region bounds it
    ) as cluster:
        print(cluster.scheduler_address, flush=True)
        sys.stdin.read()


if __name__ == '__main__':
    main()
