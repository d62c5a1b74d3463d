"""The ways of installing the package, each into a folder of its own and without the network."""

import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

BARE_ENV = {'PATH': '/usr/bin:/bin', 'LANG': 'C.UTF-8'}


@dataclass(frozen=True)
class Installation:
    """An installed package and how a user's shell starts a command from it.

    `python` is the interpreter that its commands use. `shell` goes before a command: it sources
    what the installer says must be sourced. `env` is the whole environment.
    """

    prefix: Path
    python: Path
    shell: list[str]
    env: dict[str, str]


def run(command, **options) -> str:
    """Run a command to its end and return its standard output; fail with all that it printed."""
    command = [str(part) for part in command]
    done = subprocess.run(
        command, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=300, **options
    )
    output = done.stdout + done.stderr
    assert done.returncode == 0, f'{command} ended with status {done.returncode}\n{output}'
    return done.stdout


def copy_project(project: Path, target: Path) -> Path:
    """Copy what a build reads."""
    target.mkdir()
    for name in ('package.xml', 'setup.py', 'setup.cfg', 'pyproject.toml', 'LICENSE', 'README.md'):
        if (project / name).exists():
            shutil.copy(project / name, target)
    for name in ('pool_sim_ros', 'resource', 'config', 'launch'):
        if (project / name).exists():
            ignored = shutil.ignore_patterns('__pycache__')
            shutil.copytree(project / name, target / name, ignore=ignored)
    return target


def pip(source: Path, folder: Path) -> Installation:
    """`pip install .` in a virtual environment."""
    return _pip_install([source], folder)


def pip_editable(source: Path, folder: Path) -> Installation:
    """`pip install --editable .` in a virtual environment."""
    return _pip_install(['--editable', source], folder)


def colcon(source: Path, folder: Path) -> Installation:
    """`colcon build`."""
    return _colcon_build([], source, folder)


def colcon_symlink(source: Path, folder: Path) -> Installation:
    """`colcon build --symlink-install`."""
    return _colcon_build(['--symlink-install'], source, folder)


INSTALLERS = [pip, pip_editable, colcon, colcon_symlink]


def _pip_install(what, folder):
    prefix = folder / 'venv'
    run([sys.executable, '-m', 'venv', '--without-pip', prefix])
    python = prefix / 'bin' / 'python'
    _borrow_packages(prefix)
    run(
        [sys.executable, '-m', 'pip', '--python', python, 'install']
        + ['--no-deps', '--no-index', '--no-build-isolation', '--ignore-installed', *what]
    )
    # The ROS wheels find their libraries by these; borrowed wheels lie in the other environment.
    wheels = {'LD_LIBRARY_PATH', '_ROS_WHEELS_BOOTSTRAP_COMPLETE'}
    borrowed = {name: value for name, value in os.environ.items() if name in wheels}
    return Installation(prefix, python, [], BARE_ENV | {'HOME': str(folder)} | borrowed)


def _borrow_packages(prefix):
    """Let a new virtual environment see the packages of this one, after its own."""
    folders = [path for path in sys.path if path.endswith(('site-packages', 'dist-packages'))]
    (packages,) = prefix.glob('lib/python*/site-packages')
    lines = ''.join(f'import site; site.addsitedir({folder!r})\n' for folder in folders)
    (packages / 'borrowed.pth').write_text(lines)


def _colcon_build(options, source, folder):
    run(
        [sys.executable, '-m', 'colcon', '--log-base', folder / 'log', 'build']
        + ['--base-paths', source, '--build-base', folder / 'build']
        + ['--install-base', folder / 'install', *options],
        cwd=folder,
    )
    setup = folder / 'install' / 'setup.sh'
    shell = ['sh', '-c', f'. "{setup}" && exec "$@"', 'sh']
    prefix = folder / 'install' / 'pool_sim_ros'
    return Installation(prefix, Path(sys.executable), shell, BARE_ENV | {'HOME': str(folder)})
