"""How the compiled functions of this package are compiled, and how one is chosen by type."""

from __future__ import annotations

import inspect
import threading
from collections.abc import Callable
from functools import cached_property, update_wrapper, wraps
from typing import Any, TypeVar

import numpy as np
from numba import config, njit, typeof, types
from numba.extending import overload
from numpy.typing import NDArray

from pool_sim_ros.physics import kernel_cache
from pool_sim_ros.physics.plain_python import as_plain_python

OPTIONS = {'error_model': 'numpy', 'nogil': True, '_nrt': False}
"""Divide as numpy does; let other threads run meanwhile. Never `fastmath`: results are promised bit
for bit.

Kernels allocate nothing and keep no arrays. So numba's reference counts, which cost the event loop
half its time, are switched off; an allocation in a kernel does not compile.
"""

FOR_KERNELS = {**OPTIONS, 'no_cpython_wrapper': True, 'no_cfunc_wrapper': True}
"""For functions that compiled ones call: without the code that takes Python's arguments apart.

For named tuples of dozens of arrays that code takes a third of the time of compiling.
"""


class Kernel:
    """A function that compiled functions call. Python may: then it is compiled once more, and kept.

    Parameters
    ----------
    function : callable
    **options
        As numba's, for those that compiled functions call.
    """

    def __init__(self, function: Callable[..., Any], **options: Any) -> None:
        update_wrapper(self, function)
        self.py_func = function
        self._for_kernels = njit(**FOR_KERNELS, **options)(function)
        # By this name numba asks an object for its type.
        self._numba_type_ = types.Dispatcher(self._for_kernels)

    @cached_property
    def for_python(self) -> Any:
        """numba's dispatcher, for Python; what it compiles is kept, see `kernel_cache`."""
        with _making:  # threads that play first at once must not make two
            if 'for_python' not in vars(self):
                dispatcher = njit(**OPTIONS)(self.py_func)
                kernel_cache.keep(dispatcher)
                vars(self)['for_python'] = dispatcher
            return vars(self)['for_python']

    def __call__(self, *args: Any) -> Any:
        return self.for_python(*args)


_making = threading.Lock()


def kernel(function: Callable[..., Any]) -> Any:
    """Compile a function that is long or rarely called."""
    return as_plain_python(function) if config.DISABLE_JIT else Kernel(function)


def inlined(function: Callable[..., Any]) -> Any:
    """Compile a function into its callers: passing it arrays would cost more than it does."""
    if config.DISABLE_JIT:
        return as_plain_python(function)
    return Kernel(function, forceinline=True)


def for_kernels(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return an array of the one memory layout that the kernels are compiled for."""
    if values.flags.c_contiguous and values.flags.writeable:
        return values
    return np.array(values, order='C')


NONE = np.int64(0)
"""How many there are to begin with. Not a literal: for each of those a kernel is compiled anew."""

Record = Any
"""One row of a structured array. In a kernel its fields are attributes."""


Function = TypeVar('Function', bound=Callable[..., Any])


def chosen_by(parameter: str) -> Callable[[Function], Function]:
    """Make a function whose implementation is chosen by the type of one of its arguments.

    numba chooses when it compiles, so the choice costs nothing when the code runs. `register` adds
    an implementation; the decorated function itself has only the signature and the docstring.

    Parameters
    ----------
    parameter : str
        Name of the argument, a named tuple.
    """

    def decorate(declaration: Function) -> Function:
        implementations: dict[type, Callable[..., Any]] = {}
        index = list(inspect.signature(declaration).parameters).index(parameter)

        @wraps(declaration)
        def call(*args: Any) -> Any:
            return implementations[type(args[index])](*args)

        def choose(*types: Any) -> Callable[..., Any] | None:
            return implementations.get(getattr(types[index], 'instance_class', object))

        overload(call, jit_options={**FOR_KERNELS, 'forceinline': True}, strict=False)(choose)
        call.implementations = implementations  # type: ignore[attr-defined]
        return call  # type: ignore[return-value]

    return decorate


def register(choice: Callable[..., Any], type_: type, implementation: Callable[..., Any]) -> None:
    """Add the implementation of a `chosen_by` function for one type of named tuple."""
    choice.implementations[type_] = getattr(implementation, 'py_func', implementation)  # type: ignore[attr-defined]


def call_directly(function: Any, key: tuple[type, ...], *args: Any) -> Any:
    """Call a `kernel` past numba's look at the types of all arguments.

    For dozens of arrays in named tuples that look takes ten times as long as the call.

    Parameters
    ----------
    function : kernel
    key : tuple of type
        All calls with one key must have arguments of the same types; nobody checks this.
    *args
    """
    entry_point = _entry_points.get((function, key))
    if entry_point is not None:
        return entry_point(*args)
    returned = function(*args)
    if not isinstance(function, Kernel):  # plain Python
        return returned
    compiled = function.for_python.overloads[tuple(typeof(argument) for argument in args)]
    _entry_points[function, key] = compiled.entry_point
    return returned


_entry_points: dict[tuple[Any, tuple[type, ...]], Callable[..., Any]] = {}
