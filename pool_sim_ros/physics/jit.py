"""How the compiled functions of this package are compiled."""

import numpy as np
from numba import njit

OPTIONS = {'cache': True, 'error_model': 'numpy', 'nogil': True, '_nrt': False}
"""Keep what was compiled; divide as numpy does; let other threads run meanwhile. Never `fastmath`:
results are promised bit for bit.

Kernels allocate nothing and keep no arrays, so numba's reference counts, which cost the event loop
half its time, are switched off; an allocation in a kernel does not compile.
"""

kernel = njit(**OPTIONS)
"""Compile a function that Python calls, or that is long or rarely called."""

inlined = njit(**OPTIONS, forceinline=True)
"""Compile a function into those that call it: passing arrays to it would cost more than it does."""

NONE = np.int64(0)
"""How many there are to begin with. Not a literal: for each of those a kernel is compiled anew."""
