"""The outline of a table with six pockets: symmetric, closed where it should be, and smooth."""

import math

import numpy as np
import pytest

from pool_sim_ros.physics.pocket_geometry import Mouth, pocket_table

CORNER = Mouth(width=0.12, slope=50.0, depth=0.04, hole=0.06, nose=0.02)
SIDE = Mouth(width=0.14, slope=10.0, depth=0.07, hole=0.065, nose=0.01)
LENGTH, WIDTH, REACH = 2.0, 1.0, 0.05


def outline(corner=CORNER, side=SIDE, reach=REACH):
    return pocket_table(LENGTH, WIDTH, corner, side, reach)


def mirrored(rows, axis):
    """Rows of points (x, y, ...) at the middle of the table; segments have two points, a normal."""
    size = (LENGTH, WIDTH)[axis]
    image = rows.copy()
    image[:, axis] = size - rows[:, axis]
    if rows.shape[1] == 6:
        image[:, 2 + axis] = size - rows[:, 2 + axis]
        image[:, 4 + axis] = -rows[:, 4 + axis]
    return image


def same_set(rows, others):
    """Whether both have the same rows in any order; a segment may change its ends."""
    for row in others:
        turned = row[[2, 3, 0, 1, 4, 5]] if len(row) == 6 else row
        distances = [np.abs(rows - way).max(axis=1).min() for way in (row, turned)]
        if min(distances) > 1e-14:
            return False
    return len(rows) == len(others)


@pytest.mark.parametrize('axis', [0, 1])
def test_the_outline_is_its_own_mirror_image(axis):
    cushions, pockets = outline()
    for rows in (cushions.segments, cushions.noses, pockets):
        assert same_set(rows, mirrored(rows, axis))


def test_how_many_of_each():
    cushions, pockets = outline()
    assert cushions.segments.shape == (18, 6)
    assert cushions.noses.shape == (12, 3) and pockets.shape == (6, 3)


def test_normals_point_to_the_side_where_balls_are():
    segments = outline()[0].segments
    middle = np.array([LENGTH / 2, WIDTH / 2])
    for x0, y0, _, _, nx, ny in segments[:6]:
        assert np.dot(middle - (x0, y0), (nx, ny)) > 0.0
    # Jaws: into the mouth, where the pocket is.
    pockets = outline()[1]
    for x0, y0, x1, y1, nx, ny in segments[6:]:
        centre = np.array([x0 + x1, y0 + y1]) / 2
        nearest = pockets[np.hypot(*(pockets[:, :2] - centre).T).argmin(), :2]
        assert np.dot(nearest - centre, (nx, ny)) > 0.0


def test_noses_touch_a_rail_and_a_jaw_smoothly():
    """A nose's circle is tangent to both where they end."""
    cushions, _ = outline()
    for x, y, radius in cushions.noses:
        touches = 0
        for x0, y0, x1, y1, nx, ny in cushions.segments:
            for end in ((x0, y0), (x1, y1)):
                arm = np.subtract(end, (x, y))
                if math.hypot(*arm) < radius + 1e-9:
                    assert arm == pytest.approx(radius * np.array([nx, ny]), abs=1e-14)
                    touches += 1
        assert touches == 2


def test_measures_of_the_mouths():
    cushions, pockets = outline()
    rails = cushions.segments[:6]
    # Lips are where rail and jaw would meet without the nose.
    lip = rails[0, 0] - CORNER.rounding
    assert lip * math.sqrt(2) == pytest.approx(CORNER.width)
    assert rails[1, 0] - rails[0, 2] - 2 * SIDE.rounding == pytest.approx(SIDE.width)
    assert pockets[0] == pytest.approx((-0.04 / math.sqrt(2), -0.04 / math.sqrt(2), 0.06))
    assert pockets[1] == pytest.approx((1.0, -0.07, 0.065))
    # Jaws end as far out as the cushions are wide, and turn by the angle.
    jaws = cushions.segments[6:]
    outer = np.maximum(
        np.maximum(-jaws[:, 0], jaws[:, 0] - LENGTH), np.maximum(-jaws[:, 1], jaws[:, 1] - WIDTH)
    )
    np.testing.assert_allclose(outer, REACH, atol=1e-15)
    way = jaws[0, :2] - jaws[0, 2:4]
    assert math.degrees(math.atan2(-way[1], -way[0])) == pytest.approx(90.0 - SIDE.slope)


def test_a_point_for_a_nose():
    cushions, _ = outline(CORNER._replace(nose=0.0), SIDE._replace(nose=0.0))
    ends = cushions.segments.reshape(-1, 6)[:, :4].reshape(-1, 2)
    for x, y, radius in cushions.noses:
        assert radius == 0.0
        assert (np.hypot(*(ends - (x, y)).T) < 1e-15).sum() == 2


def test_no_jaw_where_the_nose_is_deeper_than_the_cushion():
    cushions, _ = outline(side=SIDE._replace(slope=0.0, nose=0.06))
    assert cushions.segments.shape == (14, 6) and cushions.noses.shape == (12, 3)
