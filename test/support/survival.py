"""Attack a node, and see whether it still plays as printed."""

import json
import os
import time
import uuid
from collections import Counter
from pathlib import Path

from ros_harness import Observer
from std_msgs.msg import String

from pool_sim_ros.me212.log import published_final_positions
from pool_sim_ros.ros import interface

FAST = {'real_time_factor': 5.0}
"""A node sends each tick also at rest, so a faster one takes processor time all along."""
INPUTS = (interface.CUE_VELOCITY, interface.SHOT_REQUEST, interface.SET_BALL_POSES)
DECISIONS = ('accepted', 'rejected')


class Attacker:
    """Publishers on every input of the node."""

    def __init__(self, ros):
        node = ros.node('attacker')
        self._publishers = {
            topic.name: node.create_publisher(topic.type, topic.of('pool_sim'), topic.qos)
            for topic in INPUTS
        }
        ros.spin_until(
            lambda: all(p.get_subscription_count() for p in self._publishers.values()), 'a match'
        )

    def send(self, name, message):
        self._publishers[name].publish(message)

    def send_raw(self, name, data):
        """Return whether the sender's own middleware let these bytes pass."""
        try:
            self._publishers[name].publish(data)
        except Exception as error:
            assert 'cannot publish data' in str(error)
            return False
        return True


class Listener(Observer):
    """Hears the little that most checks need: a node that runs fast sends a flood of frames."""

    TOPICS = (interface.SHOT_RESPONSE, interface.STATE, interface.TABLE)

    def _keeper(self, topic):
        keep = super()._keeper(topic)
        return lambda message: keep(message) if message.data else None  # none of the node is empty

    def forget(self):
        """Forget all but the latest."""
        self.responses.clear()
        for heard in self.heard.values():
            del heard[:-1]


def resident(process):
    """Return the memory that a process has, in bytes."""
    pages = int(Path(f'/proc/{process._popen.pid}/statm').read_text().split()[1])
    return pages * os.sysconf('SC_PAGE_SIZE')


def plays_as_printed(observer):
    """Reset, play shot 1 and compare with the print; no answer may come twice."""
    observer.call(interface.SET_PAUSED, data=False)
    observer.call(interface.RESET)
    asked = observer.ask(shot=1)
    done = observer.wait_for_phase(asked, 'done')
    assert {k: tuple(v) for k, v in done['final_positions_in'].items()} == (
        published_final_positions()[1]
    )
    assert observer.phases(asked) == ['accepted', 'done']


def is_served(observer):
    asked = observer.ask(shot=9)
    assert observer.wait_for_phase(asked, 'rejected')['code'] == 'UNKNOWN_SHOT'


def an_hour(observer, process, request, reset=False):
    """Play shots for an hour of sim time; return the memory of the node after each tenth of it.

    `request` makes the fields of a request from how many shots were played; `reset` tells whether
    the balls go back before each.
    """
    sizes, played = [], 0
    while len(sizes) < 10:
        if reset:
            observer.call(interface.RESET)
        done = observer.wait_for_phase(observer.ask(**request(played)), 'done')
        played += 1
        if done['t_end'] > 360.0 * (len(sizes) + 1):
            sizes.append(resident(process))
        observer.forget()
    return sizes


def in_mib(sizes):
    return [round(size / 2**20, 1) for size in sizes]


def flood(observer, attacker, seconds, strike, request, rate=5000):
    """Send so many commands a second: by turns what `strike` and `request` make."""
    start, sent = time.monotonic(), 0
    while (elapsed := time.monotonic() - start) < seconds:
        while sent < elapsed * rate:
            sent += 1
            if sent % 2:
                attacker.send('cue_velocity', strike())
            else:
                fields = {'id': uuid.uuid4().hex, **request()}
                attacker.send('shot/request', String(data=json.dumps(fields)))
        observer._ros.executor.spin_once(0.0)
    return sent


def is_unharmed(ros):
    """After a flood: it is served again, also after a reset, and each request had one answer."""
    observer = Observer(ros).wait_for_match()  # who heard the flood has thousands to look through
    is_served(observer)
    observer.call(interface.RESET)
    is_served(observer)
    last = observer.ask(shot=9)
    observer.wait_for_phase(last, 'rejected')  # so it has heard all before
    counts = Counter((r['id'], r['phase'] in DECISIONS) for r in observer.responses)
    assert max(counts.values()) == 1
    accepted = {r['id'] for r in observer.responses if r['phase'] == 'accepted'}
    over = {r['id'] for r in observer.responses if r['phase'] in ('done', 'preempted')}
    assert accepted <= over
    # What is kept for who comes late begins somewhere: it may be within one shot.
    assert len(over - accepted) <= 1
