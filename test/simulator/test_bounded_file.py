"""Files from anybody: what is no file, too large or no text is refused at once."""

import os
from pathlib import Path

import pytest

from pool_sim_ros.simulator.bounded_file import FileError, open_bounded, read_lines, read_text


def test_a_text_is_read_with_or_without_a_mark_at_its_start(tmp_path):
    file = tmp_path / 'a.txt'
    for mark in (b'', b'\xef\xbb\xbf'):
        file.write_bytes(mark + 'é\nb'.encode())
        assert read_text(file, 100) == 'é\nb'
        with open_bounded(file, 100) as opened:
            assert list(read_lines(opened, 10)) == [('é\n', True), ('b', False)]


def test_as_many_bytes_as_are_allowed_are_read_and_no_more(tmp_path):
    file = tmp_path / 'a.txt'
    file.write_bytes(b'12345\n')
    assert read_text(file, 6) == '12345\n'
    with pytest.raises(FileError, match='it has 6 bytes; at most 5'):
        read_text(file, 5)
    with open_bounded(file, 6) as opened:
        assert list(read_lines(opened, 5)) == [('12345\n', True)]
    with open_bounded(file, 6) as opened, pytest.raises(ValueError, match='more than 4 bytes'):
        list(read_lines(opened, 4))


def test_a_large_file_of_one_line_takes_no_memory(tmp_path):
    file = tmp_path / 'holes'
    with file.open('wb') as opened:
        opened.truncate(10**9)
    with open_bounded(file, 10**9) as opened, pytest.raises(ValueError, match='more than 10 bytes'):
        list(read_lines(opened, 10))


def test_what_is_no_text_is_refused(tmp_path):
    file = tmp_path / 'a.txt'
    file.write_bytes(b'a\n\xff\xfe')
    with pytest.raises(FileError, match='UTF-8'):
        read_text(file, 100)
    with open_bounded(file, 100) as opened, pytest.raises(ValueError, match='UTF-8'):
        list(read_lines(opened, 100))


def pipe(folder):
    os.mkfifo(folder / 'pipe')
    return folder / 'pipe'


@pytest.mark.parametrize(
    ('make', 'words'),
    [
        (lambda folder: folder, 'Is a directory'),
        (lambda folder: folder / 'none', 'No such file'),
        (lambda folder: folder / 'nul\0', 'null'),
        (pipe, 'not a regular file'),
        (lambda folder: Path('/dev/zero'), 'not a regular file'),
    ],
)
def test_what_is_no_file_is_refused_without_waiting(tmp_path, make, words):
    with pytest.raises(FileError, match=words):
        open_bounded(make(tmp_path), 100)
