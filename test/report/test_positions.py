import csv
import io

import pytest

from pool_sim_ros.me212.log import published_final_positions
from pool_sim_ros.report.positions import format_positions

# The report's Table 1, inches.
STARTS = {
    'C': ('66.00', '22.00'),
    '1': ('40.08', '21.23'),
    '2': ('17.52', '37.29'),
    '3': ('12.53', '2.75'),
    '4': ('10.47', '25.10'),
    '5': ('27.32', '4.87'),
    '6': ('16.25', '13.80'),
    '7': ('7.60', '21.49'),
    '8': ('10.81', '9.21'),
    '9': ('26.19', '21.84'),
    '10': ('19.78', '26.81'),
}


def test_positions_have_start_and_end_of_each_ball_in_inches_and_metres(shots):
    rows = list(csv.DictReader(io.StringIO(format_positions(shots.values()))))
    assert len(rows) == 44
    published = published_final_positions()
    for row in rows:
        assert (row['start_x_in'], row['start_y_in']) == STARTS[row['ball']]
        end = float(row['end_x_in']), float(row['end_y_in'])
        assert end == published[int(row['shot'])][row['ball']]
        for name in ('start_x', 'start_y', 'end_x', 'end_y'):
            assert float(row[f'{name}_m']) / 0.0254 == pytest.approx(
                float(row[f'{name}_in']), abs=0.0051
            )
