"""Packages that are not installed: what to tell the user."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import find_spec

from pool_sim_ros.console.errors import CommandError

PACKAGE = 'pool_sim_ros'
"""This package: what is missing in it is a fault of ours."""

ROS_MODULES = frozenset(
    {
        'action_msgs',
        'ament_index_python',
        'builtin_interfaces',
        'diagnostic_msgs',
        'geometry_msgs',
        'rcl_interfaces',
        'rclpy',
        'rosgraph_msgs',
        'rpyutils',
        'std_msgs',
        'std_srvs',
        'visualization_msgs',
    }
)
"""What comes with ROS 2, not from PyPI under its own name."""

_ON_PYPI = {'imageio_ffmpeg': 'imageio-ffmpeg', 'yaml': 'pyyaml'}
"""Module -> its name on PyPI, where that is another."""

_ON_UBUNTU = {
    'aiohttp': 'python3-aiohttp',
    'matplotlib': 'python3-matplotlib',
    'numba': 'python3-numba',
    'numpy': 'python3-numpy',
    'tqdm': 'python3-tqdm',
    'yaml': 'python3-yaml',
}
"""Module -> its Ubuntu package, where there is one."""


def missing_line(modules: Sequence[str]) -> str:
    """Return one line that names what is missing, and says how to install it.

    Parameters
    ----------
    modules : sequence of str
        Names as Python imports them.
    """
    names = ', '.join(_ON_PYPI.get(module, module) for module in modules)
    return f'needs {names}, not installed here: {_remedy(modules)}'


def import_line(error: ImportError) -> str:
    """Return one line that tells of a package which is missing, or which cannot be loaded."""
    module = (error.name or '').partition('.')[0]
    if isinstance(error, ModuleNotFoundError):
        return missing_line([module])
    return f'{module or "a package"} cannot be loaded: {" ".join(str(error).split())}'


def require(*modules: str) -> None:
    """Return if these modules can be found.

    Raises
    ------
    CommandError
        If not; the message names those that are missing.
    """
    missing = [module for module in modules if not _is_found(module)]
    if missing:
        raise CommandError(missing_line(missing))


def _remedy(modules: Sequence[str]) -> str:
    if not ROS_MODULES.isdisjoint(modules):
        return (
            'source the setup.sh of ROS 2 Jazzy, or run "pip install \'.[jazzy]\'" in the '
            'source folder of pool_sim_ros'
        )
    from_pypi = 'pip install ' + ' '.join(_ON_PYPI.get(module, module) for module in modules)
    if not _ON_UBUNTU.keys() >= set(modules):
        return from_pypi
    return f'apt install {" ".join(_ON_UBUNTU[module] for module in modules)}, or {from_pypi}'


def _is_found(module: str) -> bool:
    try:
        return find_spec(module) is not None
    except (ImportError, ValueError):  # a finder refuses it; it is None in sys.modules
        return False
