"""`Goal`: what a shot is to do."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Any

FORMS = (
    ('ball', 'to', 'within'),
    ('ball', 'rectangle'),
    ('ball', 'pocket'),
    ('cue_to', 'within'),
    ('first_hit',),
    ('touches',),
    ('avoid',),
    ('keep',),
    ('all',),
)
"""The keywords that go together."""

MOST_PARTS = 100
"""Goals that may be joined, and how deep: more is a mistake."""


@dataclass(frozen=True)
class Goal:
    """What a shot is to do: one of these, or several joined with ``&``.

    Parameters
    ----------
    ball : str, optional
        Label of the ball that is to end somewhere: with `to` and `within`, `rectangle` or `pocket`.
    to : (float, float), optional
        Point on the cloth, m. A ball in a pocket is nowhere on the cloth.
    within : float, optional
        Greatest distance of the ball's centre from the point, m; above 0.
    rectangle : (float, float, float, float), optional
        x0, y0, x1, y1 with x0 < x1 and y0 < y1, m: the ball's centre ends in it.
    pocket : int or 'any', optional
        Number of the pocket that catches the ball.
    cue_to : (float, float), optional
        Point within `within` of which the cue ball ends, m.
    first_hit : str, optional
        Label of the ball that the cue ball touches first.
    touches, avoid : str, optional
        Label of a ball that the cue ball touches at some time, or never.
    keep : str, optional
        Label of a ball that no pocket catches.
    all : iterable of Goal or dict, optional
        Goals that are all to be met.

    Raises
    ------
    ValueError
        For keywords that do not go together, and a value of the wrong kind; names it.

    Examples
    --------
    >>> goal = Goal(ball='9', pocket='any') & Goal(keep='C')
    >>> [part.fields() for part in goal.parts]
    [{'ball': '9', 'pocket': 'any'}, {'keep': 'C'}]
    """

    ball: str | None = None
    to: tuple[float, float] | None = None
    within: float | None = None
    rectangle: tuple[float, float, float, float] | None = None
    pocket: int | str | None = None
    cue_to: tuple[float, float] | None = None
    first_hit: str | None = None
    touches: str | None = None
    avoid: str | None = None
    keep: str | None = None
    all: tuple[Goal, ...] | None = None

    def __post_init__(self) -> None:
        given = tuple(f.name for f in fields(self) if getattr(self, f.name) is not None)
        if set(given) not in map(set, FORMS):
            forms = '; '.join(', '.join(form) for form in FORMS)
            shown = ', '.join(given) or 'nothing'
            raise ValueError(f'goal: {shown} is no goal; the keywords that go together are {forms}')
        for name in given:
            object.__setattr__(self, name, CHECKS[name](f'goal: {name}', getattr(self, name)))

    def __and__(self, other: Goal) -> Goal:
        if not isinstance(other, Goal):
            return NotImplemented
        return Goal(all=self.parts + other.parts)

    @property
    def parts(self) -> tuple[Goal, ...]:
        """The simple goals that it consists of."""
        return (self,) if self.all is None else sum((goal.parts for goal in self.all), ())

    def fields(self) -> dict[str, Any]:
        """Return the keywords and their values, as JSON has them."""
        given: dict[str, Any] = {}
        for field in fields(self):
            value = getattr(self, field.name)
            if field.name == 'all' and value is not None:
                value = [goal.fields() for goal in value]
            if value is not None:
                given[field.name] = list(value) if isinstance(value, tuple) else value
        return given


def goal_of(given: Any, depth: int = 0) -> Goal:
    """Return a goal from itself or its fields; raise ValueError for something else."""
    if isinstance(given, Goal):
        return given
    if not isinstance(given, dict):
        raise ValueError(f'goal: {short(given)} must be a Goal or its fields')
    known = [field.name for field in fields(Goal)]
    for name in given:
        if name not in known:
            raise ValueError(f'goal: {short(name)} is none of {", ".join(known)}')
    if depth > MOST_PARTS:
        raise ValueError(f'goal: all: more than {MOST_PARTS} within one another')
    if isinstance(given.get('all'), (list, tuple)):
        given = given | {'all': [goal_of(goal, depth + 1) for goal in given['all']]}
    return Goal(**given)


def short(value: object) -> str:
    """Return a value as a message shows it, on one line."""
    text = ' '.join(repr(value).split())
    return text if len(text) <= 80 else f'{text[:77]}...'


def label(name: str, value: object) -> str:
    """Return a label of a ball."""
    if not isinstance(value, str) or not value:
        raise ValueError(f"{name}: {short(value)} must be the label of a ball, such as '9'")
    return value


def number(name: str, value: Any) -> float:
    """Return a finite number."""
    try:
        if isinstance(value, (str, bytes, bool)):
            raise TypeError
        result = float(value)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f'{name}: {short(value)} is not a number') from None
    if not math.isfinite(result):
        raise ValueError(f'{name}: {result} is not finite')
    return result


def numbers(name: str, value: Any, count: int) -> tuple[float, ...]:
    """Return so many finite numbers."""
    try:
        items = () if isinstance(value, (str, bytes, dict)) else tuple(value)
    except TypeError:
        items = ()
    if len(items) != count:
        raise ValueError(f'{name}: {short(value)} must be {count} numbers')
    return tuple(number(name, item) for item in items)


def point(name: str, value: object) -> tuple[float, ...]:
    """Return a point, m."""
    return numbers(name, value, 2)


def distance(name: str, value: object) -> float:
    """Return a distance above 0, m."""
    result = number(name, value)
    if result <= 0.0:
        raise ValueError(f'{name}: {result:g} must be above 0')
    return result


def area(name: str, value: object) -> tuple[float, ...]:
    """Return a rectangle that is not empty, m."""
    x0, y0, x1, y1 = numbers(name, value, 4)
    if not (x0 < x1 and y0 < y1):
        raise ValueError(
            f'{name}: ({x0:g}, {y0:g}, {x1:g}, {y1:g}) is empty; x0, y0, x1, y1 need x0 < x1 and '
            'y0 < y1'
        )
    return x0, y0, x1, y1


def pocket(name: str, value: Any) -> int | str:
    """Return the number of a pocket, or 'any'."""
    if isinstance(value, str) and value == 'any':
        return 'any'
    whole = not isinstance(value, bool) and hasattr(value, '__index__')
    if not whole or value.__index__() < 0:
        raise ValueError(f"{name}: {short(value)} must be the number of a pocket, or 'any'")
    return int(value)


def several(name: str, value: Any) -> tuple[Goal, ...]:
    """Return goals, at least one."""
    if isinstance(value, (str, dict, Goal)) or not hasattr(value, '__iter__'):
        raise ValueError(f'{name}: {short(value)} must be a list of goals')
    goals = tuple(goal_of(goal) for goal in value)
    count = sum(len(goal.parts) for goal in goals)
    if not 1 <= count <= MOST_PARTS:
        raise ValueError(f'{name}: {count} goals must be at least 1 and at most {MOST_PARTS}')
    return goals


CHECKS: dict[str, Any] = {
    'ball': label,
    'to': point,
    'within': distance,
    'rectangle': area,
    'pocket': pocket,
    'cue_to': point,
    'first_hit': label,
    'touches': label,
    'avoid': label,
    'keep': label,
    'all': several,
}
