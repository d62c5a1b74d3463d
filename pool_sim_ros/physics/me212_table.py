"""The table of the report, *ME 212 Billiards Project Report*."""

from __future__ import annotations

from pool_sim_ros.physics.balls import Ball
from pool_sim_ros.physics.table import Table
from pool_sim_ros.physics.units import INCH


def report_table() -> Table:
    """Return the report's table: its Table 1 and the constants of Listings 2 and 3."""
    rows = (
        ('C', 200, (66.00, 22.00), (255, 255, 255)),
        ('1', 160, (40.08, 21.23), (255, 255, 0)),
        ('2', 160, (17.52, 37.29), (0, 0, 255)),
        ('3', 160, (12.53, 2.75), (255, 0, 0)),
        ('4', 160, (10.47, 25.10), (144, 0, 255)),
        ('5', 160, (27.32, 4.87), (255, 144, 0)),
        ('6', 160, (16.25, 13.80), (0, 255, 0)),
        ('7', 160, (7.60, 21.49), (163, 166, 27)),
        ('8', 160, (10.81, 9.21), (0, 0, 0)),
        ('9', 160, (26.19, 21.84), (138, 92, 51)),
        ('10', 160, (19.78, 26.81), (0, 0, 144)),
    )
    balls = tuple(
        Ball(
            label=label,
            mass=grams / 1000,
            radius=2.25 * INCH,
            position=(x * INCH, y * INCH),
            color=(rgb[0] / 255, rgb[1] / 255, rgb[2] / 255),
            is_cue=label == 'C',
        )
        for label, grams, (x, y), rgb in rows
    )
    return Table(length=88 * INCH, width=44 * INCH, balls=balls)
