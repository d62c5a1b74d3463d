"""A client places balls and calls services; each refusal is one clear error."""

import pytest
from ros_harness import spinning

from pool_sim_ros.ros import ShotClient, SimulatorError, interface

TIMEOUT = 60.0


@pytest.fixture
def client(ros):
    with spinning(ros.sim_node(table_preset='7ft', real_time_factor=0.0)):
        client = ShotClient(ros.context)
        client.wait_for_simulator(TIMEOUT)
        yield client
        client.close()


def test_balls_are_placed_struck_with_a_cue_and_reset(client):
    response = client.place({'9': (0.9, 0.3), '8': (0.9, 0.6)}, timeout=TIMEOUT)
    assert response['final_positions']['9'] == [0.9, 0.3] and response['phase'] == 'done'
    cue = {'speed': 2.0, 'azimuth': 180.0, 'side': 0.2, 'above': -0.3}
    done = client.play(cue=cue, timeout=TIMEOUT)
    assert done['cue'] == cue and done['spin'][2] != 0.0 and done['pocketed'] == {}
    done = client.play(velocity=(1.0, 0.0), spin=(0.0, 50.0, 0.0), timeout=TIMEOUT)
    assert done['spin'] == [0.0, 50.0, 0.0]
    assert 'start layout' in client.call(interface.RESET, timeout=TIMEOUT)


def test_the_table_is_paused_stepped_and_resumed(client):
    with pytest.raises(SimulatorError, match='set_paused first'):
        client.call(interface.STEP, timeout=TIMEOUT)
    assert client.call(interface.SET_PAUSED, timeout=TIMEOUT, data=True) == 'paused'
    assert client.call(interface.STEP, timeout=TIMEOUT).startswith('at tick ')
    assert client.place({'9': (0.9, 0.3)}, timeout=TIMEOUT)['phase'] == 'done'  # without a frame
    assert client.call(interface.SET_PAUSED, timeout=TIMEOUT, data=False) == 'playing'


@pytest.mark.parametrize(
    ('ask', 'words'),
    [
        (lambda client: client.place({'9': (0.0, 0.0)}, timeout=TIMEOUT), 'BAD_LAYOUT.*pocket 0'),
        (lambda client: client.place({'x': (0.5, 0.5)}, timeout=TIMEOUT), 'BAD_LAYOUT.*"x"'),
        (
            lambda client: client.play(
                cue={'speed': 1.0, 'azimuth': 0.0, 'side': 0.7}, timeout=TIMEOUT
            ),
            'BAD_VELOCITY.*miscue',
        ),
    ],
)
def test_a_refusal_is_one_line_with_its_code(client, ask, words):
    with pytest.raises(SimulatorError, match=words) as error:
        ask(client)
    assert '\n' not in str(error.value)


def test_a_service_of_nobody_is_told_after_the_timeout(ros):
    client = ShotClient(ros.context, '/nobody')
    try:
        with pytest.raises(SimulatorError, match='/nobody did not answer reset within 0.2 s'):
            client.call(interface.RESET, timeout=0.2)
    finally:
        client.close()
