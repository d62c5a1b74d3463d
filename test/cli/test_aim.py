"""The command `aim`: the shots as a table, and the best played; each mistake is one line."""

import re

import pytest
from process_harness import Process, node_process

from pool_sim_ros.oracle import Goal, Noise, find_shots
from pool_sim_ros.physics import report_table, simulate

PATIENT = ['--timeout', '60']
QUICK = ['--shots', '3000', '--noise', 'sjtu', '--within', '0.3', *PATIENT]
GOAL = ['--ball', '9', '--to', '0.30', '0.20']


@pytest.fixture(scope='module')
def simulator(domain):
    with node_process(real_time_factor=0.0, report_integrator='event') as process:
        yield process


def test_the_table_is_that_of_find_shots_and_the_best_is_played(simulator):
    goal = Goal(ball='9', to=(0.3, 0.2), within=0.3)
    plan = find_shots(report_table(), goal, Noise.preset('sjtu'), 3000, count=2)
    with Process('cli.aim', *GOAL, *QUICK, '--count', '2', '--shoot') as aim:
        assert aim.wait() == 0, aim.stderr
    table, played = aim.stdout[: len(str(plan)) + 1], aim.stdout[len(str(plan)) + 1 :]
    assert table == f'{plan}\n' and len(plan) == 2
    ends = simulate(report_table(), plan[0].velocity).final_positions
    found = dict(re.findall(r'(\w+) (\[[\d., ]+\])', played))
    labels = report_table().labels
    assert found == {
        label: f'[{x:.3f}, {y:.3f}]' for label, (x, y) in zip(labels, ends.tolist(), strict=True)
    }
    # The balls lie elsewhere now, and the next search begins there.
    moved = find_shots(report_table(), goal, Noise.preset('sjtu'), 3000, positions=ends)
    with Process('cli.aim', *GOAL, *QUICK) as aim:
        assert aim.wait() == 0, aim.stderr
    assert aim.stdout == f'{moved}\n'


@pytest.mark.parametrize(
    ('args', 'words'),
    [
        (['--ball', '99', '--to', '0.3', '0.2'], "goal: ball: '99' is not on the table"),
        (['--ball', '9', '--pot'], 'no pockets'),
        (['--cue-to', '9', '9'], 'off the cloth'),
        (['--goal', '{"ball": "9"}'], 'is no goal'),
        ([*GOAL, '--offset', '0.3'], 'discs do not spin'),
    ],
)
def test_a_goal_that_cannot_be_is_one_clear_line_and_status_1(simulator, args, words):
    with Process('cli.aim', *args, *QUICK) as aim:
        assert aim.wait() == 1
        assert words in aim.stderr and aim.stderr.count('\n') == 1
        assert aim.stdout == ''


def test_none_found_is_an_answer_but_nothing_to_play(simulator):
    never = ['--first-hit', '1', '--first-hit', '2', '--shots', '1000', *PATIENT]
    with Process('cli.aim', *never, '--shoot') as aim:
        assert aim.wait() == 1
        assert aim.stdout.startswith('None found: ')
        assert aim.stderr == 'aim: there is no shot to play\n'


def test_no_node_is_one_clear_line_and_status_1(domain):
    with Process('cli.aim', *GOAL, '--node', '/nobody', '--timeout', '0.2') as aim:
        assert aim.wait() == 1
        assert '/nobody' in aim.stderr and aim.stderr.count('\n') == 1
