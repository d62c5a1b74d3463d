"""Packages that load a module only when one of its names is asked for (PEP 562).

numba takes half a second to import. A client that only formats lengths need not wait for it.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module


def lazy_exports(package: str, modules: dict[str, str]) -> Callable[[str], object]:
    """Return a `__getattr__` for a package.

    Parameters
    ----------
    package : str
        Its `__name__`.
    modules : dict of str
        Exported name -> module below the package that defines it; a name that is the module's own
        stands for the module.
    """

    def get(name: str) -> object:
        if name not in modules:
            raise AttributeError(f'module {package!r} has no attribute {name!r}')
        module = import_module(f'{package}.{modules[name]}')
        return module if name == modules[name] else getattr(module, name)

    return get
