"""The rules of the house: rooms are entered through their door, and every module has its test.

import-linter, which `make check` runs, holds the directions between the rooms.
"""

import ast
import importlib
from pathlib import Path

import pytest
from house import PACKAGE, House

PROJECT = Path(__file__).parents[1]
HOUSE = House(PROJECT)
LONGEST_MODULE = 300


def assert_none(offenders, rule):
    offenders = list(offenders)
    listing = '\n'.join(f'  {offender}' for offender in offenders)
    assert not offenders, f'{rule}; {len(offenders)} do not:\n{listing}'


def names(module):
    """Return the part of a module's name below the package."""
    return module.name.partition('.')[2] or module.name


def test_nobody_imports_past_the_init_of_a_room():
    offenders = [line for m in HOUSE.modules.values() for line in HOUSE.reaches_past(m)]
    assert_none(offenders, 'Imports end at the __init__ of a room')


def test_every_init_says_what_its_room_is_for():
    silent = [names(room) for room in HOUSE.rooms if not ast.get_docstring(room.tree)]
    assert_none(silent, 'Every __init__ has a docstring')


def test_every_exported_name_resolves():
    missing = []
    for room in HOUSE.rooms:
        loaded = importlib.import_module(room.name)
        for name in room.exports:
            try:
                exec(f'from {loaded.__name__} import {name}', {})
            except ImportError as error:
                if isinstance(error, ModuleNotFoundError) and not str(error.name).startswith(
                    PACKAGE
                ):
                    continue  # an optional package is not installed here
                missing.append(f'{names(room)}: {name} ({error})')
    assert_none(missing, 'Every name in __all__ can be imported')


def test_every_room_that_loads_lazily_exports_the_same_names_to_mypy_and_to_python():
    """What stands under TYPE_CHECKING, what `lazy_exports` knows, and `__all__` are one list."""
    differing = []
    for room in HOUSE.rooms:
        lazy = {
            key.value
            for call in ast.walk(room.tree)
            if isinstance(call, ast.Call) and getattr(call.func, 'id', '') == 'lazy_exports'
            for key in call.args[1].keys
        }
        typed = {
            alias.asname or alias.name
            for branch in room.tree.body
            if isinstance(branch, ast.If)
            for node in branch.body
            if isinstance(node, ast.ImportFrom)
            for alias in node.names
        }
        unknown = lazy - set(room.exports)
        if (lazy and lazy != typed) or unknown:
            differing.append(f'{names(room)}: {sorted((lazy ^ typed) | unknown)}')
    assert_none(differing, 'A lazy room has one list of names')


def test_every_module_has_a_test_module_of_its_name():
    untested = []
    for module in HOUSE.modules.values():
        if module.is_room or module.stem == '__main__':
            continue
        folder = (
            PROJECT / 'test' / module.path.relative_to(PROJECT).parent.relative_to('pool_sim_ros')
        )
        tests = folder.rglob(f'test_{module.stem}.py')
        if not any('def test_' in file.read_text() for file in tests):
            untested.append(names(module))
    assert_none(untested, 'Every module has a test module of its name in the mirrored folder')


def test_no_module_is_too_long():
    lengths = {m: len(m.path.read_text().splitlines()) for m in HOUSE.modules.values()}
    long = [f'{names(m)}: {length}' for m, length in lengths.items() if length > LONGEST_MODULE]
    assert_none(long, f'A module has at most {LONGEST_MODULE} lines')


@pytest.fixture
def small_house(tmp_path):
    """Return a function that builds a package of files, path -> text."""

    def build(files):
        rooms = ['pool_sim_ros', 'pool_sim_ros/a', 'pool_sim_ros/a/inner', 'pool_sim_ros/b']
        texts = {f'{room}/__init__.py': '' for room in rooms}
        for path, text in (texts | {f'pool_sim_ros/{p}': t for p, t in files.items()}).items():
            file = tmp_path / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
        return House(tmp_path)

    return build


@pytest.mark.parametrize(
    'text',
    [
        'from pool_sim_ros.a.x import y',
        'import pool_sim_ros.a.x',
        'def f():\n    from pool_sim_ros.a.x import y',
        'if TYPE_CHECKING:\n    from pool_sim_ros.a.x import y',
        'from ..a.x import y',
        'from ..a import x',
        'from pool_sim_ros.a import x',
        'from pool_sim_ros.a.inner import y',
        'from pool_sim_ros.a.inner.z import y',
    ],
)
def test_a_reach_past_an_init_is_found(small_house, text):
    house = small_house(
        {'b/user.py': text, 'a/x.py': '', 'a/inner/z.py': '', 'a/__init__.py': "__all__ = ['ok']"}
    )
    (line,) = house.reaches_past(house.modules['pool_sim_ros.b.user'])
    assert line.startswith('pool_sim_ros.b.user:')


@pytest.mark.parametrize(
    'text',
    [
        'from pool_sim_ros.a import ok',
        'import pool_sim_ros.a',
        'from pool_sim_ros.b.other import y',
        'from .other import y',
        'from pool_sim_ros.lazy import lazy_exports',
        'import json.decoder',
    ],
)
def test_an_import_through_an_init_is_none(small_house, text):
    house = small_house({'b/user.py': text, 'b/other.py': '', 'a/__init__.py': "__all__ = ['ok']"})
    assert house.reaches_past(house.modules['pool_sim_ros.b.user']) == []


def test_a_room_is_no_way_past_the_rooms_in_it(small_house):
    text = "__getattr__ = lazy_exports(__name__, {'y': 'inner.z', 'w': 'inner'})"
    house = small_house({'a/__init__.py': text})
    (line,) = house.reaches_past(house.modules['pool_sim_ros.a'])
    assert 'pool_sim_ros.a.inner.z' in line
