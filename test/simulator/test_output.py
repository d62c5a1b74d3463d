import inspect

import pytest
from fakes import Recorder

from pool_sim_ros.ros import Publishers
from pool_sim_ros.simulator.output import Output

METHODS = [name for name in vars(Output) if not name.startswith('_')]


@pytest.mark.parametrize('name', METHODS)
@pytest.mark.parametrize('implementation', [Publishers, Recorder])
def test_whoever_sends_has_every_method_with_as_many_parameters(implementation, name):
    wanted = inspect.signature(getattr(Output, name)).parameters
    assert len(inspect.signature(getattr(implementation, name)).parameters) == len(wanted)
