"""Fixtures for tests that compile kernels for types of their own."""

import pytest
from numba.core.caching import Cache


@pytest.fixture(scope='module')
def nothing_cached():
    """Keep what is compiled in this process: the cache's index would name the test's own types.

    Whoever reads it without these types, such as a node that another test starts, cannot load it.
    """
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Cache, 'save_overload', lambda *_: None)
        yield
