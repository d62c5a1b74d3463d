"""The line on a terminal that is written over and over."""

import io

from pool_sim_ros.console import ProgressLine, progress

ERASE = '\r\x1b[K'


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_a_file_is_left_alone():
    stream = io.StringIO()
    line = ProgressLine(stream)
    line.show('1 ball moves')
    line.clear()
    assert not line.wanted and stream.getvalue() == ''


def test_each_version_takes_the_place_of_the_one_before(monkeypatch):
    monkeypatch.setattr(progress, 'PERIOD', 0.0)
    stream = Terminal()
    line = ProgressLine(stream)
    line.show('1 ball moves')
    line.show('2 balls move')
    line.clear()
    assert line.wanted
    assert stream.getvalue() == f'{ERASE}1 ball moves{ERASE}2 balls move{ERASE}'


def test_it_is_not_written_more_often_than_one_can_read(monkeypatch):
    now = 100.0
    monkeypatch.setattr(progress.time, 'monotonic', lambda: now)
    stream = Terminal()
    line = ProgressLine(stream)
    for step in range(10):
        now = 100.0 + step * progress.PERIOD / 4
        line.show(str(step))
    assert stream.getvalue() == f'{ERASE}0{ERASE}4{ERASE}8'


def test_after_it_was_removed_the_next_version_comes_at_once():
    stream = Terminal()
    line = ProgressLine(stream)
    line.show('a')
    line.clear()
    line.show('b')
    assert stream.getvalue() == f'{ERASE}a{ERASE}{ERASE}b'


def test_an_output_that_is_closed_is_left_alone():
    line = ProgressLine(None)
    line.show('1 ball moves')
    line.clear()
    assert not line.wanted
