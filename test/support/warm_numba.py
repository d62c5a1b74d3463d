"""Loads numba and compiles for the first time, which takes a second before any kernel is there."""

import numba

numba.njit(lambda: 1)()
