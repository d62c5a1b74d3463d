"""The errors that a function raises, read from its source and from that of what it calls."""

from __future__ import annotations

import ast
import builtins
import importlib
import inspect
import textwrap
from typing import Any

PACKAGE = 'pool_sim_ros'
FAULTS = (AssertionError, NotImplementedError, RuntimeError, StopIteration, SystemExit)
"""Faults of ours, and ends: no caller can cause them."""
MAKERS = ('__init__', '__post_init__', '__new__')
"""What runs where an object is made."""

Errors = frozenset[type[BaseException]]
KNOWN: dict[Any, Errors] = {}
"""What was found so far; nothing yet for a function that is looked at, since it may call itself."""


def raised(thing: Any) -> Errors:
    """Return the classes of the errors that a function, or making an object of a class, raises.

    Calls of functions of this package are followed; those of methods of other objects are not.
    """
    thing = getattr(thing, '__wrapped__', thing)
    if thing not in KNOWN:
        KNOWN[thing] = frozenset()
        KNOWN[thing] = _of_class(thing) if inspect.isclass(thing) else _of_function(thing)
    return KNOWN[thing]


def _of_class(cls: type) -> Errors:
    makers = (vars(base).get(name) for base in cls.__mro__ if ours(base) for name in MAKERS)
    return frozenset().union(*(raised(maker) for maker in makers if inspect.isfunction(maker)))


def _of_function(function: Any) -> Errors:
    # What a dataclass makes has no source.
    if not inspect.isfunction(function) or function.__code__.co_filename == '<string>':
        return frozenset()
    tree = ast.parse(textwrap.dedent(inspect.getsource(function))).body[0]
    names = {**vars(builtins), **function.__globals__, **inspect.getclosurevars(function).nonlocals}
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and str(node.module).startswith(PACKAGE):
            module = importlib.import_module(str(node.module))
            names |= {
                alias.asname or alias.name: getattr(module, alias.name) for alias in node.names
            }
    reader = _Reader(names)
    for statement in tree.body:  # type: ignore[attr-defined]
        reader.visit(statement)
    return frozenset(reader.found)


def ours(thing: Any) -> bool:
    """Return whether a function or a class is of this package."""
    return str(getattr(thing, '__module__', '')).startswith(PACKAGE)


class _Reader(ast.NodeVisitor):
    """Walks through a function and collects what it raises."""

    def __init__(self, names: dict[str, Any]):
        self.names = names
        self.found: set[type[BaseException]] = set()

    def visit_FunctionDef(self, node: ast.FunctionDef) -> None:  # noqa: N802, ast's name
        """Leave out what is only defined: it runs elsewhere."""

    def visit_Try(self, node: ast.Try) -> None:  # noqa: N802, ast's name
        inner = _Reader(self.names)
        for statement in node.body:
            inner.visit(statement)
        caught: list[Any] = []
        for handler in node.handlers:
            if not any(isinstance(n, ast.Raise) and not n.exc for n in ast.walk(handler)):
                kinds = self.value(handler.type) if handler.type else BaseException
                caught += kinds if isinstance(kinds, tuple) else [kinds]
        kinds = tuple(kind for kind in caught if inspect.isclass(kind))
        self.found |= {error for error in inner.found if not issubclass(error, kinds)}
        for statement in [*node.handlers, *node.orelse, *node.finalbody]:
            self.visit(statement)

    def visit_Raise(self, node: ast.Raise) -> None:  # noqa: N802, ast's name
        error = self.value(node.exc.func if isinstance(node.exc, ast.Call) else node.exc)
        if inspect.isclass(error) and not issubclass(error, FAULTS):
            self.found.add(error)
        self.generic_visit(node)

    def visit_Call(self, node: ast.Call) -> None:  # noqa: N802, ast's name
        called = self.value(node.func)
        is_error = inspect.isclass(called) and issubclass(called, BaseException)
        if ours(called) and not is_error:
            self.found |= raised(called)
        self.generic_visit(node)

    def value(self, node: ast.AST | None) -> Any:
        """Return what an expression of names and dots stands for, or None."""
        if isinstance(node, ast.Name):
            return self.names.get(node.id)
        if isinstance(node, ast.Tuple):
            return tuple(self.value(element) for element in node.elts)
        if isinstance(node, ast.Attribute):
            owner = self.value(node.value)
            if inspect.ismodule(owner) or inspect.isclass(owner):
                return getattr(owner, node.attr, None)
        return None
