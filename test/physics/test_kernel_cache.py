"""Compiled kernels are kept from process to process; where that cannot be, it costs time alone.

One case of each kind runs always, the others in the soak.

Every test here that says what a user sees starts processes of its own, on a copy of the package;
most are forked from one that has loaded numba, see `own_package`.
"""

import os
import resource
import shutil
import subprocess
from types import SimpleNamespace
from typing import NamedTuple

import numba
import pytest
from numba.core.registry import cpu_target
from own_package import (
    CHECK,
    OUTSIDE,
    OVERLAP_ALLOWED,
    STRANGER,
    as_stranger,
    copy_package,
    without_capabilities,
)
from thinned import soak

from pool_sim_ros.physics import kernel_cache, pool_table, report_table, simulate
from pool_sim_ros.physics.boundary import Rectangle
from pool_sim_ros.physics.jit import kernel
from pool_sim_ros.physics.kernel_cache import KernelCache, keep, named_tuples
from pool_sim_ros.physics.kernel_files import KEPT
from pool_sim_ros.physics.validation import first_fault

COMPILED, LOADED = ['inside', 'True'], ['inside', 'False']


@pytest.fixture
def package(tmp_path):
    return copy_package(tmp_path)


@pytest.fixture
def forgetful(monkeypatch):
    """As a process that has said nothing yet."""
    monkeypatch.setattr(kernel_cache, '_told', [])


def test_the_second_process_loads_what_the_first_compiled(package):
    package.anew = True
    assert package.check().words == COMPILED
    assert package.check().words == LOADED
    assert [path.suffix for path in package.kept] == ['.nbc']
    assert package.check(x=OUTSIDE).words == ['outside', 'False']


@pytest.mark.parametrize(
    ('name', 'old', 'new'),
    [
        ('boundary/rectangle.py', 'least = radius - tolerance', 'least = radius - 1e-3'),
        *soak(
            ('tolerances.py', *OVERLAP_ALLOWED),
            ('validation.py', 'radii[i], OVERLAP)', 'radii[i], 1e-3)'),
        ),
    ],
    ids=['what it calls', 'a constant', 'the kernel itself'],
)
def test_an_edit_anywhere_counts_at_once(package, name, old, new):
    """And what was compiled before it is there again when it is undone."""
    assert package.check(x=OUTSIDE).words == ['outside', 'True']
    package.edit(name, old, new)
    assert package.check(x=OUTSIDE).words == ['inside', 'True']
    assert package.check(x=OUTSIDE).words == ['inside', 'False']
    package.edit(name, new, old)
    assert package.check(x=OUTSIDE).words == ['outside', 'False']


EDITED_MEANWHILE = """
import os
from pool_sim_ros.physics import Ball, Table
from pool_sim_ros.physics.tolerances import __file__ as file
old, new = {edit!r}
text = open(file).read()
open(file, 'w').write(text.replace(old, new))
os.utime(file, (2e9, 2e9))
try:
    Table(2.0, 1.0, [Ball('a', 0.1, 0.05, ({x}, 0.5))])
    print('inside')
except ValueError:
    print('outside')
"""


def test_an_edit_while_a_process_runs_does_not_reach_the_next_ones(package):
    """The process plays what it has loaded, which nobody must take for what now stands there."""
    script = EDITED_MEANWHILE.format(edit=OVERLAP_ALLOWED, x=OUTSIDE)
    ended = package.run(script)
    assert ended.words_after_a_notice == ['outside']
    assert 'edited' in ended.stderr
    assert package.kept == []
    assert package.check(x=OUTSIDE).words == ['inside', 'True']


def test_settings_that_change_the_code_have_code_of_their_own(package):
    assert package.check().words == COMPILED
    package.env['NUMBA_OPT'] = '1'
    assert package.check().words == COMPILED
    assert package.check().words == LOADED
    del package.env['NUMBA_OPT']
    assert package.check().words == LOADED


