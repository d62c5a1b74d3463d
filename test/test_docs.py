"""What the documentation names exists, and its node runs; test_examples.py runs its other code."""

import ast
import json
import os
import random
import re
import subprocess
import sys
from pathlib import Path

import pytest
from process_harness import Process, node_process
from ros_harness import spinning
from waiting import PATIENCE, wait_until

from pool_sim_ros.physics import report_table, simulate
from pool_sim_ros.ros import interface, messages

PROJECT = Path(__file__).parents[1]
EXAMPLE = PROJECT / 'docs' / 'example_node.py'


def run(*command):
    """Run a script beside the node."""
    command = [sys.executable, *command]
    return subprocess.run(command, capture_output=True, text=True, timeout=60, env=os.environ)


def test_the_example_nodes_shoot_and_hear_what_came_of_it(domain):
    with node_process(real_time_factor=10.0) as node:
        node.wait_for('ready')
        rider = run(PROJECT / 'examples' / 'ride_along.py', '--shots', '2', '--seed', '1')
        example = run(EXAMPLE)
    assert rider.returncode == 0, rider.stderr
    ends = re.findall(r'^The cue ball rests at \((.*), (.*)\) m\.$', rider.stdout, re.M)
    assert [tuple(map(float, end)) for end in ends] == ends_of_strikes(2, seed=1)
    assert example.stdout.startswith('done ['), example.stderr
    x, y = ast.literal_eval(example.stdout.removeprefix('done '))
    assert 0 < x < 2.2352 and 0 < y < 1.1176


def ends_of_strikes(count, seed):
    """Return where the cue ball rests, m, each time that it is struck as the rider does it."""
    table, strikes, ends = report_table(), random.Random(seed), []
    positions = table.positions
    for _ in range(count):
        velocity = [strikes.uniform(-4.0, -1.0), strikes.uniform(-1.0, 1.0)]
        positions = simulate(table, velocity, positions=positions).final_positions
        ends.append(tuple(round(float(place), 3) for place in positions[0]))
    return ends


def example_that_waits(folder, seconds):
    """Return a copy of the example that gives up after so many seconds."""
    text = EXAMPLE.read_text()
    assert text.count('PATIENCE = 30.0') == 1
    copy = folder / 'example_node.py'
    copy.write_text(text.replace('PATIENCE = 30.0', f'PATIENCE = {seconds}'))
    return copy


@pytest.fixture
def heard(ros):
    """What somebody else who subscribes to the requests has heard, and foreign answers to them."""
    texts, node = [], ros.node('bystander')
    requests, responses = interface.SHOT_REQUEST, interface.SHOT_RESPONSE
    answers = node.create_publisher(responses.type, responses.of('pool_sim'), responses.qos)

    def on_request(request):
        texts.append(request.data)
        for text in ('5', '', '[' * 100_000, '{"id": 5}'):
            answers.publish(messages.to_string(text))

    node.create_subscription(requests.type, requests.of('pool_sim'), on_request, requests.qos)
    with spinning(node):
        yield texts


def test_the_example_gives_up_where_only_somebody_else_listens(ros, heard, tmp_path):
    with Process(example_that_waits(tmp_path, 10.0)) as example:
        assert example.wait() == 1
    assert 'did not end within 10 s' in example.stderr and 'Traceback' not in example.stderr
    assert example.stdout == '' and len(heard) > 1 and len(set(heard)) == 1


def test_the_example_asks_again_until_the_simulator_is_there(ros, heard, tmp_path):
    with Process(example_that_waits(tmp_path, PATIENCE)) as example:
        wait_until(lambda: heard, 'a request that is lost')
        with spinning(ros.sim_node(real_time_factor=10.0)):
            assert example.wait() == 0, example.stderr
    assert example.stdout.startswith('done [')


def test_the_tour_shows_the_example_as_it_is():
    assert EXAMPLE.read_text().strip() in (PROJECT / 'docs' / 'tour.md').read_text()


PAGES = [*sorted(PROJECT.glob('*.md')), *sorted((PROJECT / 'docs').glob('*.md'))]


@pytest.mark.parametrize('file', PAGES, ids=lambda file: file.name)
def test_links_lead_somewhere(file):
    for link in re.findall(r'\]\(([^)#]+)', file.read_text()):
        assert '://' in link or (file.parent / link).exists(), link


@pytest.mark.parametrize('name', ['pool_table.rviz', 'foxglove_layout.json'])
def test_the_layouts_of_the_viewers_name_what_the_node_has(name):
    text = (PROJECT / 'config' / name).read_text()
    endpoints = [e for e in vars(interface).values() if isinstance(e, interface.Endpoint)]
    known = {endpoint.of(f'/{interface.NODE_NAME}') for endpoint in endpoints}
    named = {found.removesuffix('.data') for found in re.findall(r'/pool_sim/[\w/.]+', text)}
    assert '/pool_sim/markers' in named <= known
    assert 'table' in text
    if name.endswith('.json'):
        json.loads(text)


def test_the_layout_of_foxglove_has_what_its_open_fork_asks_for():
    """Lichtblick's `LayoutData` requires the first three; a layout names panels that are there."""
    layout = json.loads((PROJECT / 'config' / 'foxglove_layout.json').read_text())
    assert {'configById', 'globalVariables', 'playbackConfig', 'userNodes', 'layout'} == set(layout)
    assert layout['playbackConfig'] == {'speed': 1}

    def panels(node):
        return {node} if isinstance(node, str) else panels(node['first']) | panels(node['second'])

    assert panels(layout['layout']) == set(layout['configById'])


def test_make_help_lists_every_target():
    makefile = (PROJECT / 'Makefile').read_text()
    targets = set(re.search(r'^\.PHONY: (.*)', makefile, re.MULTILINE)[1].split()) - {'help'}
    done = subprocess.run(['make', 'help'], cwd=PROJECT, capture_output=True, text=True, timeout=60)
    assert set(re.findall(r'^make (\w+) ', done.stdout, re.MULTILINE)) == targets
    text = '\n'.join(page.read_text() for page in PAGES)
    shown = set(re.findall(r'(?:`|^    )make ([a-z]+)', text, re.MULTILINE))
    assert 'demo' in shown <= targets
