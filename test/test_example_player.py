"""The example that plays ball after ball with an oracle runs over real topics, unattended."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from process_harness import Process, node_process

PROJECT = Path(__file__).parents[1]
EXAMPLE = PROJECT / 'docs' / 'example_player.py'
TWELVE = ['9', '4', '7', '1', '10', '2', '8', '3', '6', '5', '9', '1']
LINE = re.compile(r'(\d+): ball (\w+): (\d+ %|\d+%), ended at \[\d\.\d\d, \d\.\d\d\]')


@pytest.fixture(scope='module')
def room(domain):
    """A simulator and an oracle as processes of their own."""
    with node_process(real_time_factor=0.0, report_integrator='event'), Process('cli.oracle') as it:
        yield it.wait_for('ready')


@pytest.mark.parametrize('balls', [TWELVE[:2], pytest.param(TWELVE, marks=pytest.mark.soak)])
def test_each_problem_is_solved_and_played_without_one_missed_answer(room, balls):
    played = subprocess.run(
        [sys.executable, EXAMPLE, *balls],
        capture_output=True,
        text=True,
        timeout=300,
        env=os.environ,
    )
    assert (played.returncode, played.stderr) == (0, '')
    found = [LINE.fullmatch(line) for line in played.stdout.splitlines()]
    assert all(found), played.stdout
    assert [(line[1], line[2]) for line in found] == [
        (str(k), ball) for k, ball in enumerate(balls, 1)
    ]


def test_the_example_of_a_what_if_runs(room):
    page = (PROJECT / 'docs' / 'oracle.md').read_text()
    (block,) = re.findall(r'^```python\n(import rclpy\n.*?)^```', page, re.M | re.S)
    asked = subprocess.run(
        [sys.executable, '-c', block], capture_output=True, text=True, timeout=300, env=os.environ
    )
    assert asked.stdout.startswith('(2, 11, 2) ['), asked.stderr


def test_the_page_shows_the_example_as_it_is():
    assert EXAMPLE.read_text().strip() in (PROJECT / 'docs' / 'oracle.md').read_text()
