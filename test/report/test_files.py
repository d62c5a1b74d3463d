import errno
import os

import pytest

from pool_sim_ros.report.files import OutputError, whole_file, write_text


def test_a_file_appears_when_it_is_whole(tmp_path):
    path = tmp_path / 'a' / 'b' / 'file'
    with whole_file(path) as part:
        part.write_text('half')
        assert not path.exists()
        part.write_text('whole')
    assert path.read_text() == 'whole'
    assert list(path.parent.iterdir()) == [path]


@pytest.mark.parametrize('error', [ValueError, KeyboardInterrupt])
def test_what_goes_wrong_leaves_the_old_file_and_nothing_else(tmp_path, error):
    path = tmp_path / 'file'
    path.write_text('old')
    with pytest.raises(error), whole_file(path) as part:
        part.write_text('half')
        raise error
    assert path.read_text() == 'old'
    assert list(tmp_path.iterdir()) == [path]


def test_a_full_disk_is_told_in_one_line(tmp_path):
    path = tmp_path / 'file'
    reason = os.strerror(errno.ENOSPC)
    with pytest.raises(OutputError) as caught, whole_file(path) as part:
        part.write_text('half')
        raise OSError(errno.ENOSPC, reason)
    assert str(caught.value) == f'cannot write {path}: {reason}'
    assert list(tmp_path.iterdir()) == []


def test_a_file_in_the_place_of_a_folder_is_told(tmp_path):
    (tmp_path / 'out').write_text('I am a file')
    with pytest.raises(OutputError, match='out is not a folder'):
        write_text(tmp_path / 'out' / 'output.log', 'text')
    with pytest.raises(OutputError, match='Not a directory'):
        write_text(tmp_path / 'out' / 'deeper' / 'output.log', 'text')
    assert (tmp_path / 'out').read_text() == 'I am a file'


def test_a_folder_in_the_place_of_a_file_is_told(tmp_path):
    (tmp_path / 'output.log').mkdir()
    with pytest.raises(OutputError, match='Is a directory'):
        write_text(tmp_path / 'output.log', 'text')
    assert [path.name for path in tmp_path.iterdir()] == ['output.log']


def test_a_text_with_half_a_surrogate_pair_is_written_with_an_escape(tmp_path):
    write_text(tmp_path / 'log', 'ball \N{GRINNING FACE} \ud800\n')
    assert (tmp_path / 'log').read_text('utf-8') == 'ball \N{GRINNING FACE} \\ud800\n'
