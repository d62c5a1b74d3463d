"""The names of the laws of contact."""

import pytest

from pool_sim_ros.physics.law_names import CUSHION_MODELS, FRICTION_BOUNDS, number_of


def test_numbers_are_places_in_the_list():
    for names in (CUSHION_MODELS, FRICTION_BOUNDS):
        assert [number_of('law', name, names) for name in names] == list(range(len(names)))


@pytest.mark.parametrize('value', ['Han', '', None, 1, ['han'], ('han', 'impulse')])
def test_another_name_is_refused_with_all_that_would_do(value):
    with pytest.raises(ValueError) as caught:
        number_of('cushion_model', value, CUSHION_MODELS)
    message = str(caught.value)
    assert message.startswith('cushion_model: ') and repr(value) in message
    assert all(repr(name) in message for name in CUSHION_MODELS)