@pytest.mark.parametrize(
    'damage',
    [lambda whole: whole[: len(whole) // 2], *soak(b'', b'garbage')],
    ids=['cut', 'emptied', 'garbage'],
)
def test_a_damaged_file_is_compiled_and_kept_again(package, damage):
    package.check()
    (path,) = package.kept
    path.write_bytes(damage if isinstance(damage, bytes) else damage(path.read_bytes()))
    assert package.check().words == COMPILED
    assert package.check().words == LOADED
    assert package.kept == [path]


def test_a_folder_in_the_place_of_a_file_is_no_obstacle(package):
    package.check()
    (path,) = package.kept
    path.unlink()
    path.mkdir()
    assert package.check().words == COMPILED
    assert package.check().words == LOADED  # kept at home


def test_a_file_that_names_what_is_no_more_is_compiled_again(package):
    """As types have other names in another version: what cannot be read counts as missing."""
    package.check()
    (path,) = package.kept
    script = f"""
import pickle
from pathlib import Path
from pool_sim_ros.physics.kernel_files import _checksum
class Gone: pass
content = pickle.dumps(Gone())
Path({str(path)!r}).write_bytes(_checksum(content) + content)
"""
    assert package.run(script).words == []
    assert package.check().words == COMPILED
    assert package.check().words == LOADED


def test_nobody_is_told_of_a_package_that_is_read_only_but_warm(package):
    """As root has left it, on an image or a file system that nobody can write to."""
    assert package.check().words == COMPILED
    package.env['HOME'] = '/nonexistent'
    package.wrapper = as_stranger() or make_read_only(package)
    assert package.check().words == LOADED
    del package.env['HOME']
    assert package.check().words == LOADED


def make_read_only(package):
    """Take the right to write from everybody; return no wrapper, as for any ordinary user."""
    for folder, _, _ in os.walk(package.folder):
        os.chmod(folder, 0o555)
    return []


@pytest.fixture
def nowhere(package):
    """A package that a stranger uses, who can write nowhere."""
    package.wrapper = as_stranger() or make_read_only(package)
    yield package
    for folder, _, _ in os.walk(package.folder):
        os.chmod(folder, 0o755)


@pytest.mark.parametrize('home', ['missing', *soak('read-only', 'none')])
def test_where_nothing_can_be_kept_one_line_says_so(nowhere, home):
    """As an ordinary user on a package of root's, with a home that is no good, or none."""
    if home == 'missing':
        nowhere.env['HOME'] = '/nonexistent'
    if home == 'none':
        del nowhere.env['HOME']
    for _ in range(2):
        ended = nowhere.check()
        assert ended.words_after_a_notice == COMPILED
        assert str(nowhere.physics / '__pycache__') in ended.stderr
        assert 'Permission denied' in ended.stderr
    assert nowhere.kept == []
    assert not (nowhere.folder / '~').exists()


def test_the_notice_comes_once_in_a_process(nowhere):
    ended = nowhere.run("""
from pool_sim_ros.physics import Ball, Table, two_ball_collision
from pool_sim_ros.physics.validation import first_fault
import numpy as np
table = Table(2.0, 1.0, [Ball('a', 0.1, 0.05, (0.5, 0.5))])
order, radii, boundary = np.array([0]), np.array([0.05]), table.for_kernels.boundary
for positions in (np.zeros((1, 2)), np.zeros((1, 2), order='F'), np.zeros((1, 4))[:, ::2]):
    first_fault(positions, radii, boundary, order)
print(len(first_fault.for_python.overloads))
""")
    assert int(ended.words_after_a_notice[0]) >= 2


def test_a_home_that_can_be_written_to_keeps_what_the_package_cannot(nowhere):
    home = nowhere.folder.parent / f'{nowhere.folder.name}-home'
    home.mkdir()
    if nowhere.wrapper:
        os.chown(home, STRANGER, STRANGER)
    nowhere.env['HOME'] = str(home)
    assert nowhere.check().words == COMPILED
    assert nowhere.check().words == LOADED
    assert nowhere.kept == []
    assert len(list(home.rglob('*.nbc'))) == 1


def test_a_folder_that_the_user_names_is_the_only_one(package):
    named = package.folder / 'named'
    package.env['NUMBA_CACHE_DIR'] = str(named)
    assert package.check().words == COMPILED
    assert package.check().words == LOADED
    assert package.kept == [] and len(list(named.rglob('*.nbc'))) == 1
    package.env['NUMBA_CACHE_DIR'] = str(package.folder / 'other')
    assert package.check().words == COMPILED


def test_a_folder_that_the_user_names_but_cannot_write_to(nowhere):
    named = nowhere.folder / 'named'
    nowhere.env['NUMBA_CACHE_DIR'] = str(named)
    ended = nowhere.check()
    assert ended.words_after_a_notice == COMPILED
    assert str(named) in ended.stderr


def test_files_of_another_user_that_cannot_be_read(package):
    if os.name != 'posix' or os.geteuid() != 0:
        pytest.skip('only root can give files to another user')
    assert package.check().words == COMPILED
    (path,) = package.kept
    for thing in (path, path.parent):
        os.chown(thing, STRANGER, STRANGER)
    path.chmod(0o600)
    path.parent.chmod(0o755)
    package.env['HOME'] = str(path)  # no folder; to root's own user `/nonexistent` would be free
    package.env['NUMBA_CACHE_DIR'] = str(path.parent.parent)
    package.wrapper = without_capabilities()
    assert package.check().words_after_a_notice == COMPILED
    del package.env['NUMBA_CACHE_DIR']
    assert package.check().words_after_a_notice == COMPILED


def test_where_python_keeps_its_own_the_kernels_are_too(package):
    """PYTHONPYCACHEPREFIX says that nothing may be written beside the source."""
    package.env['PYTHONPYCACHEPREFIX'] = str(package.folder / 'elsewhere')
    assert package.check().words == COMPILED
    assert package.check().words == LOADED
    assert not list(package.folder.glob('pool_sim_ros/**/__pycache__'))


def test_a_file_that_cannot_be_written_to_its_end(package):
    """The system itself cuts the writing short, as on a full disk."""
    ended = package.check(
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (9000, 9000))
    )
    assert ended.words_after_a_notice == COMPILED
    assert package.kept == []


def test_a_full_disk(package):
    """A real one: a file system of a few pages, in a mount namespace of its own."""
    disk = package.folder / 'disk'
    disk.mkdir()
    mount = f'mount -t tmpfs -o size=16k none "{disk}" && exec "$@"'
    wrapper = ['unshare', '--mount', 'sh', '-c', mount, 'sh']
    try:
        tried = subprocess.run([*wrapper, 'true'], capture_output=True, text=True)
    except OSError as error:
        pytest.skip(f'needs unshare: {error}')
    if tried.returncode != 0:
        pytest.skip(f'a file system cannot be mounted here: {tried.stderr.strip()}')
    package.wrapper = wrapper
    package.env['NUMBA_CACHE_DIR'] = str(disk)
    ended = package.check()
    assert ended.words_after_a_notice == COMPILED
    assert 'No space left' in ended.stderr


EVERYTHING = """
from numba.core import event
from pool_sim_ros.physics import compile_kernels, report_table, simulate
with event.install_recorder('numba:compile') as recorder:
    compile_kernels(report_table())
    ends = simulate(report_table(), (-4.0, 0.0)).final_positions
print(ends.tobytes().hex(), len(recorder.buffer) > 0)
"""


@pytest.mark.soak
def test_every_kernel_compiled_in_memory_plays_as_one_that_was_kept(nowhere):
    """As an ordinary user without a home, on a package that is read-only."""
    del nowhere.env['HOME']
    ends, compiled = nowhere.run(EVERYTHING).words_after_a_notice
    assert compiled == 'True'
    shot = simulate(report_table(), (-4.0, 0.0))
    assert ends == shot.final_positions.tobytes().hex()


@pytest.mark.soak
def test_processes_that_are_killed_while_others_start_leave_a_sound_cache(package):
    others = [package.start(EVERYTHING) for _ in range(3)]
    while not package.kept:  # they have begun to write
        assert all(process.poll() is None for process in others)
    others[0].kill()
    others[0].communicate()
    told = {process.communicate(timeout=300) for process in others[1:]}
    ((ends, _), errors) = (next(iter(told))[0].split(), {error for _, error in told})
    assert errors == {''} and {stdout.split()[0] for stdout, _ in told} == {ends}
    assert package.run(EVERYTHING).words == [ends, 'False']


def test_processes_that_start_at_once_keep_the_same(package):
    started = [package.start(CHECK.format(x=0.5)) for _ in range(4)]
    for process in started:
        stdout, stderr = process.communicate(timeout=300)
        assert (process.returncode, stderr, stdout.split()[0]) == (0, '', 'inside')
    assert package.check().words == LOADED
    assert len(package.kept) == 1


def test_old_folders_do_not_pile_up(package):
    for k in range(12):
        old = package.physics / '__pycache__' / f'kernels-{k}'
        old.mkdir(parents=True)
        os.utime(old, (k, k))
    package.check()
    folders = list((package.physics / '__pycache__').glob('kernels-*'))
    assert len(folders) == KEPT and package.kept[0].parent in folders


def test_a_zip_archive_plays_too(package):
    """It has no source files, so nothing can be kept."""
    archive = shutil.make_archive(package.folder / 'archive', 'zip', package.folder, 'pool_sim_ros')
    shutil.rmtree(package.folder / 'pool_sim_ros')
    package.env['PYTHONPATH'] = archive
    assert package.check().words_after_a_notice == COMPILED


class Shape(NamedTuple):
    """A type of which the package knows nothing."""

    length: float
    width: float


class Boxed(NamedTuple):
    shape: Shape
    count: int


RECTANGLE, SHAPE = (numba.typeof(kind(2.0, 1.0)) for kind in (Rectangle, Shape))


def test_named_tuples_of_a_type():
    nested = numba.typeof((1.0, Boxed(Shape(1.0, 2.0), 3), (Rectangle(1.0, 2.0),)))
    assert named_tuples(nested) == [Boxed, Shape, Rectangle]
    assert named_tuples(numba.typeof(1.0)) == []


def test_what_others_have_written_is_not_kept():
    """The hash knows nothing of their source, and who reads it may not have their types."""
    codegen = SimpleNamespace(magic_tuple=lambda: ('cpu',))
    name = KernelCache(first_fault.py_func)._file_name
    assert name((RECTANGLE,), codegen).startswith('validation.first_fault-')
    assert name((SHAPE,), codegen) is None
    assert name((RECTANGLE, numba.typeof((1, Shape(1.0, 2.0)))), codegen) is None
    own = kernel(lambda x: x + 1)
    assert own(1) == 2 and own.for_python.stats.cache_path is None


def test_each_kernel_signature_and_processor_has_a_file_of_its_own():
    ours, other = KernelCache(first_fault.py_func), KernelCache(named_tuples)
    one, two = (SimpleNamespace(magic_tuple=lambda cpu=cpu: (cpu,)) for cpu in 'ab')
    number = numba.typeof(1.0)
    names = [
        ours._file_name((RECTANGLE,), one),
        ours._file_name((RECTANGLE,), two),
        ours._file_name((RECTANGLE, number), one),
        other._file_name((RECTANGLE,), one),
    ]
    assert len(set(names)) == 4
    assert names[0] == ours._file_name((RECTANGLE,), one)


def test_numba_asks_it_for_everything():
    """The names that this relies on, in the oldest numba and in the newest."""
    stats = first_fault.for_python.stats
    assert isinstance(first_fault.for_python._cache, KernelCache)
    assert stats.cache_path == first_fault.for_python._cache.cache_path


def test_a_numba_that_keeps_in_another_way_still_compiles(forgetful, caplog):
    unknown = SimpleNamespace(py_func=first_fault.py_func)
    for _ in range(2):
        keep(unknown)
    assert not hasattr(unknown, '_cache')
    (record,) = caplog.records
    assert numba.__version__ in record.getMessage() and '\n' not in record.getMessage()


@pytest.mark.parametrize('method', ['_reduce', *soak('_rebuild')])
def test_a_numba_that_has_lost_a_method_still_compiles(package, method):
    package.check()
    if method == '_reduce':
        shutil.rmtree(package.kept[0].parent)
    script = f"""
from numba.core.compiler import CompileResult
del CompileResult.{method}
"""
    ended = package.run(script + CHECK.format(x=0.5))
    if method == '_reduce':
        assert ended.words_after_a_notice == COMPILED
        assert '_reduce' in ended.stderr
    else:
        assert ended.words == COMPILED


def test_it_says_so_when_balls_that_spin_are_compiled(monkeypatch, tmp_path, caplog):
    """Where nothing is kept; not for discs, nor for who compiles on purpose."""
    monkeypatch.setattr(kernel_cache.config, 'CACHE_DIR', str(tmp_path))
    kernel_cache._files.cache_clear()
    pool, report = (
        (numba.typeof(table.for_kernels),) for table in (pool_table('carom'), report_table())
    )
    load = KernelCache(first_fault.py_func).load_overload
    try:
        with kernel_cache.silence():
            assert load(pool, cpu_target.target_context) is None
        assert load(report, cpu_target.target_context) is None
        assert not caplog.records
        assert load(pool, cpu_target.target_context) is None
    finally:
        kernel_cache._files.cache_clear()
    assert [record.getMessage() for record in caplog.records] == [
        'pool_sim_ros compiles the physics of balls that spin, on the first run only: this takes '
        'about 20 s'
    ]
