import os
from pathlib import Path

import pytest

from pool_sim_ros.report.table_file import TableFileError, read_settings

CONFIG = Path(__file__).parents[2] / 'config'
HEAD = '/**:\n  ros__parameters:\n'


def write(tmp_path, text):
    path = tmp_path / 'table.yaml'
    path.write_text(text)
    return path


@pytest.mark.parametrize(('before', 'end'), [('\ufeff', '\n'), ('', '\r\n')])
def test_marks_and_line_ends_of_other_systems_do_no_harm(settings, tmp_path, before, end):
    text = (CONFIG / 'report.yaml').read_text()
    path = tmp_path / 'table.yaml'
    path.write_bytes((before + text.replace('\n', end)).encode())
    assert read_settings(path) == settings


def test_the_report_s_own_file_is_the_report_s_run(settings):
    assert read_settings(CONFIG / 'report.yaml') == settings


def test_what_is_not_in_the_file_is_the_report_s(settings, tmp_path):
    read = read_settings(write(tmp_path, HEAD + '    table: {length: 3}\n    time_slice: 1e-5\n'))
    assert (read.table.length, read.table.width) == (3.0, 1.1176)
    assert read.time_slice == 1e-5
    assert read.report_integrator == settings.report_integrator


@pytest.mark.parametrize('number', ['1e-6', '1.0e-06', '0.000001', '1E-6', '.1e-5'])
def test_numbers_may_be_written_as_ros_reads_them(tmp_path, number):
    assert read_settings(write(tmp_path, f'{HEAD}    time_slice: {number}\n')).time_slice == 1e-6


@pytest.mark.parametrize(
    ('text', 'words'),
    [
        (HEAD + '    table: {lenght: 1.0}\n', 'table.lenght .* table.length'),
        (HEAD + '    table: {length: [1.0}\n', 'line 3'),
        (HEAD + '    table: {length: wide}\n', 'table.length'),
        (HEAD + "    balls: {labels: ['C']}\n", 'balls.masses is missing'),
        ('/pool:\n  ros__parameters: {}\n', 'under /\\*\\*: and ros__parameters:'),
        ('/**:\n  ros__parameters:\n', 'under /\\*\\*: and ros__parameters:'),
        ('- a list\n', 'under /\\*\\*: and ros__parameters:'),
        ('', 'under /\\*\\*: and ros__parameters:'),
        ('\x00', 'special characters'),
        ('!!python/object:os.system {}\n', 'could not determine a constructor'),
        (HEAD + '    table: &t {length: 1.0}\n    balls: *t\n', 'aliases are not allowed, line 4'),
        (HEAD + '    table: &t {length: *t}\n', 'aliases are not allowed, line 3'),
        (HEAD + '    time_slice: ' + '9' * 400, 'time_slice must be a number from 1e-07 to 0.01'),
        (HEAD + '    time_slice: ' + '9' * 5000, 'cannot read'),
        (
            HEAD + '    time_slice: true\n',
            'time_slice must be a number from 1e-07 to 0.01, not True',
        ),
        (HEAD + '    table: {length: ' + '[' * 5000, 'nested too deeply|nesting depth'),
        (HEAD + '    step_ticks: 1\n    step_ticks: 2\n', "'step_ticks' is given twice"),
    ],
    ids=lambda value: repr(value)[-20:],
)
def test_a_bad_file_is_refused_in_one_line_that_names_it(tmp_path, text, words):
    path = write(tmp_path, text)
    with pytest.raises(TableFileError, match=words) as caught:
        read_settings(path)
    assert str(path) in str(caught.value)
    assert '\n' not in str(caught.value)


def test_overlapping_balls_are_named(tmp_path):
    text = (CONFIG / 'report.yaml').read_text().replace('0.44500799999999996', '1.0')
    text = text.replace('0.947166', '0.539242')
    with pytest.raises(TableFileError, match='overlap'):
        read_settings(write(tmp_path, text))


def test_a_misspelt_name_is_told_and_one_of_another_node_is_not(settings, tmp_path, capsys):
    text = HEAD + '    real_time_facter: 2.0\n    table: {frame: map}\n'
    assert read_settings(write(tmp_path, text)) == settings
    told = capsys.readouterr().err
    assert 'real_time_facter is not a parameter; did you mean real_time_factor?' in told
    assert told.count('\n') == 1


def test_files_that_cannot_be_read_are_told(tmp_path):
    with pytest.raises(TableFileError, match='No such file'):
        read_settings(tmp_path / 'none.yaml')
    with pytest.raises(TableFileError, match='directory'):
        read_settings(tmp_path)
    os.mkfifo(tmp_path / 'pipe')
    with pytest.raises(TableFileError, match='not a regular file'):
        read_settings(tmp_path / 'pipe')
    large = tmp_path / 'large.yaml'
    with large.open('wb') as file:
        file.truncate(10**9)
    with pytest.raises(TableFileError, match='1000000000 bytes'):
        read_settings(large)
    latin = tmp_path / 'latin.yaml'
    latin.write_bytes(b'\xff\xfe\xfa')
    with pytest.raises(TableFileError, match='UTF-8'):
        read_settings(latin)
