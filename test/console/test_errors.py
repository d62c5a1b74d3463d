"""The error of a command."""

import pytest

from pool_sim_ros.console import CommandError, console_command


def test_its_message_is_all_that_the_user_is_told(capsys):
    @console_command('play_it')
    def main(args):
        raise CommandError('the table is round')

    assert main([]) == 1
    assert capsys.readouterr().err == 'play_it: the table is round\n'


def test_it_is_an_exception_like_any_other():
    with pytest.raises(Exception, match='round'):
        raise CommandError('the table is round')
