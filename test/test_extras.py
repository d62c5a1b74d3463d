"""What is said where an extra is not installed."""

import pytest

from pool_sim_ros.extras import needs


def test_the_line_names_the_package_and_the_extra():
    with pytest.raises(ModuleNotFoundError) as caught, needs('shot.plot()', 'plot'):
        import no_such_package.part  # noqa: F401
    assert str(caught.value) == (
        'shot.plot() needs no_such_package, not installed here: pip install no_such_package '
        '(the extra plot has all that it needs)'
    )
    assert caught.value.name == 'no_such_package' and caught.value.__cause__ is None


def test_a_module_of_ours_that_is_missing_is_a_fault_of_ours():
    with pytest.raises(ModuleNotFoundError, match='pool_sim_ros.nothing'), needs('x', 'y'):
        import pool_sim_ros.nothing  # noqa: F401


def test_other_errors_pass():
    with pytest.raises(ZeroDivisionError), needs('x', 'y'):
        1 / 0  # noqa: B018
