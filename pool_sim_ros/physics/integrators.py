"""The two integrators by name; light, for those that only name them."""

from typing import Literal, get_args

Integrator = Literal['event', 'time_slice']
"""An integrator by its name: the exact one, or the report's."""
INTEGRATORS: tuple[Integrator, ...] = get_args(Integrator)
"""Both of them."""

REPORT_TIME_SLICE = 1e-6
"""The report's slice in s (Listing 2)."""
