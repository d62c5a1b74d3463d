from importlib import import_module

import pytest

from pool_sim_ros.report.errors import ReportError


@pytest.mark.parametrize(
    'name',
    ['encoder.EncoderError', 'files.OutputError', 'played.ShotError', 'table_file.TableFileError'],
)
def test_what_the_command_reports_in_one_line_is_a_report_error(name):
    module, error = name.split('.')
    assert issubclass(getattr(import_module(f'pool_sim_ros.report.{module}'), error), ReportError)


def test_a_mistake_of_the_program_is_none():
    assert not issubclass(ReportError, ValueError | OSError)
