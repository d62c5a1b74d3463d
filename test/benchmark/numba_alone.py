"""The least that a process with numba takes: one cached function of one line."""

import numba


@numba.njit(cache=True)
def add_one(x):
    return x + 1


add_one(1)
