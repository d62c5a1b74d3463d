"""Why a region was not played or written, in words."""

from __future__ import annotations

import errno

from pool_sim_ros.study.store import Store

GO_ON = 'what is written stays: the same call goes on from there'


def failure(error: BaseException | None, store: Store) -> str:
    """Return in words why a region was not played or written."""
    why = f'{type(error).__name__}: {" ".join(str(error).split())}'
    if isinstance(error, OSError) and error.errno in (errno.ENOSPC, errno.EDQUOT):
        return f'out: the disk of {store.path} is full'
    if isinstance(error, OSError):
        return f'out: {store.path} cannot be written: {error.strerror or why}'
    if type(error).__name__ == 'KilledWorker':
        return 'workers: several died in the same region, as they do without memory'
    if isinstance(error, ModuleNotFoundError):
        return f'workers: one of them lacks {error.name}; install the same packages everywhere'
    return why
