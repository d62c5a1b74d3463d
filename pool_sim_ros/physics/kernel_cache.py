"""Keeps compiled kernels from one process to the next.

numba's own cache knows the source of the function that Python calls alone: after an edit in another
module it would play yesterday's physics. It ends each import where it finds no folder, and each
start where a file of it is damaged. So this one stands in its place. What goes wrong here costs
time, never a start: then kernels are compiled in memory, and one line in the log says why.
"""

from __future__ import annotations

import hashlib
import logging
import pickle
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from importlib.util import cache_from_source
from pathlib import Path
from typing import Any

import numba
import numpy as np
from numba.core import config

from pool_sim_ros.physics.kernel_files import KernelFiles
from pool_sim_ros.physics.kernel_sources import source_hash

ROOM = __name__.rpartition('.')[0]
"""Whose functions and types are kept: `source_hash` says nothing of the source of any other."""

CODE_SETTINGS = ('OPT', 'BOUNDSCHECK', 'DEBUGINFO_DEFAULT', 'LOOP_VECTORIZE', 'SLP_VECTORIZE')
"""Settings of numba that change the machine code."""

LOG = logging.getLogger(ROOM)
"""Python's log, which writes warnings to stderr, each in one line, unless a program sets it up."""


def keep(dispatcher: Any) -> None:
    """Have numba keep what it compiles for a function, where it is one of this package."""
    if not dispatcher.py_func.__module__.startswith(f'{ROOM}.'):
        return
    if hasattr(dispatcher, '_cache'):
        dispatcher._cache = KernelCache(dispatcher.py_func)
    else:
        tell_once(f'numba {numba.__version__} keeps compiled code in a way unknown to this package')


class KernelCache:
    """What a dispatcher of numba asks for compiled code, and gives it to.

    Parameters
    ----------
    function : callable
    """

    def __init__(self, function: Any) -> None:
        self._name = f'{function.__module__}.{function.__qualname__}'

    @property
    def cache_path(self) -> str | None:
        """The folder that is read first."""
        try:
            return _files(_key()).folder
        except OSError:
            return None

    def load_overload(self, signature: Any, target_context: Any) -> Any:
        """Return what was compiled for a signature before; None where nothing was kept."""
        target_context.refresh()
        try:
            name = self._file_name(signature, target_context.codegen())
            content = None if name is None else _files(_key()).read(name)
            if content is None:
                tell_of_compiling(signature)
                return None
            from numba.core.compiler import CompileResult

            return CompileResult._rebuild(target_context, *pickle.loads(content))
        except Exception:  # whatever it is: compiling it again is always right
            LOG.debug('%s is compiled again', self._name, exc_info=True)
            tell_of_compiling(signature)
            return None

    def save_overload(self, signature: Any, compiled: Any) -> None:
        """Keep what was compiled for a signature."""
        try:
            name = self._file_name(signature, compiled.codegen)
            if name is None or compiled.library.has_dynamic_globals:
                return
            from numba.core.serialize import dumps

            _files(_key()).write(name, dumps(compiled._reduce()))
        except OSError as error:
            tell_once(str(error))
        except Exception as error:  # another numba
            tell_once(f'{type(error).__name__}: {error}')

    def enable(self) -> None:
        """Do nothing: it always is."""

    def disable(self) -> None:
        """Do nothing: nobody asks for it."""

    def flush(self) -> None:
        """Do nothing: a folder is forgotten once the source changes."""

    def _file_name(self, signature: Any, codegen: Any) -> str | None:
        """Return the name for a signature; None where a type is not one of this package."""
        parts = getattr(signature, 'args', signature)
        named = [kind for part in parts for kind in named_tuples(part)]
        if not all(kind.__module__.startswith(f'{ROOM}.') for kind in named):
            return None
        types = [f'{kind.__module__}.{kind.__qualname__}' for kind in named]
        what = self._name, str(signature), types, codegen.magic_tuple()
        digest = hashlib.blake2b(repr(what).encode(), digest_size=12).hexdigest()
        return f'{self._name.removeprefix(f"{ROOM}.")}-{digest}.nbc'


def named_tuples(type_: Any) -> list[type]:
    """Return the classes of all named tuples in a type of numba, in order."""
    own = [type_.instance_class] if hasattr(type_, 'instance_class') else []
    return own + [kind for part in getattr(type_, 'types', ()) for kind in named_tuples(part)]


def tell_of_compiling(signature: Any) -> None:
    """Say in one line that something is compiled now for which somebody has to wait.

    A named tuple among the arguments knows it: that of balls that spin. Discs are compiled in
    silence, as they always were.
    """
    for part in getattr(signature, 'args', signature):
        for kind in named_tuples(part):
            notice = getattr(kind, 'compile_notice', None)
            if notice is not None and not getattr(_quiet, 'on', False):
                LOG.warning('pool_sim_ros compiles %s', notice())
                return


@contextmanager
def silence() -> Iterator[None]:
    """Let this thread compile without a word."""
    before, _quiet.on = getattr(_quiet, 'on', False), True
    try:
        yield
    finally:
        _quiet.on = before


_quiet = threading.local()


def tell_once(reason: str) -> None:
    """Say in one line, once in a process, why what is compiled is not kept."""
    if reason and not _told:
        _told.append(reason)
        LOG.warning(
            'pool_sim_ros cannot keep its compiled kernels, the next start compiles them again: %s',
            reason,
        )


_told: list[str] = []


def folders() -> list[Path]:
    """Return where compiled kernels may lie: where NUMBA_CACHE_DIR says, else beside the package.

    Else in the user's own folder for caches, where there is one.
    """
    if config.CACHE_DIR:
        return [Path(config.CACHE_DIR).absolute()]
    places = [Path(cache_from_source(__file__)).parent]
    try:
        from numba.misc.appdirs import AppDirs

        places.append(Path(AppDirs('pool_sim_ros', appauthor=False).user_cache_dir))
    except ImportError:
        pass
    # Without a home the user's folder is '~' and what follows, which is no folder.
    return [place for place in places if place.is_absolute()]


def _key() -> str:
    """Return what names a version of all that the machine code depends on but the processor."""
    settings = [getattr(config, name, None) for name in CODE_SETTINGS]
    versions = sys.version, sys.flags.optimize, numba.__version__, np.__version__
    what = source_hash(), versions, settings
    return hashlib.blake2b(repr(what).encode(), digest_size=12).hexdigest()


@cache
def _files(key: str) -> KernelFiles:
    return KernelFiles(folders(), key)
