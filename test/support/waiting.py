"""Waiting for conditions, without ROS."""

import time

PATIENCE = 120.0
"""Seconds after which what was waited for will not come, on the slowest machine."""


def wait_until(condition, what):
    """Wait for a condition that another thread or process brings about."""
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, f'waited {PATIENCE:g} s for {what}'
        time.sleep(0.005)
