"""How fast the node is: one row for each promise.

    python -m pytest test/benchmark/test_bench_node.py

Processes are those of users: the node in one, each reader in another. Medians over rounds, and the
load of the machine beside them, since every row but the processor time suffers from others' work.
"""

import contextlib
import json
import os
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from geometry_msgs.msg import Twist, Vector3
from process_harness import Process, node_process, start_node
from ros_harness import Observer
from waiting import PATIENCE

from pool_sim_ros.ros import interface

READER = Path(__file__).with_name('node_reader.py')
LATENESS = Path(__file__).with_name('lateness.py')

ROLLING = {  # the balls roll for hours, slowly: a shot has at most 100,000 events
    'table.mu_ball_surface': 0.0001, 'table.e_cue_ball': 1.0, 'table.e_ball_ball': 1.0,
    'table.e_ball_cushion': 1.0, 'table.mu_ball_ball': 0.0, 'table.mu_ball_cushion': 0.0,
    'table.gravity': 0.2, 'max_shot_duration': 100000.0, 'publish_clock': 'true',
}  # fmt: skip
STRIKE = [-1.0, 0.14]
POOL = {'table.preset': '7ft'}
BREAK = {'speed': 8.0, 'azimuth': 180.0}
ROUNDS = 3


@pytest.fixture
def tell(results):
    """Add a row; beside the figure the load, from which every row but the first two suffers."""

    def tell(what, figure, target):
        results.note('The node', what, f'{figure} (load {os.getloadavg()[0]:.1f})', target)

    return tell


class Reader:
    """A reader in a process of its own."""

    def __init__(self):
        self._process = subprocess.Popen(
            [sys.executable, READER], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )

    def wait_for_match(self):
        assert json.loads(self._process.stdout.readline())['matched']
        return self

    def close(self):
        """Stop it and return what it heard."""
        heard, _ = self._process.communicate(timeout=PATIENCE)
        return json.loads(heard.splitlines()[-1])


@contextlib.contextmanager
def readers(count):
    made = [Reader() for _ in range(count)]
    try:
        yield [reader.wait_for_match() for reader in made]
    finally:
        for reader in made:
            if reader._process.poll() is None:
                reader.close()


