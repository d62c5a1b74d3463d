"""What the docstring of a public name lacks: parameters, shapes, units, returns, errors."""

from __future__ import annotations

import ast
import dataclasses
import enum
import importlib
import inspect
import re
import textwrap
import types
from collections.abc import Iterator
from functools import cached_property, lru_cache
from typing import Any

from numpydoc.docscrape import FunctionDoc, Parameter

PACKAGE = 'pool_sim_ros'
UNIT = re.compile(
    r'(?<![\w/])(m|s|kg|Hz|ns|rad|deg|degrees|radii|radians|MiB|bytes|seconds|metres|inches|'
    r'(?:m|rad)/s(?:\^2)?|1/s)(?![\w/])'
)
NUMBERS = re.compile(
    r'\b([Cc]oefficients?|restitutions?|friction|ratio|parts?|per cent|share|[Cc]hance|0 to 1|[Nn]umber|index|'
    r'how many times|times as|quaternions?|unit normal|unit vector|count|mass over|frames a second|flags?|'
    r'standard deviations?|[Aa]s (?:in|of)|see)\b'
)
"""What has no unit and says so."""
SHAPE = re.compile(r'\((?:\w[\w +]*)?(?:, ?(?:\w[\w +]*)?)*\)|of shape|float|structured')
QUIET = {'NotImplementedError', 'AssertionError', 'StopIteration', 'ModuleNotFoundError'}


def public_names(rooms):
    """Return (name, object) of each export, and of each public method and property of a class."""
    for room in rooms:
        module = importlib.import_module(f'{PACKAGE}.{room}')
        for name in module.__all__:
            thing = getattr(module, name)
            yield f'{room}.{name}', thing
            if inspect.isclass(thing):
                for part, member in members(thing):
                    yield f'{room}.{name}.{part}', member


def members(cls):
    for base in reversed(cls.__mro__):
        if base.__module__.startswith(PACKAGE):
            for name, member in vars(base).items():
                if not name.startswith('_') and isinstance(
                    member, (types.FunctionType, staticmethod, classmethod, property, cached_property)
                ):
                    yield name, getattr(member, '__func__', member)
