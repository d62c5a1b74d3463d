"""How the compiled functions of this package are compiled."""

from numba import njit

kernel = njit(cache=True, error_model='numpy', nogil=True)
"""Compile once and keep it; divide as numpy does; let other threads run meanwhile.

Never `fastmath`: results are promised bit for bit.
"""
