"""Standard output that is closed, full, or unable to show a character."""

import os
import subprocess
import sys

import pytest

from pool_sim_ros.console.output import NOBODY_READS

PRINT = """\
import sys
from pool_sim_ros.console import ProgressLine, console_command

@console_command('play_it')
def main(args):
    ProgressLine(sys.stdout).show('rolls')
    for line in args:
        print(line, flush='flush' in sys.argv)

if __name__ == '__main__':
    sys.exit(main(['a ball'] * 20000 if 'long' in sys.argv else ['ball \\u2460 \\ud800']))
"""


def run(shell, *words, **env):
    """Run a command with its output as a shell leads it; return status and standard error."""
    command = ['sh', '-c', f'"$@" {shell}', 'sh', sys.executable, '-c', PRINT, *words]
    done = subprocess.run(command, capture_output=True, timeout=60, check=False, env=env or None)
    return done.returncode, done.stdout, done.stderr.decode()


@pytest.mark.parametrize('unbuffered', ['', '1'])
@pytest.mark.parametrize('words', [[], ['flush'], ['long'], ['long', 'flush']], ids=str)
def test_a_reader_that_has_gone_ends_it_without_a_word(words, unbuffered):
    with subprocess.Popen(['true'], stdin=subprocess.PIPE) as reader:
        reader.wait()
        done = subprocess.run(
            [sys.executable, '-c', PRINT, *words],
            stdout=reader.stdin,
            stderr=subprocess.PIPE,
            timeout=60,
            check=False,
            env=os.environ | {'PYTHONUNBUFFERED': unbuffered},
        )
    assert (done.returncode, done.stderr) == (NOBODY_READS, b'')


@pytest.mark.parametrize('words', [[], ['flush'], ['long']], ids=str)
def test_a_full_disk_is_one_line_and_status_1(words):
    status, _, err = run('>/dev/full', *words, **os.environ)
    assert status == 1
    assert err == 'play_it: the output cannot be written: No space left on device\n'


def test_an_output_that_is_closed_is_no_trouble():
    assert run('>&-') == (0, b'', '')
    assert run('>&- 2>&-') == (0, b'', '')


@pytest.mark.parametrize(
    'env', [{'LC_ALL': 'C', 'PYTHONUTF8': '0'}, {'PYTHONIOENCODING': 'ascii'}, {'LC_ALL': 'C'}]
)
def test_a_character_that_the_locale_has_not_is_shown_as_an_escape(env):
    status, out, err = run('', **{'PYTHONPATH': ':'.join(filter(None, sys.path)), **env})
    assert (status, err) == (0, '')
    assert out in (b'ball \\u2460 \\ud800\n', 'ball \u2460 \\ud800\n'.encode())


def test_an_error_elsewhere_is_not_taken_for_the_output():
    code = (
        'from pool_sim_ros.console import console_command\n'
        'def run(args): raise BrokenPipeError(32, "some other pipe")\n'
        'console_command("play_it")(run)([])'
    )
    done = subprocess.run([sys.executable, '-c', code], capture_output=True, timeout=60, text=True)
    assert done.returncode == 1 and 'some other pipe' in done.stderr
