"""How far a ball is from its path."""

import numpy as np


def distance_to_way(points, place):
    """Return the distance of a place from the line through points, all in m."""
    starts, steps = np.array(points[:-1]), np.diff(points, axis=0)
    part = np.clip(np.sum((place - starts) * steps, axis=1) / np.sum(steps**2, axis=1), 0, 1)
    return np.hypot(*(place - starts - part[:, np.newaxis] * steps).T).min()
