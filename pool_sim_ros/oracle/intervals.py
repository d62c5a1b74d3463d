"""How sure a chance is that was counted."""

from __future__ import annotations

import math
from statistics import NormalDist

Z = NormalDist().inv_cdf(0.975)
"""Standard deviations on either side that hold 95 %."""


def wilson(successes: int, count: int) -> tuple[float, float]:
    """Return the 95 % interval of a chance (Wilson 1927), from so many successes of `count`."""
    share, weight = successes / count, Z * Z / count
    middle = (share + 0.5 * weight) / (1.0 + weight)
    half = Z * math.sqrt(share * (1.0 - share) / count + 0.25 * weight / count) / (1.0 + weight)
    # Rounding must not leave out a share of 0 or 1.
    low = 0.0 if successes == 0 else max(middle - half, 0.0)
    high = 1.0 if successes == count else min(middle + half, 1.0)
    return low, high