def processor_seconds(process):
    fields = Path(f'/proc/{process._popen.pid}/stat').read_text().rsplit(')', 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')


class Client(Observer):
    """Hears answers and states only, so that it is no reader of frames."""

    TOPICS = (interface.SHOT_RESPONSE, interface.STATE, interface.TABLE)


@pytest.mark.parametrize('count', [0, 4])
def test_processor_time(ros, tell, count):
    with node_process(anew=True, **ROLLING) as process, readers(count):
        client = Client(ros).wait_for_match()
        client.wait_for_phase(client.ask(velocity=STRIKE), 'accepted')
        ros.spin_until(lambda: client.state['moving'], 'motion')
        shares = []
        for _ in range(ROUNDS):
            start, used = time.monotonic(), processor_seconds(process)
            spin_for(ros, 5.0)
            shares.append((processor_seconds(process) - used) / (time.monotonic() - start))
        assert client.state['moving']
    tell(f'processor at 60 Hz, {count} readers', f'{np.median(shares):.1%}', '2 %, 4 with four')


def test_processor_time_of_breaks(ros, tell):
    """Fifteen balls are broken again and again, so that finding the shot counts too."""
    with node_process(anew=True, **POOL) as process:
        client = Client(ros).wait_for_match()
        shares = []
        for _ in range(ROUNDS):
            start, used = time.monotonic(), processor_seconds(process)
            break_for(ros, client, 15.0)
            shares.append((processor_seconds(process) - used) / (time.monotonic() - start))
    tell('processor at 60 Hz, breaks on 7 feet', f'{np.median(shares):.1%}', '2 %')


def break_for(ros, client, seconds):
    """Break every five seconds."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        client.call(interface.RESET)
        client.wait_for_phase(client.ask(cue=BREAK), 'accepted')
        spin_for(ros, min(5.0, max(end - time.monotonic(), 0.0)))


def test_as_fast_as_possible(ros, tell):
    with node_process(anew=True, **ROLLING, real_time_factor=0.0):
        client = Client(ros).wait_for_match()
        client.wait_for_phase(client.ask(velocity=STRIKE), 'accepted')
        ros.spin_until(lambda: client.state['moving'], 'motion')
        factors = []
        for _ in range(ROUNDS):
            (start, before), (end, after) = next_state(ros, client), next_state(ros, client)
            factors.append((after - before) / (end - start))
    tell('as fast as possible, no reader', f'{np.median(factors):.0f} x', '500 x')


def next_state(ros, client):
    count = len(client.heard['state'])
    ros.spin_until(lambda: len(client.heard['state']) > count, 'a state')
    assert client.state['moving']
    return time.monotonic(), client.state['sim_time']


def test_lossless(ros, tell):
    missing, heard = [], []
    for _ in range(ROUNDS):
        with node_process(anew=True, **ROLLING, real_time_factor=30.0), readers(1) as [reader]:
            client = Client(ros).wait_for_match()
            client.wait_for_phase(client.ask(velocity=STRIKE), 'accepted')
            before = client.state['sim_time']
            ros.spin_until(lambda c=client, b=before: c.state['sim_time'] > b + 65, 'a minute')
            stamps = reader.close()['stamps']
        ticks = np.round(np.array(stamps) * 60e-9).astype(int)
        missing.append(int(ticks[-1] - ticks[0] + 1 - len(ticks)))
        heard.append(len(ticks))
    tell('lossless at 30 x, one reader', f'{missing} of {heard} frames missing', '0')


def test_lateness(ros, tell):
    with node_process('node', module=LATENESS, **ROLLING) as process:
        client = Client(ros).wait_for_match()
        client.wait_for_phase(client.ask(velocity=STRIKE), 'accepted')
        spin_for(ros, 17.0)
    tell_lateness(tell, 'lateness of frames', process, 'p99 0.3 ms')
    with node_process('node', module=LATENESS, **POOL) as process:
        break_for(ros, Client(ros).wait_for_match(), 17.0)
    tell_lateness(tell, 'lateness of frames, breaks on 7 feet', process, 'as without')
    with Process(LATENESS, 'sleep').wait_for('ready') as process:
        spin_for(ros, 15.0)
        process.interrupt()
        process.wait()
    tell_lateness(tell, 'the same of a loop that only sleeps', process, '')


def tell_lateness(tell, what, process, target):
    frames = json.loads(process.stdout)[-15 * 60 :]
    p50, p99 = np.percentile(frames, [50, 99]) * 1e3
    tell(f'{what}: median, p99', f'{p50:.2f}, {p99:.2f} ms', target)


def test_strike_to_first_frame(ros, tell):
    delays = []
    with node_process(anew=True):
        observer = Observer(ros).wait_for_match()
        for _ in range(20):
            seen = len(observer.heard['ball_velocities'])
            ros.spin_until(lambda s=seen: len(observer.heard['ball_velocities']) > s, 'a frame')
            start = time.monotonic()
            observer.strike(Twist(linear=Vector3(x=-3.0, y=0.4)))
            ros.spin_until(lambda: any(observer.heard['ball_velocities'][-1].data), 'motion')
            delays.append(time.monotonic() - start)
            observer.call(interface.RESET)
            ros.spin_until(lambda: not any(observer.heard['ball_velocities'][-1].data), 'rest')
    median, worst = np.median(delays) * 1e3, max(delays) * 1e3
    tell('strike to first frame', f'median {median:.1f}, worst {worst:.1f} ms', '16.7 + 2 ms')


def test_start_to_first_frame(ros, tell):
    node_process(anew=True).__exit__()  # warms the caches
    delays = []
    for _ in range(5):
        observer = Observer(ros)
        start = time.monotonic()
        with start_node(anew=True):
            ros.spin_until(lambda o=observer: o.heard['ball_poses'], 'the first frame')
            delays.append(time.monotonic() - start)
        observer.node.destroy_node()
    tell('start to first frame heard', f'median {np.median(delays):.2f} s', '1.0 s')


def test_request_to_accepted(ros, tell):
    delays = []
    with node_process(anew=True):
        client = Client(ros).wait_for_match()
        thread, stop = spin_in_background(ros)
        try:
            for _ in range(300):
                start = time.monotonic()
                asked = client.ask(velocity=STRIKE)
                while 'accepted' not in client.phases(asked):
                    assert time.monotonic() < start + PATIENCE
                    time.sleep(1e-4)
                delays.append(time.monotonic() - start)
                client.responses.clear()
                reset(client)
        finally:
            stop.set()
            thread.join()
    p50, p99 = np.percentile(delays, [50, 99]) * 1e3
    tell('request to accepted: median, p99', f'{p50:.2f}, {p99:.2f} ms', 'p99 5 ms')


def reset(client, _made={}):  # noqa: B006 - one service client for each node
    service = interface.RESET
    if client not in _made:
        _made[client] = client.node.create_client(service.type, service.of('pool_sim'))
        assert _made[client].wait_for_service(PATIENCE)
    future = _made[client].call_async(service.type.Request())
    end = time.monotonic() + PATIENCE
    while not future.done():
        assert time.monotonic() < end
        time.sleep(1e-4)


def spin_in_background(ros):
    stop = threading.Event()

    def spin():
        while not stop.is_set():
            ros.executor.spin_once(0.1)

    thread = threading.Thread(target=spin)
    thread.start()
    return thread, stop


def spin_for(ros, seconds):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        ros.executor.spin_once(max(end - time.monotonic(), 0.0))
