"""The SROS2 policy names what the node has, and docs/security.md the limits that there are."""

import importlib
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from pool_sim_ros.ros import OracleNode, interface, oracle_interface
from pool_sim_ros.ros.client import ShotClient
from pool_sim_ros.ros.recorder import Recorder

PROJECT = Path(__file__).resolve().parents[2]
POLICY = ET.parse(PROJECT / 'config' / 'sros2_policy.xml')
ORACLE_INPUTS = (oracle_interface.WHAT_IF_REQUEST, oracle_interface.PLAN_REQUEST)
OWN = {'/parameter_events', '/rosout', '/clock'}


def allowed(enclave, kind, right):
    [profile] = POLICY.findall(f".//enclave[@path='{enclave}']//profile")
    found = profile.findall(f"{kind}s[@{right}='ALLOW']/{kind}")
    return {element.text.replace('~', '/pool_sim') for element in found}


def test_the_policy_allows_the_node_what_it_has_and_no_more(ros):
    node = ros.sim_node(publish_clock=True)
    name = node.get_name(), node.get_namespace()
    published = {topic for topic, _ in node.get_publisher_names_and_types_by_node(*name)}
    read = {topic for topic, _ in node.get_subscriber_names_and_types_by_node(*name)}
    served = {service for service, _ in node.get_service_names_and_types_by_node(*name)}
    assert allowed('/pool_sim', 'topic', 'publish') - published <= {'/pool_sim/markers'}
    assert published <= allowed('/pool_sim', 'topic', 'publish')
    assert read <= allowed('/pool_sim', 'topic', 'subscribe') <= read | OWN
    assert served <= allowed('/pool_sim', 'service', 'reply')


def test_the_policy_allows_a_client_the_other_ends():
    topics = [item for item in vars(interface).values() if isinstance(item, interface.Topic)]
    inputs = (interface.CUE_VELOCITY, interface.SHOT_REQUEST, interface.SET_BALL_POSES)
    names = {topic.of('/pool_sim') for topic in inputs}
    asked = {topic.of('/pool_oracle') for topic in ORACLE_INPUTS}
    assert allowed('/pool_client', 'topic', 'publish') == names | asked | {
        '/parameter_events',
        '/rosout',
    }
    heard = allowed('/pool_client', 'topic', 'subscribe')
    assert {topic.of('/pool_sim') for topic in topics} - names <= heard
    assert {topic.of('/pool_oracle') for topic in oracle_interface.TOPICS} - asked <= heard
    services = [item for item in vars(interface).values() if isinstance(item, interface.Service)]
    used = {s.of('/pool_sim') for s in services} | {'/pool_sim/set_parameters'}  # the page's speed
    assert allowed('/pool_client', 'service', 'request') == used


def test_the_policy_allows_the_oracle_what_it_has_and_no_more(ros):
    node = ros.add(OracleNode(context=ros.context))
    name = node.get_name(), node.get_namespace()
    published = {topic for topic, _ in node.get_publisher_names_and_types_by_node(*name)}
    read = {topic for topic, _ in node.get_subscriber_names_and_types_by_node(*name)}
    served = {service for service, _ in node.get_service_names_and_types_by_node(*name)}
    assert allowed('/pool_oracle', 'topic', 'publish') == published
    looked = (interface.TABLE, interface.STATE, interface.BALL_POSES, interface.SHOT_RESPONSE)
    seen = {topic.of('/pool_sim') for topic in looked}
    assert read | seen <= allowed('/pool_oracle', 'topic', 'subscribe') <= read | seen | OWN
    assert served == allowed('/pool_oracle', 'service', 'reply')


def test_clients_have_nothing_but_what_the_policy_allows(ros, domain):
    context = ros.context
    client, recorder = ShotClient(context), Recorder(context, '/pool_sim')
    watcher = ros.node()
    try:
        ros.spin_until(lambda: len(names_of(watcher)) == 2, 'the clients')
        for name in names_of(watcher):
            published = {t for t, _ in watcher.get_publisher_names_and_types_by_node(name, '/')}
            heard = {t for t, _ in watcher.get_subscriber_names_and_types_by_node(name, '/')}
            assert published <= allowed('/pool_client', 'topic', 'publish')
            assert heard <= allowed('/pool_client', 'topic', 'subscribe')
            assert watcher.get_service_names_and_types_by_node(name, '/') == []
    finally:
        recorder.close()
        client.close()


def names_of(node):
    return [name for name in node.get_node_names() if name.startswith(('pool_c', 'pool_r'))]


LIMITS = re.findall(r'`([\w.]+)\.([A-Z_]{3,})`', (PROJECT / 'docs' / 'security.md').read_text())


@pytest.mark.parametrize(('module', 'name'), LIMITS)
def test_each_limit_that_is_documented_exists(module, name):
    assert hasattr(importlib.import_module(f'pool_sim_ros.{module}'), name)


def test_the_limits_are_found_in_the_document():
    assert len(LIMITS) >= 10
