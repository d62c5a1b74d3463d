"""Checks of single values, with messages that name what was wrong and what would be right."""

import math


def number(
    name: str,
    value: object,
    least: float = -math.inf,
    most: float = math.inf,
    above: float = -math.inf,
) -> float:
    """Return `value` as a float; raise ValueError, naming it, where it is no number in range."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise ValueError(f'{name}: {value!r} is not a number') from None
    if not math.isfinite(number):
        raise ValueError(f'{name}: {number} is not finite')
    if number <= above:
        raise ValueError(f'{name}: {number} must be above {above:g}')
    if number < least:
        raise ValueError(f'{name}: {number} must be at least {least:g}')
    if number > most:
        raise ValueError(f'{name}: {number} must be at most {most:g}')
    return number


def numbers(
    name: str, values: object, count: int, least: float = -math.inf, most: float = math.inf
) -> tuple[float, ...]:
    """Return `values` as floats; raise ValueError where they are not `count` numbers in range."""
    try:
        items = tuple(values)
    except TypeError:
        items = ()
    if isinstance(values, str) or len(items) != count:
        raise ValueError(f'{name}: {values!r} must be {count} numbers')
    return tuple(number(name, item, least, most) for item in items)
