"""`pool_table`: each name is a whole table, racked, on which a shot can be played."""

import numpy as np
import pytest
from billiards import seven_foot
from tables import worst_overlap

from pool_sim_ros.physics import POOL_TABLES, cue_strike, pool_table, rack, simulate
from pool_sim_ros.physics.pool_tables import pool_table_dimensions

COUNTS = {'7ft': 16, '8ft': 16, '9ft': 16, 'snooker': 22, 'carom': 3}


@pytest.mark.parametrize('name', POOL_TABLES)
def test_it_has_the_dimensions_and_the_rack_of_its_name(name):
    table, given = pool_table(name), pool_table_dimensions(name)
    for field, value in given.fields().items():
        np.testing.assert_array_equal(getattr(table, field), value, err_msg=field)
    assert table.balls == rack(table, given.rack) and len(table.balls) == COUNTS[name]
    assert table.labels[0] == 'C' and table.is_cue.tolist() == [True] + [False] * (COUNTS[name] - 1)
    assert worst_overlap(table, table.positions[np.newaxis]) <= 0.0
    assert table.motion == 'ball' and table.comes_to_rest


@pytest.mark.parametrize('name', POOL_TABLES)
def test_a_break_is_played(name):
    table = pool_table(name)
    velocity, spin = cue_strike(table, speed=6.0, azimuth=179.0, side=0.1, above=0.2)
    shot = simulate(table, velocity, spins=spin)
    assert shot.complete and len(shot.events) > 2
    assert len(shot.pocketed) == COUNTS[name]
    assert np.isfinite(shot.final_positions).all()


def test_the_seven_foot_table_has_the_rows_of_the_data_in_order():
    table, data = pool_table('7ft'), seven_foot()
    assert (table.length, table.width) == (data['length'], data['width'])
    np.testing.assert_allclose(table.cushions.segments, data['segments'], rtol=0, atol=1e-12)
    np.testing.assert_allclose(table.cushions.noses, data['noses'], rtol=0, atol=1e-12)
    np.testing.assert_allclose(table.pockets, data['pockets'], rtol=0, atol=1e-12)


@pytest.mark.parametrize('name', ['10ft', '', None, 7, ['7ft']])
def test_another_name_is_refused(name):
    with pytest.raises(ValueError, match='^name: .* is no table; there are .*7ft') as caught:
        pool_table(name)
    assert repr(name) in str(caught.value)
