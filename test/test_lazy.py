"""A room loads a module when one of its names is asked for, and not before."""

import importlib
import sys

import pytest


@pytest.fixture
def room(tmp_path, monkeypatch):
    """A package that exports one name of each of its two modules, imported."""
    folder = tmp_path / 'small_room'
    folder.mkdir()
    (folder / '__init__.py').write_text(
        'from pool_sim_ros.lazy import lazy_exports\n'
        "__getattr__ = lazy_exports(__name__, {'WIDTH': 'sizes', 'NAME': 'names'})\n"
    )
    (folder / 'sizes.py').write_text('WIDTH = 3\n')
    (folder / 'names.py').write_text('NAME = "small"\n')
    monkeypatch.syspath_prepend(tmp_path)
    yield importlib.import_module('small_room')
    for name in [name for name in sys.modules if name.partition('.')[0] == 'small_room']:
        del sys.modules[name]


def test_a_module_is_loaded_when_its_name_is_asked_for(room):
    assert not {'small_room.sizes', 'small_room.names'} & set(sys.modules)
    assert room.WIDTH == 3
    assert 'small_room.sizes' in sys.modules and 'small_room.names' not in sys.modules


def test_a_name_is_imported_as_from_any_package(room):
    names = {}
    exec('from small_room import NAME, sizes', names)
    assert names['NAME'] == 'small' and names['sizes'].WIDTH == 3


def test_an_unknown_name_is_an_error_that_names_room_and_name(room):
    with pytest.raises(AttributeError, match="'small_room'.*'HEIGHT'"):
        room.HEIGHT  # noqa: B018
    with pytest.raises(ImportError, match='HEIGHT'):
        exec('from small_room import HEIGHT', {})


def test_a_name_that_is_a_modules_own_is_the_module(tmp_path, monkeypatch):
    folder = tmp_path / 'small_room'
    folder.mkdir()
    (folder / '__init__.py').write_text(
        'from pool_sim_ros.lazy import lazy_exports\n'
        "__getattr__ = lazy_exports(__name__, {'sizes': 'sizes'})\n"
    )
    (folder / 'sizes.py').write_text('WIDTH = 3\n')
    monkeypatch.syspath_prepend(tmp_path)
    room = importlib.import_module('small_room')
    try:
        assert 'small_room.sizes' not in sys.modules
        assert room.sizes.WIDTH == 3
    finally:
        for name in [name for name in sys.modules if name.partition('.')[0] == 'small_room']:
            del sys.modules[name]
