"""A table for pool, snooker or carom, racked and ready to break."""

from __future__ import annotations

import dataclasses

from pool_sim_ros.physics.balls import Ball
from pool_sim_ros.physics.pool_tables import PoolTableName, pool_table_dimensions
from pool_sim_ros.physics.racks import rack
from pool_sim_ros.physics.table import Table


def pool_table(name: PoolTableName) -> Table:
    """Return a table on which balls slide, roll and spin, with its balls racked.

    Parameters
    ----------
    name : {'7ft', '8ft', '9ft', 'snooker', 'carom'}
        A pool table is racked for eight ball. `pool_tables` has the dimensions and coefficients of
        each, and where they come from.

    Returns
    -------
    Table
        The cue ball is 'C', the first. `dataclasses.replace` and `rack` give it other balls.

    Raises
    ------
    ValueError
        For another name.
    """
    given = pool_table_dimensions(name)
    alone = Ball(
        'C', given.ball_mass, given.ball_radius, (given.length / 2, given.width / 2), is_cue=True
    )
    table = Table(balls=(alone,), **given.fields())
    return dataclasses.replace(table, balls=rack(table, given.rack))
