"""Chunks that zarr reads, and that are whole."""

import errno
from pathlib import Path

import numpy as np
import pytest
import zarr

from pool_sim_ros.study.chunk_files import CODEC, write_chunk


@pytest.mark.parametrize('codec', [CODEC, None])
@pytest.mark.parametrize('dtype', ['f8', 'i4', 'i2', 'i1', 'u1'])
def test_zarr_reads_what_was_written(tmp_path, dtype, codec):
    array = zarr.create_array(
        tmp_path / 'a', shape=(6, 4), chunks=(3, 4), dtype=dtype, compressors=codec
    )
    values = np.random.default_rng(1).integers(0, 100, (3, 4))
    write_chunk(array, tmp_path / 'a', (1, 0), values)
    np.testing.assert_array_equal(zarr.open_array(tmp_path / 'a')[3:], values)
    assert (array[:3] == 0).all()


def test_a_full_disk_leaves_what_was_there(tmp_path, monkeypatch):
    array = zarr.create_array(
        tmp_path / 'a', shape=(4,), chunks=(4,), dtype='f8', compressors=CODEC
    )
    write_chunk(array, tmp_path / 'a', (0,), np.arange(4.0))

    def full(path, content):
        with open(path, 'wb') as file:
            file.write(content[:5])
        raise OSError(errno.ENOSPC, 'No space left on device')

    monkeypatch.setattr(Path, 'write_bytes', full)
    with pytest.raises(OSError, match='No space'):
        write_chunk(array, tmp_path / 'a', (0,), np.zeros(4))
    monkeypatch.undo()
    np.testing.assert_array_equal(zarr.open_array(tmp_path / 'a')[:], np.arange(4.0))
    assert not list(tmp_path.rglob('*.partial'))
