"""Read the node's parameter file without ROS."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

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
        If the file cannot be read, or if a node would refuse to start with it.
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


def _parameters(content: object) -> Mapping[str, object]:
    for key in ('/**', 'ros__parameters'):
        content = content.get(key) if isinstance(content, Mapping) else None
    if not isinstance(content, Mapping):
        raise ParameterError('it must have its parameters under /**: and ros__parameters:')
    return content


def _flat(tree: Mapping[str, object], prefix: str = '') -> Iterator[tuple[str, object]]:
    """Yield dotted names with their values."""
    for key, value in tree.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f'{prefix}{key}.')
        else:
            yield f'{prefix}{key}', value


def _loader() -> Any:
    """Return a YAML loader that reads 1e-6 as a number, as ROS does and YAML 1.1 does not."""
    import yaml

    loader: Any = type('Loader', (yaml.SafeLoader,), {})
    number = re.compile(r'[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+$')
    loader.add_implicit_resolver('tag:yaml.org,2002:float', number, list('-+.0123456789'))
    return loader


def _in_one_line(error: Exception) -> str:
    problem = getattr(error, 'problem', None) or str(error).splitlines()[0]
    mark = getattr(error, 'problem_mark', None)
    return f'{problem}, line {mark.line + 1}' if mark else problem
