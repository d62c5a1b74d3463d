"""Tracks from files: CSV that anybody may have written, and recordings beside it."""

import math

import numpy as np
import pytest
from tables import table_of

from pool_sim_ros.oracle import read_tracks

TABLE = table_of([(0.5, 0.5), (1.0, 0.5)])


def written(folder, text):
    path = folder / 'shot.csv'
    path.write_text(text)
    return path


def test_a_csv_file_is_read_in_the_order_of_its_times(tmp_path):
    path = written(tmp_path, 't,ball,x,y\n0.1,0,0.6,0.5\n0.0,1,1.0,0.5\n0.0,0,0.5,0.5\n')
    (track,) = read_tracks(TABLE, [path])
    np.testing.assert_array_equal(track.times, [0.0, 0.1])
    nan = math.nan
    np.testing.assert_array_equal(
        track.positions, [[[0.5, 0.5], [1.0, 0.5]], [[0.6, 0.5], [nan, nan]]]
    )


@pytest.mark.parametrize(
    ('text', 'message'),
    [
        ('', r'line 1 must be t,ball,x,y'),
        ('t,x,y\n', r'line 1 must be t,ball,x,y'),
        ('t,ball,x,y\n', r'there is no frame in it'),
        ('t,ball,x,y\n0.0,0,0.5\n', r'line 2: 3 fields must be 4'),
        ('t,ball,x,y\n0.0,0,0.5,0.5\n0.0,0,left,0.5\n', r'line 3: t, x and y must be numbers'),
        ('t,ball,x,y\n0.0,9,0.5,0.5\n', r"line 2: ball '9' is not on the table"),
        ('t,ball,x,y\nnan,0,0.5,0.5\n', r'times must be finite and rise'),
    ],
)
def test_what_is_no_such_file(tmp_path, text, message):
    with pytest.raises(ValueError, match=message):
        read_tracks(TABLE, [written(tmp_path, text)])


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(FileNotFoundError):
        read_tracks(TABLE, [tmp_path / 'none.csv'])


def test_a_name_that_ends_in_mcap_is_that_of_a_recording(tmp_path):
    pytest.importorskip('rosbags')
    path = tmp_path / 'shot.mcap'
    path.write_text('t,ball,x,y\n0.0,0,0.5,0.5\n')
    with pytest.raises(ValueError, match='shot.mcap: it is no recording of shots'):
        read_tracks(TABLE, [path])
