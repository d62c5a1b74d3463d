"""Tables by name."""

from __future__ import annotations

from pool_sim_ros.physics import POOL_TABLES, PoolTableName, Table, pool_table, report_table

TableGiven = Table | PoolTableName | str

NAMES = ('report', *POOL_TABLES)


def table_of(given: TableGiven) -> Table:
    """Return a table, or that of a name; raise ValueError for another name."""
    if isinstance(given, Table):
        return given
    if given == 'report':
        return report_table()
    for name in POOL_TABLES:
        if given == name:
            return pool_table(name)
    known = ', '.join(repr(each) for each in NAMES)
    raise ValueError(f'table: {given!r} must be a Table or one of {known}')
