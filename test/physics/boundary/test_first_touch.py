"""When a ball first touches something: against a fine search along the path."""

import numpy as np
import pytest
from pocketed_boundaries import (
    NAMES,
    boundary_of,
    first_met,
    looked_at_whole,
    paths,
    search,
)

from pool_sim_ros.physics.boundary import (
    FIRST_CUSHION,
    PHASE_END,
    n_cushions,
)


@pytest.mark.parametrize('name', NAMES)
def test_what_is_not_looked_at_is_never_met_first(name):
    """With the inner rectangle and the surroundings of pockets, and without: the same answers."""
    boundary, radius = boundary_of(name)
    without = looked_at_whole(boundary)
    met = np.zeros(3)
    for path in paths(np.random.default_rng(1), boundary, radius, 8000):
        seconds, partner = first_met(boundary, path, radius)
        expected, expected_partner = first_met(without, path, radius)
        assert partner == expected_partner, path
        assert seconds == pytest.approx(expected, rel=1e-9, abs=1e-12)
        number = FIRST_CUSHION - partner
        met[0 if partner == PHASE_END else 1 if number < n_cushions(boundary) else 2] += 1
    assert (met > 200).all(), met


@pytest.mark.parametrize('name', NAMES)
@pytest.mark.parametrize('count', [150, pytest.param(1500, marks=pytest.mark.soak)])
def test_what_a_path_meets_first_equals_a_fine_search(name, count):
    boundary, radius = boundary_of(name)
    k, p = len(boundary.segments), len(boundary.noses)
    met, skipped = set(), 0
    for path in paths(np.random.default_rng(2), boundary, radius, count):
        expected = search(boundary, path, radius)
        if expected is None:
            skipped += 1
            continue
        seconds, partner = first_met(boundary, path, radius)
        assert partner == expected[1], path
        assert seconds == pytest.approx(expected[0], abs=1e-9)
        if partner != PHASE_END:
            number = FIRST_CUSHION - partner
            met.add('segment' if number < k else 'nose' if number < k + p else 'pocket')
    assert met == {'segment', 'nose', 'pocket'} and skipped < count / 2
