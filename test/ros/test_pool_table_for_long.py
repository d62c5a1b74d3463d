"""A pool table under load: the soak of `test_not_brought_down`, where balls spin and are pocketed.

Run with `python -m pytest -m soak`.
"""

import random

import numpy as np
import pytest
from geometry_msgs.msg import Twist, Vector3
from process_harness import node_process
from ros_harness import Observer
from survival import Attacker, Listener, an_hour, flood, in_mib, is_unharmed

from pool_sim_ros.ros import interface

POOL = {'table.preset': '7ft'}
MINUTES = 65.0
"""Sim time in s for which frames are counted."""


def cue(*_):
    """Return the fields of a request for a break."""
    return {'cue': {'speed': random.uniform(4, 9), 'azimuth': random.uniform(178, 182)}}


def strike():
    return Twist(
        linear=Vector3(x=random.uniform(-5, 5)), angular=Vector3(z=random.uniform(-50, 50))
    )


@pytest.mark.soak
def test_soak_half_a_minute_of_5000_commands_a_second(ros, capsys):
    with node_process(real_time_factor=20.0, **POOL):
        Listener(ros).wait_for_match()
        sent = flood(Listener(ros), Attacker(ros), 30.0, strike, cue)
        with capsys.disabled():
            print(f'\n{sent} commands in 30 s')
        is_unharmed(ros)


@pytest.mark.soak
def test_soak_an_hour_of_breaks_takes_no_more_memory(ros, capsys):
    with node_process(real_time_factor=0.0, **POOL) as process:
        sizes = an_hour(Listener(ros).wait_for_match(), process, cue, reset=True)
        with capsys.disabled():
            print(f'\nMiB each tenth: {in_mib(sizes)}')
        assert sizes[-1] - sizes[1] < 2**20 * 5


@pytest.mark.soak
def test_soak_no_frame_is_lost_at_30_times_real_time(ros, capsys):
    """The client hears every frame while it has the balls broken again and again."""
    with node_process(real_time_factor=30.0, **POOL):
        observer = Observer(ros).wait_for_match()
        ros.spin_until(lambda: observer.stamps, 'a frame')
        start = observer.stamps[0] * 1e-9  # a state may be older than the first frame that is heard
        breaks = 0
        while observer.state['sim_time'] < start + MINUTES:
            observer.call(interface.RESET)
            observer.wait_for_phase(observer.ask(**cue()), 'done')
            breaks += 1
        observer.wait_for_frame_at(start + MINUTES)  # which may come after the state
        ticks = np.round(np.array(observer.stamps) * 60e-9).astype(int)
        with capsys.disabled():
            print(f'\n{len(ticks)} frames, {breaks} breaks')
        assert (np.diff(ticks) == 1).all() and len(ticks) >= 60 * MINUTES
