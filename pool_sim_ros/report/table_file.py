"""The node's parameter file, read without ROS."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path

from pool_sim_ros.report.errors import ReportError
from pool_sim_ros.simulator import ParameterError, Settings, build_settings, values_from


class TableFileError(ReportError):
    """A parameter file that cannot be used."""


def read_settings(path: Path) -> Settings:
    """Return the settings in a parameter file like ``config/report.yaml``.

    Parameters
    ----------
    path : Path

    Raises
    ------
    TableFileError
        Where the file cannot be read, or a node would refuse to start with it.
    """
    import yaml

    try:
        content = yaml.load(path.read_text(encoding='utf-8'), Loader=_loader())
    except OSError as error:
        raise TableFileError(f'cannot read {path}: {error.strerror}') from error
    except UnicodeDecodeError as error:
        raise TableFileError(f'cannot read {path}: it is not UTF-8 text') from error
    except yaml.YAMLError as error:
        raise TableFileError(f'cannot read {path}: {_in_one_line(error)}') from error
    try:
        return build_settings(values_from(dict(_flat(_parameters(content)))))
    except ParameterError as error:
        raise TableFileError(f'{path}: {error}') from error


def _parameters(content: object) -> Mapping:
    for key in ('/**', 'ros__parameters'):
        content = content.get(key) if isinstance(content, Mapping) else None
    if not isinstance(content, Mapping):
        raise ParameterError('it must have its parameters under /**: and ros__parameters:')
    return content


def _flat(tree: Mapping, prefix: str = '') -> Iterator[tuple[str, object]]:
    """Yield dotted names and their values."""
    for key, value in tree.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f'{prefix}{key}.')
        else:
            yield f'{prefix}{key}', value


def _loader() -> type:
    """Return a YAML loader for which 1e-6 is a number, as it is for ROS; by YAML 1.1 it is not."""
    import yaml

    class Loader(yaml.SafeLoader):
        pass

    number = re.compile(r'[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+$')
    Loader.add_implicit_resolver('tag:yaml.org,2002:float', number, list('-+.0123456789'))
    return Loader


def _in_one_line(error: Exception) -> str:
    problem = getattr(error, 'problem', None) or str(error).splitlines()[0]
    mark = getattr(error, 'problem_mark', None)
    return f'{problem}, line {mark.line + 1}' if mark else problem
