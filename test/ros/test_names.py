"""Names of nodes, as a user may type them."""

import argparse

import pytest
from rclpy.validate_full_topic_name import validate_full_topic_name

from pool_sim_ros.ros import NODE_NAME, interface
from pool_sim_ros.ros.names import LONGEST_NAME, node_name


@pytest.mark.parametrize('name', ['pool_sim', '/pool_sim', '/hall/left', 'hall/left_2', 'A1', '_a'])
def test_a_good_name_is_taken_as_it_is(name):
    assert node_name(name) == name
    full = interface.SHOT_REQUEST.of(name if name.startswith('/') else f'/{name}')
    assert validate_full_topic_name(full)


@pytest.mark.parametrize(
    'name',
    [
        *['', ' ', '/', '//', 'a b', 'a//b', 'a/', '/a/', '1st', 'a/2nd', '~', '~/a', 'a-b', 'a.b'],
        *['bäll', '{node}', 'a\n', '-1', '--', 'a:=b', 'a' * 201, '/ns' * 70],
    ],
)
def test_a_name_that_no_node_can_have_is_told(name):
    with pytest.raises(argparse.ArgumentTypeError, match='name') as error:
        node_name(name)
    assert '\n' not in str(error.value)


def test_the_longest_name_leaves_room_for_every_topic():
    name = '/' + 'a' * (LONGEST_NAME - 1)
    assert node_name(name) == name
    for endpoint in vars(interface).values():
        if isinstance(endpoint, interface.Endpoint):
            assert validate_full_topic_name(endpoint.of(name))


def test_the_default_is_a_name():
    assert node_name(NODE_NAME) == NODE_NAME == interface.NODE_NAME
