"""A simulator and its oracle in this process, each with a thread, for tests over topics."""

import contextlib

import numpy as np
from ros_harness import Ros, spinning
from waiting import wait_until

from pool_sim_ros.ros import OracleNode, PlanClient, ShotClient, WhatIfClient

TIMEOUT = 60.0


def spin_until(future):
    """Wait for a future that another thread completes; return its result, or raise its error."""
    wait_until(future.done, 'an answer')
    return future.result()


class Hall:
    """A simulator, its oracle, and clients of both.

    Attributes
    ----------
    what_if, plans : WhatIfClient, PlanClient
        On one node.
    shots : ShotClient
    """

    def __init__(self, ros, simulator, oracle):
        self.ros, self.simulator, self.oracle = ros, simulator, oracle
        self.node = ros.node('player')
        self.what_if = WhatIfClient(self.node)
        self.plans = PlanClient(self.node)
        self.shots = ShotClient(ros.context)

    def ask(self, candidates):
        return spin_until(self.what_if.ask(candidates))

    def plan(self, goal, noise='fastfiz', **search):
        return spin_until(self.plans.plan(goal, noise, **search))

    def wait_until_ready(self):
        """Wait until the oracle knows the table, and knows that all balls rest."""
        wait_until(self.oracle.is_ready, 'the table of the oracle')


@contextlib.contextmanager
def hall(domain, of_oracle=(), **parameters):
    """Start a simulator with these parameters, an oracle with its own, and clients."""
    with Ros(domain) as ros, contextlib.ExitStack() as stack:
        simulator = ros.sim_node(**parameters)
        oracle = ros.add(
            OracleNode(context=ros.context, threads=1, parameter_overrides=list(of_oracle))
        )
        made = Hall(ros, simulator, oracle)
        stack.callback(made.shots.close)
        for node in (simulator, oracle, made.node):
            stack.enter_context(spinning(node))
        made.wait_until_ready()
        made.shots.wait_for_simulator(TIMEOUT)
        yield made


def strokes(count, seed=1):
    """Return random velocities of the cue ball, (count, 2), m/s."""
    rng = np.random.default_rng(seed)
    angle, speed = rng.uniform(0.0, 2.0 * np.pi, count), rng.uniform(0.3, 5.0, count)
    return np.stack([speed * np.cos(angle), speed * np.sin(angle)], axis=-1)
