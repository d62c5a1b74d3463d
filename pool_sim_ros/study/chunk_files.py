"""Writes whole chunks of zarr arrays as files, at once or not at all.

zarr hands each chunk to an event loop and to two threads, which takes longer than its compression.
"""

from __future__ import annotations

import uuid
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.extras import needs

with needs('a sweep', 'study'):
    from numcodecs import Blosc
    from zarr.codecs import BloscCodec

CODEC = BloscCodec(cname='lz4', clevel=3, shuffle='noshuffle', typesize=8)
"""Most balls rest where they were, which LZ4 finds as it is. Shuffled bytes would be larger, and
take four times as long."""

_BLOSC = Blosc(cname='lz4', clevel=3, shuffle=Blosc.NOSHUFFLE)


def write_chunk(array: Any, folder: Path, place: tuple[int, ...], values: NDArray[Any]) -> None:
    """Write one whole chunk.

    Parameters
    ----------
    array : zarr.Array
        Compressed by `CODEC`, or not at all.
    folder : Path
        That of the array.
    place : tuple of int
        Of the chunk among all, along each dimension.
    values : ndarray
        All of the chunk, in its order.

    Raises
    ------
    OSError
        Where the file cannot be written; then what was there is still there.
    """
    dtype = np.dtype(array.dtype).newbyteorder('<')
    values = np.ascontiguousarray(values, dtype)
    content = _BLOSC.encode(values) if array.compressors else values.tobytes()
    file = folder / array.metadata.encode_chunk_key(place)
    file.parent.mkdir(parents=True, exist_ok=True)
    half = file.with_name(f'{file.name}.{uuid.uuid4().hex}.partial')
    try:
        half.write_bytes(content)
        half.replace(file)
    except OSError:
        half.unlink(missing_ok=True)
        raise
