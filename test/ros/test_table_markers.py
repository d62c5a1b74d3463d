"""The table as markers: pockets, noses and cushions where they are."""

import math

import numpy as np
import pytest
from visualization_msgs.msg import Marker

from pool_sim_ros.physics import POOL_TABLES, pool_table
from pool_sim_ros.ros.table_markers import table_markers


@pytest.mark.parametrize('name', POOL_TABLES)
def test_pockets_noses_and_cushions_are_where_they_are(name):
    table = pool_table(name)
    found = {(m.ns, m.id): m for m in table_markers(table, 'felt')}
    assert all(m.header.frame_id == 'felt' and m.action == Marker.ADD for m in found.values())
    for k, (x, y, radius) in enumerate(table.pockets):
        pocket = found['pockets', k]
        assert pocket.type == Marker.CYLINDER and pocket.scale.x == pocket.scale.y == 2 * radius
        assert (pocket.pose.position.x, pocket.pose.position.y) == (x, y)
    segments = [] if table.cushions is None else table.cushions.segments
    assert sum(ns == 'rails' for ns, _ in found) == len(segments)
    assert sum(ns == 'pockets' for ns, _ in found) == len(table.pockets)
    for k, (x0, y0, x1, y1, nx, ny) in enumerate(segments):
        rail = found['rails', k]
        angle = 2.0 * math.atan2(rail.pose.orientation.z, rail.pose.orientation.w)
        along = np.array([math.cos(angle), math.sin(angle)]) * rail.scale.x / 2
        face = np.array([rail.pose.position.x, rail.pose.position.y])
        face += np.array([nx, ny]) * rail.scale.y / 2  # the side that balls touch
        np.testing.assert_allclose([face - along, face + along], [[x0, y0], [x1, y1]], atol=1e-9)
