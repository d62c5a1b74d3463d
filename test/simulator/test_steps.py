import math
from types import SimpleNamespace

import pytest

from pool_sim_ros.simulator import steps as steps_module
from pool_sim_ros.simulator.steps import MOST_STEPS, Steps


class Table:
    """Counts ticks."""

    def __init__(self, paused=True, computing=False, step_ticks=3):
        self.paused, self.computing, self.tick = paused, computing, 0
        self.settings = SimpleNamespace(step_ticks=step_ticks)

    def show_next_frame(self):
        self.tick += 1


def steps_on(table):
    return Steps(table, table.show_next_frame)


def results(answers):
    return [answer.result(0.0) if answer.done() else None for answer in answers]


def test_a_paused_table_is_stepped_at_once():
    table = Table()
    steps = steps_on(table)
    assert steps.add().result(0.0) == (True, 'at tick 3')
    assert steps.add().result(0.0) == (True, 'at tick 6')
    assert steps.wait == math.inf


def test_a_table_that_plays_is_not_even_while_a_shot_is_computed():
    for computing in (False, True):
        table = Table(paused=False, computing=computing)
        done, words = steps_on(table).add().result(0.0)
        assert not done and 'set_paused' in words and table.tick == 0


def test_steps_wait_for_a_shot_and_are_then_done_in_order_one_each_time():
    table = Table(computing=True)
    steps = steps_on(table)
    answers = [steps.add() for _ in range(3)]
    steps.serve()
    assert results(answers) == [None] * 3 and steps.wait < 0.1 and table.tick == 0
    table.computing = False
    answers.append(steps.add())  # behind those that wait
    assert table.tick == 0
    for count in range(1, 5):
        steps.serve()
        assert table.tick == 3 * count
    assert results(answers) == [(True, f'at tick {tick}') for tick in (3, 6, 9, 12)]
    steps.serve()
    assert table.tick == 12 and steps.wait == math.inf


def test_a_step_that_waited_long_is_refused(monkeypatch):
    monkeypatch.setattr(steps_module, 'STEP_PATIENCE', 0.0)
    table = Table(computing=True)
    steps = steps_on(table)
    answer = steps.add()
    steps.serve()
    done, words = answer.result(0.0)
    assert not done and 'computed' in words and table.tick == 0


def test_a_table_that_is_resumed_lets_no_step_wait():
    table = Table(computing=True)
    steps = steps_on(table)
    answer = steps.add()
    table.paused = False
    steps.serve()
    assert answer.result(0.0)[0] is False


@pytest.mark.parametrize('too_many', [1, 5])
def test_only_so_many_wait(too_many):
    table = Table(computing=True)
    steps = steps_on(table)
    waiting = [steps.add() for _ in range(MOST_STEPS)]
    refused = [steps.add() for _ in range(too_many)]
    assert not any(answer.done() for answer in waiting)
    assert all(not done and str(MOST_STEPS) in words for done, words in results(refused))
    steps.close()
    assert all(not done and 'stops' in words for done, words in results(waiting))
