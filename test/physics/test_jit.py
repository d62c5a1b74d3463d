"""An implementation is chosen by the type of a named tuple, in Python and in compiled code."""

import threading
from typing import NamedTuple

import numpy as np
import pytest
from numba import config, njit, typeof
from numba.core.errors import TypingError

from pool_sim_ros.physics.jit import (
    NONE,
    OPTIONS,
    Kernel,
    call_directly,
    chosen_by,
    for_kernels,
    inlined,
    kernel,
    register,
)


class Square(NamedTuple):
    side: float


class Circle(NamedTuple):
    radius: float


class Blob(NamedTuple):
    side: float


@chosen_by('shape')
def area(factor, shape):
    """Return the area of a shape, m^2, so many times."""
    raise NotImplementedError


@chosen_by('shape')
def grow(shape, record):
    """Add a shape's size to a record."""
    raise NotImplementedError


def square_area(factor, shape):
    return factor * shape.side * shape.side


@kernel
def circle_area(factor, shape):
    return factor * 3.0 * shape.radius * shape.radius


def grow_square(shape, record):
    record.size += shape.side


def grow_circle(shape, record):
    record.size += 2.0 * shape.radius
    record.count += 1


register(area, Square, square_area)
register(area, Circle, circle_area)  # a compiled one too
register(grow, Square, grow_square)
register(grow, Circle, grow_circle)


@njit
def compiled_area(factor, shape):
    return area(factor, shape)


@njit
def both(one, other):
    return area(1.0, one) + area(1.0, other)


@njit
def grow_first(shape, records):
    grow(shape, records[0])


@pytest.mark.parametrize('call', [area, compiled_area])
def test_the_type_chooses(call):
    assert call(2.0, Square(3.0)) == 18.0
    assert call(2.0, Circle(3.0)) == 54.0


def test_one_kernel_may_use_both():
    assert both(Square(2.0), Circle(1.0)) == 7.0
    assert both(Circle(1.0), Square(2.0)) == 7.0


def test_a_record_is_changed_in_place():
    records = np.zeros(1, [('size', 'f8'), ('count', 'i8')])
    grow_first(Square(2.0), records)
    grow_first(Circle(2.0), records)
    assert records.tolist() == [(6.0, 1)]


def test_a_type_that_nobody_registered():
    """Also one with the same fields as another."""
    for shape in (Blob(1.0), (1.0,), 1.0):
        with pytest.raises(TypingError):
            compiled_area(1.0, shape)
        with pytest.raises(KeyError):
            area(1.0, shape)


def test_it_looks_like_what_was_declared():
    assert area.__name__ == 'area' and area.__doc__.startswith('Return the area')


def test_an_implementation_may_be_added_later():
    class Late(NamedTuple):
        side: float

    register(area, Late, lambda factor, shape: -factor)

    @njit
    def late(shape):
        return area(1.0, shape)

    assert late(Late(1.0)) == -1.0
    assert area(1.0, Square(1.0)) == 1.0


@pytest.mark.parametrize('decorate', [kernel, inlined])
def test_kernels_divide_as_numpy_and_allocate_nothing(decorate):
    @decorate
    def divide(a, b):
        return a / b

    assert divide(1.0, 0.0) == np.inf and np.isnan(divide(0.0, 0.0))

    @decorate
    def allocate(n):
        return np.zeros(n)[0]

    with pytest.raises(Exception, match=r'NRT|allocate|meminfo|nrt'):
        allocate(3)
    assert not OPTIONS['_nrt'] and 'fastmath' not in OPTIONS


@pytest.mark.parametrize('decorate', [kernel, inlined])
def test_python_and_compiled_functions_call_the_same_kernel(decorate):
    """Each gets machine code of its own; that of Python alone can take Python's arguments apart."""

    @decorate
    def triple(shape):
        """Return three sides."""
        return 3.0 * shape.side

    @njit
    def call(shape):
        return triple(shape) + 0.5

    for _ in range(2):
        assert call(Square(2.0)) == 6.5
        assert triple(Square(2.0)) == 6.0
    assert triple.py_func(Square(1.0)) == 3.0
    assert triple.__name__ == 'triple' and triple.__doc__ == 'Return three sides.'


@pytest.mark.parametrize('decorate', [kernel, inlined])
def test_where_numba_compiles_nothing_a_kernel_is_python(monkeypatch, decorate):
    monkeypatch.setattr(config, 'DISABLE_JIT', 1)

    @decorate
    def double_all(records, factor):
        """Return the sum."""
        for k in range(len(records)):
            records[k].width *= 2.0
        return sum(records.width) / factor

    assert not isinstance(double_all, Kernel) and double_all.__doc__ == 'Return the sum.'
    records = np.ones(3, [('width', 'f8')])
    assert double_all(records, np.float64(0.0)) == np.inf
    assert call_directly(double_all, Square, records, 2.0) == 6.0
    assert call_directly(double_all, Square, records, 2.0) == 12.0
    assert records['width'].tolist() == [8.0] * 3


def test_threads_that_call_first_at_once_share_one_compilation():
    for _ in range(50):
        double = kernel(lambda x: 2.0 * x)
        meeting, made = threading.Barrier(4, timeout=60.0), set()

        def call(double=double, meeting=meeting, made=made):
            meeting.wait()
            made.add(double.for_python)

        callers = [threading.Thread(target=call) for _ in range(4)]
        for caller in callers:
            caller.start()
        for caller in callers:
            caller.join()
        assert made == {double.for_python}


def test_none_is_no_literal():
    """A literal 0 and a count would be two types: two copies of each kernel."""
    seen = kernel(lambda count: count)
    for count in (NONE, 3, np.int64(4)):
        seen(count)
    assert len(seen.for_python.signatures) == 1


def test_a_direct_call_returns_what_the_call_does():
    """The first compiles, the others go to the machine code."""

    @kernel
    def fill(values, pair):
        values[0] += pair[0] * pair[1]
        return values[0], len(values)

    values = np.zeros(3)
    for k in range(1, 4):
        assert call_directly(fill, Square, values, (2.0, 3)) == (6.0 * k, 3)
    assert len(fill.for_python.signatures) == 1
    assert call_directly(fill, Circle, np.zeros(2, np.float32), (2.0, 3)) == (6.0, 2)
    assert len(fill.for_python.signatures) == 2


def test_an_exception_of_a_direct_call_is_raised():
    @kernel
    def check(value):
        if value < 0:
            raise ValueError('negative')
        return value

    for _ in range(2):
        assert call_directly(check, Square, 2.0) == 2.0
        with pytest.raises(ValueError, match='negative'):
            call_directly(check, Square, -2.0)


@pytest.mark.parametrize(
    'array',
    [
        np.ones((3, 2)),
        np.ones((2, 3)).T,
        np.ones((3, 4))[:, ::2],
        np.frombuffer(np.ones(6).tobytes()).reshape(3, 2),
        np.broadcast_to(1.0, (3, 2)),
    ],
    ids=['usual', 'transposed', 'strided', 'read-only', 'broadcast'],
)
def test_arrays_of_any_layout_are_one_type_to_a_kernel(array):
    given = for_kernels(array)
    assert typeof(given) == typeof(np.ones((1, 1))) and np.array_equal(given, array)
    assert (given is array) == (typeof(array) == typeof(given))
