"""Both ends of every range that a peer may set: a step further is refused, shots are answered.

Every shot ends: it is done, or preempted with a reason, soon and in little memory.
"""

import itertools
import math

import pytest
from process_harness import node_process
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter
from ros_harness import Ros
from survival import Listener, resident

from pool_sim_ros.ros import interface
from pool_sim_ros.simulator import PARAMETERS, Change, parameters_of

SET = interface.Service('set_parameters', SetParameters, 'rclpy has it')
QUICK = {'report_integrator': 'event', 'real_time_factor': 0.0}
MOST_MEMORY = 150 * 2**20
"""Bytes that a shot may take: one of 100,000 events takes half of it."""

ENDLESS = {
    'table.e_cue_ball': 1.0, 'table.e_ball_ball': 1.0, 'table.e_ball_cushion': 1.0,
    'table.mu_ball_ball': 0.0, 'table.mu_ball_cushion': 0.0, 'table.mu_ball_surface': 1e-4,
    'max_cue_speed': 1000.0, 'max_shot_duration': 1e5,
}  # fmt: skip
"""Nothing takes energy, and nothing limits a strike."""


def edges():
    """Yield (name, value, the next number beyond) for each end of each range that may change."""
    for name, spec in parameters_of('disc').items():
        if spec.change is Change.NEVER or not isinstance(spec.default, int | float):
            continue
        if isinstance(spec.default, int):
            yield from ((name, int(spec.least), int(spec.least) - 1),)
            yield from ((name, int(spec.most), int(spec.most) + 1),)
            continue
        yield name, float(spec.least), math.nextafter(spec.least, -math.inf)
        yield name, float(spec.most), math.nextafter(spec.most, math.inf)
        if spec.smallest:
            yield name, spec.smallest, math.nextafter(spec.smallest, 0.0)


EDGES = list(edges())


@pytest.fixture(scope='module')
def table(domain):
    """A node, and who talks to it."""
    with Ros(domain) as ros, node_process(**QUICK) as process:
        yield Table(ros, process)


class Table:
    def __init__(self, ros, process):
        self.ros, self.process = ros, process
        self.observer = Listener(ros).wait_for_match()

    def set(self, **values):
        """Return the results, in order."""
        parameters = [Parameter(n, value=v).to_parameter_msg() for n, v in values.items()]
        return self.observer.call(SET, parameters=parameters).results

    def put_back(self):
        values = {
            n: s.default for n, s in parameters_of('disc').items() if s.change is not Change.NEVER
        }
        assert all(result.successful for result in self.set(**{**values, **QUICK}))
        self.observer.call(interface.SET_PAUSED, data=False)
        self.observer.call(interface.RESET)

    def end_of(self, **request):
        """Return the last response to a request."""
        asked = self.observer.ask(**request)
        over = {'done', 'preempted', 'rejected'}
        self.ros.spin_until(lambda: over & set(self.observer.phases(asked)), f'an end: {request}')
        return [r for r in self.observer.responses if r['id'] == asked][-1]


def test_every_number_that_may_change_has_its_edges_tried():
    names = [name for name, _, _ in EDGES]
    numbers = {n for n, s in parameters_of('disc').items() if type(s.default) in (int, float)}
    assert set(names) == {n for n in numbers if PARAMETERS[n].change is not Change.NEVER}
    assert len(names) >= 2 * len(set(names))


@pytest.mark.parametrize(('name', 'edge', 'beyond'), EDGES, ids=lambda value: f'{value}')
def test_an_edge_is_taken_and_one_step_beyond_is_not(table, name, edge, beyond):
    try:
        [taken] = table.set(**{name: edge})
        assert taken.successful, taken.reason
        [refused] = table.set(**{name: beyond})
        assert not refused.successful and name in refused.reason
        if name == 'real_time_factor' and 0.0 < edge < 1.0:
            accepted = table.observer.ask(velocity=[-1.0, 0.1])
            table.observer.wait_for_phase(accepted, 'accepted')
            table.observer.call(interface.RESET)
            assert table.observer.wait_for_phase(accepted, 'preempted')['code'] == 'RESET'
            return
        before = resident(table.process)
        answers = [table.end_of(velocity=[-1.0, 0.1]), table.end_of(shot=1)]
        table.set(integrator='time_slice')
        answers.append(table.end_of(velocity=[0.2, 0.05]))
        assert resident(table.process) - before < MOST_MEMORY
        for answer in answers:
            assert answer['phase'] == 'done' or answer['reason'], answer
    finally:
        table.put_back()


@pytest.mark.parametrize('speed', [100.0, 949.0])
def test_a_shot_that_nothing_slows_is_given_up_soon_and_in_little_memory(table, speed):
    try:
        assert all(result.successful for result in table.set(**ENDLESS))
        before = resident(table.process)
        for angle in (0.1, 1.0):
            velocity = [speed * math.cos(angle), speed * math.sin(angle)]
            answer = table.end_of(velocity=velocity)
            assert (answer['phase'], answer['code']) == ('preempted', 'TOO_LONG')
            assert resident(table.process) - before < MOST_MEMORY
    finally:
        table.put_back()


def test_all_corners_of_the_coefficients_are_answered(table):
    names = [name for name in parameters_of('disc') if name.startswith(('table.mu', 'table.e_'))]
    before = resident(table.process)
    try:
        for law, ends in itertools.product(
            ('report', 'coulomb'), itertools.product((0, 1), repeat=len(names))
        ):
            values = {
                name: float((PARAMETERS[name].least, PARAMETERS[name].most)[end])
                for name, end in zip(names, ends, strict=True)
            }
            assert all(r.successful for r in table.set(**values, **{'table.ball_friction': law}))
            answer = table.end_of(velocity=[-5.0, 0.3])
            assert answer['phase'] == 'done' or answer['reason'], answer
            table.observer.call(interface.RESET)
        assert resident(table.process) - before < MOST_MEMORY
    finally:
        table.put_back()
