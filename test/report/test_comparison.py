import numpy as np
import pytest

from pool_sim_ros.me212 import published_final_positions
from pool_sim_ros.physics import INCH
from pool_sim_ros.report.comparison import SLICES, compare, final_inches, greatest_difference


def test_greatest_difference_is_by_coordinate_and_names_the_ball():
    one = np.array([[0.0, 0.0], [1.0, 1.0], [5.0, 5.0]])
    other = np.array([[0.1, 0.1], [1.0, 1.5], [5.3, 4.7]])
    assert greatest_difference(one, other) == (0.5, 1)


def test_the_shortest_slice_gives_the_print(settings, comparisons):
    for comparison in comparisons:
        printed = published_final_positions()[comparison.number]
        assert [tuple(end) for end in comparison.printed] == list(printed.values())
        assert list(comparison.sliced) == list(SLICES)
        ends = final_inches(comparison.sliced[1e-6])
        assert np.round(ends, 2) == pytest.approx(comparison.printed, abs=1e-9)


def test_each_method_changes_one_thing(settings, comparisons):
    for comparison in comparisons:
        assert comparison.with_e_cn.table.e_cue_ball == 0.95
        assert comparison.with_e_cn.table.ball_friction == 'report'
        assert comparison.with_coulomb.table.e_cue_ball == 0.7
        assert comparison.with_coulomb.table.ball_friction == 'coulomb'
        assert comparison.exact.table == settings.table


def test_final_positions_are_in_inches(comparisons):
    trajectory = comparisons[0].exact
    assert final_inches(trajectory) * INCH == pytest.approx(trajectory.final_positions, rel=1e-15)


def test_a_print_that_lacks_a_ball_is_an_error(settings):
    with pytest.raises(KeyError):
        compare(settings.table, 3, {'C': (1.0, 1.0)})
