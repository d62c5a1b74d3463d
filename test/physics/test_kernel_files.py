"""Files that may be missing, damaged or read-only, in folders that may be too."""

import errno
import os
import threading
from pathlib import Path

import pytest

from pool_sim_ros.physics import kernel_files
from pool_sim_ros.physics.kernel_files import DIGEST, KEPT, PREFIX, KernelFiles

CONTENT = bytes(range(256)) * 10


@pytest.fixture
def files(tmp_path):
    return KernelFiles([tmp_path / 'first', tmp_path / 'second'], 'key')


def all_files(folder):
    return [path for path in folder.rglob('*') if path.is_file()]


def test_what_is_written_is_read(files, tmp_path):
    assert files.read('a') is None
    files.write('a', CONTENT)
    files.write('b', b'')
    assert files.read('a') == CONTENT and files.read('b') == b''
    assert files.read('c') is None
    assert Path(files.folder) == tmp_path / 'first' / 'kernels-key'
    assert KernelFiles([tmp_path / 'first'], 'key').read('a') == CONTENT
    assert KernelFiles([tmp_path / 'first'], 'other').read('a') is None
    assert len(all_files(tmp_path)) == 2


def test_every_folder_is_read(tmp_path):
    KernelFiles([tmp_path / 'second'], 'key').write('a', CONTENT)
    assert KernelFiles([tmp_path / 'first', tmp_path / 'second'], 'key').read('a') == CONTENT


@pytest.mark.parametrize(
    'damage',
    [
        lambda whole: b'',
        lambda whole: whole[:5],
        lambda whole: whole[:DIGEST],
        lambda whole: whole[:-1],
        lambda whole: whole + b' ',
        lambda whole: bytes(len(whole)),
        lambda whole: whole[:100] + bytes([whole[100] ^ 1]) + whole[101:],
        lambda whole: os.urandom(len(whole)),
    ],
)
def test_a_damaged_file_counts_as_missing_and_is_written_anew(files, tmp_path, damage):
    files.write('a', CONTENT)
    (path,) = all_files(tmp_path)
    path.write_bytes(damage(path.read_bytes()))
    assert files.read('a') is None
    files.write('a', CONTENT)
    assert files.read('a') == CONTENT and all_files(tmp_path) == [path]


def test_behind_a_damaged_file_another_one_is_found(files, tmp_path):
    KernelFiles([tmp_path / 'second'], 'key').write('a', CONTENT)
    files.write('a', CONTENT)
    (tmp_path / 'first' / 'kernels-key' / 'a').write_bytes(b'')
    assert files.read('a') == CONTENT


def test_the_next_folder_takes_what_the_first_cannot(tmp_path):
    (tmp_path / 'first').write_text('no folder')
    files = KernelFiles([tmp_path / 'first', tmp_path / 'second'], 'key')
    files.write('a', CONTENT)
    assert files.read('a') == CONTENT
    assert (tmp_path / 'second' / 'kernels-key' / 'a').exists()


def test_where_no_folder_can_take_it_the_error_says_why(tmp_path):
    (tmp_path / 'first').write_text('no folder')
    files = KernelFiles([tmp_path / 'first', tmp_path / 'first'], 'key')
    with pytest.raises(OSError, match='first: .*; .*first: ') as raised:
        files.write('a', CONTENT)
    assert '\n' not in str(raised.value)
    assert files.read('a') is None
    with pytest.raises(OSError, match='no folder'):
        KernelFiles([], 'key').write('a', CONTENT)
    assert KernelFiles([], 'key').folder is None


@pytest.mark.parametrize('call', ['write_bytes', 'replace'])
@pytest.mark.parametrize('code', [errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EIO])
def test_a_full_disk_leaves_nothing_behind(files, tmp_path, monkeypatch, code, call):
    def fail(path, *_):
        if call == 'write_bytes':
            Path(path).touch()
        raise OSError(code, os.strerror(code))

    owner = Path if call == 'write_bytes' else kernel_files.os
    monkeypatch.setattr(owner, call, fail)
    with pytest.raises(OSError, match=os.strerror(code)):
        files.write('a', CONTENT)
    assert all_files(tmp_path) == []


def test_others_may_read_what_one_has_written(files, tmp_path):
    old = os.umask(0o022)
    try:
        files.write('a', CONTENT)
    finally:
        os.umask(old)
    (path,) = all_files(tmp_path)
    assert path.stat().st_mode & 0o777 == 0o644
    assert path.parent.stat().st_mode & 0o777 == 0o755


def test_readers_see_a_file_whole_or_not_at_all(tmp_path):
    """While several write the same one."""
    contents = {bytes([k]) * 200_000 for k in range(4)}
    seen, stop = set(), threading.Event()

    def write(content):
        mine = KernelFiles([tmp_path], 'key')
        while not stop.is_set():
            mine.write('a', content)

    writers = [threading.Thread(target=write, args=(content,)) for content in contents]
    for writer in writers:
        writer.start()
    reader = KernelFiles([tmp_path], 'key')
    for _ in range(300):
        seen.add(reader.read('a'))
    stop.set()
    for writer in writers:
        writer.join()
    assert reader.read('a') in contents
    assert seen - {None} <= contents
    assert len(all_files(tmp_path)) == 1


def keys_in(folder):
    return {path.name.removeprefix(PREFIX) for path in folder.glob(f'{PREFIX}*')}


def test_only_the_last_used_keys_stay(tmp_path):
    other = tmp_path / 'not-ours'
    other.mkdir()
    for k in range(9):
        KernelFiles([tmp_path], f'k{k}').write('a', CONTENT)
        os.utime(tmp_path / f'{PREFIX}k{k}', (k, k))
    assert keys_in(tmp_path) == {f'k{k}' for k in range(9 - KEPT, 9)}
    KernelFiles([tmp_path], 'k4').read('a')  # used: it is no longer the oldest
    KernelFiles([tmp_path], 'new').write('a', CONTENT)
    assert keys_in(tmp_path) == {'new', 'k4', 'k6', 'k7', 'k8'}
    assert other.exists()


def test_a_key_that_was_removed_meanwhile_is_made_again(files, tmp_path):
    files.write('a', CONTENT)
    for path in all_files(tmp_path):
        path.unlink()
        path.parent.rmdir()
    assert files.read('a') is None
    files.write('a', CONTENT)
    assert files.read('a') == CONTENT
