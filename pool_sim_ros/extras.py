"""Packages that only some functions need: what to say where one is not installed."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def needs(what: str, extra: str) -> Iterator[None]:
    """Import in this context what belongs to an extra.

    Parameters
    ----------
    what : str
        What needs it, as its user knows it.
    extra : str
        One of those in setup.py.

    Raises
    ------
    ModuleNotFoundError
        Where a package is missing; its one line names the package and the extra.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        package = (error.name or '').partition('.')[0]
        if package == 'pool_sim_ros':
            raise
        raise ModuleNotFoundError(
            f'{what} needs {package}, not installed here: pip install {package} '
            f'(the extra {extra} has all that it needs)',
            name=package,
        ) from None
