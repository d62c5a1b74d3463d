"""Attack a node, and see whether it still plays as printed."""

import os
from pathlib import Path

from ros_harness import Observer

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
