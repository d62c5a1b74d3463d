import numpy as np
import pytest
from fakes import Glide

from pool_sim_ros.me212 import inches
from pool_sim_ros.simulator import responses
from pool_sim_ros.simulator.job import make_job
from pool_sim_ros.simulator.parameter_table import default_values
from pool_sim_ros.simulator.settings import build_settings
from pool_sim_ros.simulator.shot_request import Code, Phase, Request, Response

SETTINGS = build_settings(default_values())
REQUEST = Request(id='a', shot=3, content='shot 3')
JOB = make_job(SETTINGS, 3, (-1.0, 0.5), SETTINGS.table.positions)


@pytest.fixture
def accepted():
    return responses.accepted(REQUEST, JOB, as_printed=True)


def test_a_rejection_says_why_and_what_was_asked_for():
    request = Request(id='a', velocity=(99.0, 0.0))
    response = responses.rejected(request, Code.TOO_FAST, 'too fast')
    assert response == Response('a', Phase.REJECTED, Code.TOO_FAST, 'too fast', None, (99.0, 0.0))


def test_an_acceptance_says_what_is_going_to_be_computed(accepted):
    assert (accepted.id, accepted.phase, accepted.code) == ('a', Phase.ACCEPTED, Code.OK)
    assert (accepted.shot, accepted.velocity) == (3, JOB.velocity)
    assert (accepted.integrator, accepted.as_printed) == (JOB.integrator, True)
    assert accepted.t_start is None and accepted.final_positions is None


def test_the_same_request_gets_its_response_again_and_another_is_rejected(accepted):
    assert responses.repeated(REQUEST, REQUEST.content, accepted) is accepted
    refused = responses.repeated(REQUEST, 'shot 4', accepted)
    assert (refused.phase, refused.code, refused.id) == (Phase.REJECTED, Code.ID_REUSED, 'a')


def test_the_end_of_a_shot_says_when_it_was_and_where_the_balls_are(accepted):
    start = np.array([[0.5, 0.25], [1.0, 0.75]])
    shot = Glide(start, (1.0, 0.0), 0.5, [(0.1, 0), (0.5, 2)])
    done = responses.done(accepted, shot, ['C', '1'], start_time=2.0)
    assert (done.id, done.phase, done.shot, done.as_printed) == ('a', Phase.DONE, 3, True)
    assert (done.t_start, done.t_end, done.events) == (2.0, 2.5, 2)
    assert done.final_positions == {'C': [1.0, 0.25], '1': [1.5, 0.75]}
    assert done.final_positions_in['1'] == [inches(1.5), inches(0.75)]


@pytest.mark.parametrize('start_time', [None, 1.5])
def test_a_preempted_shot_says_why_and_whether_the_balls_started(accepted, start_time):
    preempted = responses.preempted(accepted, Code.RESET, 'the table was reset', start_time)
    assert (preempted.phase, preempted.code) == (Phase.PREEMPTED, Code.RESET)
    assert (preempted.id, preempted.shot, preempted.t_start) == ('a', 3, start_time)
    assert preempted.t_end is None and preempted.final_positions is None
