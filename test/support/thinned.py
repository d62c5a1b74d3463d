"""Cases of which some run always, and all with `-m soak`."""

import itertools

import pytest


def soak(*cases):
    """Return cases that run in the soak alone."""
    return [
        pytest.param(*(case if isinstance(case, tuple) else [case]), marks=pytest.mark.soak)
        for case in cases
    ]


def every(step, *lists):
    """Return all combinations of values; one in so many runs always, the others in the soak.

    Those are spread so that each value of a list is among them, where another list has at least as
    many values as the step.
    """
    combinations = itertools.product(*map(enumerate, lists))
    return [
        pytest.param(
            *(value for _, value in combination),
            marks=() if sum(k for k, _ in combination) % step == 0 else pytest.mark.soak,
        )
        for combination in combinations
    ]
