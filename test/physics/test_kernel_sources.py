"""The hash changes with any source file, and nobody takes it for what a process has not loaded."""

import os
import time
from pathlib import Path

import pytest
from own_package import copy_package

from pool_sim_ros.physics import kernel_sources
from pool_sim_ros.physics.kernel_sources import ROOM, source_hash, stamps

HASH = 'from pool_sim_ros.physics.kernel_sources import source_hash; print(source_hash())'


@pytest.fixture
def package(tmp_path):
    return copy_package(tmp_path)


def test_it_covers_every_module_of_the_room():
    modules = {str(path) for path in ROOM.rglob('*.py') if '__pycache__' not in path.parts}
    assert set(stamps()) == modules and len(modules) > 40


@pytest.mark.parametrize(
    'name', ['tolerances.py', 'motion/disc.py', 'event_driven/engine.py', '__init__.py']
)
def test_an_edit_anywhere_changes_it(package, name):
    (before,) = package.run(HASH).words
    assert package.run(HASH).words == [before]
    path = package.physics / name
    path.write_text(path.read_text() + '\n')
    (after,) = package.run(HASH).words
    assert after != before
    path.write_text(path.read_text()[:-1])
    assert package.run(HASH).words == [before]


def test_a_new_file_and_a_file_renamed_change_it(package):
    hashes = set(package.run(HASH).words)
    (package.physics / 'new.py').write_text('')
    hashes |= set(package.run(HASH).words)
    (package.physics / 'new.py').rename(package.physics / 'newer.py')
    hashes |= set(package.run(HASH).words)
    assert len(hashes) == 3


def test_what_is_no_source_does_not(package):
    """Editors leave hidden links that lead nowhere."""
    before = package.run(HASH).words
    (package.physics / 'notes.txt').write_text('')
    (package.physics / '.#disc.py').symlink_to('somebody@somewhere')
    assert package.run(HASH).words == before


def test_after_an_edit_nobody_knows_what_the_process_has_loaded(monkeypatch):
    path = str(ROOM / 'tolerances.py')
    edited = {**stamps(), path: (0, 0, 0)}
    monkeypatch.setattr(kernel_sources, 'stamps', lambda: edited)
    with pytest.raises(OSError, match='was edited after this process began'):
        source_hash()


def test_where_there_is_no_source(monkeypatch):
    monkeypatch.setattr(kernel_sources, '_at_start', {})
    with pytest.raises(OSError, match='no source files'):
        source_hash()


def test_a_folder_that_does_not_exist_has_no_stamps(monkeypatch):
    monkeypatch.setattr(kernel_sources, 'ROOM', Path(os.devnull, 'nowhere'))
    assert stamps() == {}


def test_it_takes_no_time():
    """A start must not show it; the best of some, since others use the machine too."""
    seconds = []
    for _ in range(5):
        kernel_sources._hash.cache_clear()
        start = time.perf_counter()
        source_hash()
        seconds.append(time.perf_counter() - start)
    assert min(seconds) < 0.02
