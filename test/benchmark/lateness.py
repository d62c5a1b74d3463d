"""How late frames are, measured in a process of its own; written as JSON when it is interrupted.

python lateness.py node [ROS arguments]     the node's own frames
python lateness.py sleep                    a loop that only sleeps until the same times
"""

import json
import sys
import time

from pool_sim_ros.cli import sim_node
from pool_sim_ros.simulator.pacer import Pacer

RATE = 60


def node(latenesses: list[float]) -> None:
    shown = Pacer.shown

    def note(pacer: Pacer) -> None:
        shown(pacer)
        latenesses.append(pacer.lateness)

    Pacer.shown = note
    sim_node.main()


def sleep(latenesses: list[float]) -> None:
    print('ready', file=sys.stderr, flush=True)
    due = time.monotonic()
    try:
        while True:
            due += 1 / RATE
            time.sleep(due - time.monotonic())
            latenesses.append(time.monotonic() - due)
    except KeyboardInterrupt:
        pass


if __name__ == '__main__':
    found: list[float] = []
    {'node': node, 'sleep': sleep}[sys.argv.pop(1)](found)
    print(json.dumps(found))
