import inspect

import pytest
from fakes import Recorder

from pool_sim_ros.simulator.output import Output

METHODS = [name for name in vars(Output) if not name.startswith('_')]


@pytest.mark.parametrize('name', METHODS)
def test_what_the_tests_send_to_has_every_method_with_the_same_parameters(name):
    wanted = inspect.signature(getattr(Output, name)).parameters
    assert len(inspect.signature(getattr(Recorder, name)).parameters) == len(wanted)


def test_there_is_nothing_else_to_send_to():
    sent = {name for name in vars(Recorder) if not name.startswith('_')}
    assert sent - set(METHODS) == {'all'}
