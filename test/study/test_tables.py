"""Tables by name."""

import pytest

from pool_sim_ros.physics import pool_table, report_table
from pool_sim_ros.study.tables import NAMES, table_of


def test_each_name_has_its_table():
    assert table_of('report') == report_table() and table_of('7ft') == pool_table('7ft')
    assert all(table_of(name).balls for name in NAMES)
    assert table_of(report_table()) == report_table()


@pytest.mark.parametrize('name', ['', 'REPORT', None, 3, '6ft'])
def test_another_name_is_told(name):
    with pytest.raises(ValueError, match="^table: .* 'report', '7ft'"):
        table_of(name)
