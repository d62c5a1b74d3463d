"""Memory of many MB that a process frees is there for the next message."""

import json
import platform
import subprocess
import sys

import pytest

FAULTS = """
import json, resource
from pool_sim_ros.ros.large_blocks import keep_large_blocks

def faults(rounds=4, size=13 << 20):
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    for _ in range(rounds):
        blocks = [bytearray(b'x') * size for _ in range(4)]
        del blocks
    return resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before

fresh = faults()
keep_large_blocks()
faults(1)
print(json.dumps([fresh, faults()]))
"""


@pytest.mark.skipif(platform.libc_ver()[0] != 'glibc', reason='of glibc')
def test_freed_blocks_are_kept():
    done = subprocess.run([sys.executable, '-c', FAULTS], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    fresh, kept = json.loads(done.stdout)
    assert fresh > 16 * (13 << 20) / 4096 / 2  # most of 16 blocks were fresh pages
    assert kept < fresh / 4
