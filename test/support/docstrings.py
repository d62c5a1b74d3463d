"""What the docstring of a public name lacks: parameters, shapes, units, errors.

It has either numpydoc's sections, or, where it is short, sentences that say the same: each
parameter in backticks, the shape of each array in brackets, each error by its name.
"""

from __future__ import annotations

import ast
import importlib
import inspect
import re
import types
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path
from typing import Any

from numpydoc.docscrape import FunctionDoc, Parameter
from raised_errors import raised

PACKAGE = 'pool_sim_ros'
UNITS = re.compile(r'(?<![\w/])(m|s|kg|rad|[Dd]egrees|radii|inches|ns|(m|rad)/s(\^2)?)(?![\w/])')
NO_UNIT = re.compile(
    r'\b([Cc]oefficients?|restitution|over that of|shares?|[Cc]hances?|[01] to 1|parts?|many times'
    r'|quaternions?|any length|numbers?|frames a second|units of)\b'
)
"""Words by which a text says that a number has no unit, or where its units stand."""
SAME = re.compile(r'\b[Aa]s (in|of|from|rclpy|`)|[Ff]ields\b')
"""Refers to what has the words."""
SHAPE = re.compile(r'\(\w*( [+*] \w+)?,|\(-?\w+, \w+\)')
DESCRIPTORS = (types.FunctionType, staticmethod, classmethod, property, cached_property)


def public_names(room: str) -> Iterator[tuple[str, Any]]:
    """Yield what a room exports, and the methods and properties of its classes."""
    module = importlib.import_module(f'{PACKAGE}.{room}')
    for name in module.__all__:
        thing = getattr(module, name)
        yield f'{room}.{name}', thing
        if inspect.isclass(thing):
            for part, member in members(thing).items():
                yield f'{room}.{name}.{part}', member


def members(cls: type) -> dict[str, Any]:
    """Return the public methods and properties that this package defines for a class."""
    found = {}
    for base in reversed(cls.__mro__):
        if base.__module__.startswith(PACKAGE):
            for name, member in vars(base).items():
                if not name.startswith('_') and isinstance(member, DESCRIPTORS):
                    found[name] = getattr(member, '__func__', member)
    return found


def below_constants(room: str) -> dict[str, str]:
    """Return the docstrings that stand below the constants of a room, by name."""
    found = {}
    folder = Path(importlib.import_module(f'{PACKAGE}.{room}').__file__ or '').parent
    for path in folder.glob('*.py'):
        body = ast.parse(path.read_text()).body
        for node, below in zip(body, body[1:], strict=False):
            targets = getattr(node, 'targets', [getattr(node, 'target', None)])
            if isinstance(below, ast.Expr) and isinstance(below.value, ast.Constant):
                name = getattr(targets[0], 'id', None)
                if isinstance(node, ast.Assign | ast.AnnAssign) and name:
                    found[name] = str(below.value.value)
    return found


def lacks(name: str, thing: Any, below: dict[str, str]) -> list[str]:
    """Return a line for each thing that the docstring of a public name lacks."""
    if isinstance(thing, property | cached_property):
        function = thing.fget if isinstance(thing, property) else thing.func
        return lacks_of_value(function.__doc__ or '', str(function.__annotations__['return']))
    if inspect.isclass(thing) or inspect.isfunction(thing):
        text = inspect.cleandoc(thing.__doc__ or '')
        return lacks_of_head(text) or [
            *lacks_of_parameters(thing, text),
            *lacks_of_ends(thing, text),
        ]
    if inspect.ismodule(thing):
        return lacks_of_head(thing.__doc__ or '')
    return lacks_of_head(below.get(name.rpartition('.')[2], ''))


def lacks_of_head(text: str) -> list[str]:
    """Return what is wrong with the first paragraph of a docstring."""
    head = re.split(r'\n\s*\n', text.strip())[0]
    if not head:
        return ['no docstring']
    return [] if head.endswith(('.', ':')) else ['its first sentence has no end']


def lacks_of_value(text: str, annotation: str) -> list[str]:
    """Return what a text lacks that describes a value of this type."""
    found = lacks_of_head(text)
    if re.search('NDArray|ArrayLike', annotation) and not SHAPE.search(text):
        found.append('no shape')
    if re.search(r'\bfloat', annotation) and not has_unit(text):
        found.append('no unit')
    return found


def lacks_of_parameters(thing: Any, text: str) -> list[str]:
    """Return what a docstring lacks about what a function or a class is given."""
    given, open_ended = parameters_of(thing)
    doc = FunctionDoc(None, doc=text)
    entries = {
        part.strip(): entry
        for entry in (*doc['Parameters'], *doc['Attributes'])
        for part in entry.name.split(',')
    }
    if not entries:
        missing = [name for name in given if f'`{name}`' not in text]
        return [f'parameter {name} is not documented' for name in missing]
    found = [f'parameter {name} is not documented' for name in given if name not in entries]
    if not open_ended and not doc['Attributes']:
        found += [f'there is no parameter {name}' for name in entries if name not in given]
    for name in given.keys() & entries.keys():
        found += [f'{name}: {lack}' for lack in lacks_of_entry(entries[name], given[name])]
    return found


def parameters_of(thing: Any) -> tuple[dict[str, str], bool]:
    """Return the annotations of parameters by name, and whether any other name is taken too."""
    is_exception = inspect.isclass(thing) and issubclass(thing, Exception)
    if is_exception or hasattr(thing, '__members__'):  # nobody makes these
        return {}, False
    parameters = inspect.signature(thing).parameters.values()
    taken = {
        p.name: str(p.annotation)
        for p in parameters
        if p.kind not in (p.VAR_KEYWORD, p.VAR_POSITIONAL) and not p.name.startswith('_')
    }
    taken.pop('self', None)
    return taken, any(p.kind == p.VAR_KEYWORD for p in parameters)


def lacks_of_entry(entry: Parameter, annotation: str) -> list[str]:
    """Return what one entry of a section lacks."""
    words = f'{entry.type} {" ".join(entry.desc)}'
    if SAME.search(words):
        return []
    found = [] if entry.type else ['no type']
    if re.search('NDArray|ArrayLike', annotation) and not SHAPE.search(words):
        found.append('no shape')
    if re.search(r'\bfloat|ArrayLike', annotation) and not has_unit(words):
        found.append('no unit')
    return found


def lacks_of_ends(thing: Any, text: str) -> list[str]:
    """Return what a docstring lacks about what comes back and what is raised."""
    doc, found = FunctionDoc(None, doc=text), []
    if inspect.isfunction(thing):
        answer = str(thing.__annotations__.get('return', 'None'))
        if doc['Returns']:
            said = ' '.join(f'{e.name} {e.type} {" ".join(e.desc)}' for e in doc['Returns'])
        else:
            said = ' '.join([*doc['Summary'], *doc['Extended Summary']])
            if answer != 'None' and not re.match('Return|Whether', said):
                found.append('nothing about what it returns')
        wrong = [] if SAME.search(said) else lacks_of_value(f'{said}.', answer)
        found += [f'what it returns: {lack}' for lack in wrong]
    section = [part.strip() for e in doc['Raises'] for part in (e.type or e.name).split(',')]
    said = re.findall(r'\w+', text) if not section else section
    for error in raised(thing):
        if not {base.__name__ for base in error.__mro__} & set(said):
            found.append(f'nothing about {error.__name__}, which it raises')
    return found


def has_unit(text: str) -> bool:
    """Return whether a text names a unit, or says that there is none."""
    return bool(UNITS.search(text) or NO_UNIT.search(text) or SAME.search(text))
