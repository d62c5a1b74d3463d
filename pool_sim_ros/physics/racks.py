"""Racks: the balls of a game where they lie before the break.

The head spot is at three quarters of the length, the foot spot at one quarter: the break goes
towards x = 0, as the shots of the report do.
"""

from __future__ import annotations

import itertools
import math
from typing import Literal, NamedTuple, get_args

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.physics.balls import Ball
from pool_sim_ros.physics.table import Table
from pool_sim_ros.physics.tolerances import OVERLAP
from pool_sim_ros.physics.validation import number, whole_number

RackKind = Literal['triangle', 'eight_ball', 'nine_ball', 'ten_ball', 'snooker', 'carom']
"""The name of a rack, as `rack` takes it."""
RACKS: tuple[RackKind, ...] = get_args(RackKind)

Point = tuple[float, float]
Color = tuple[float, float, float]

SPACING = 1e-4
"""Mean gap of balls that are racked by hand, m: a tenth of a millimetre."""

HEAD, FOOT = 0.75, 0.25
"""Where head and foot spot are, as parts of the length."""

JITTER = 0.45
"""How far each ball lies from its place at most, as a part of the spacing: less than half, so that
two neighbours never overlap."""

ROUNDING = 1e-12
"""Jitter as a part of the radius below which it is not told from rounding."""

STRETCHES = 4
"""Corrections of the pitch of a rack. Each leaves a part of the error that is about jitter over
radius, so that four reach rounding."""

EIGHT_BALL_ROWS = ((1,), (9, 2), (10, 8, 3), (11, 4, 12, 5), (6, 13, 7, 14, 15))
NINE_BALL_ROWS = ((1,), (2, 3), (4, 9, 5), (6, 7), (8,))
TEN_BALL_ROWS = ((1,), (2, 3), (4, 10, 5), (6, 7, 8, 9))
"""Numbers from the foot spot away. The 8, 9 or 10 lies in the middle; of the corners of the
triangle one is solid, one a stripe (WPA's rules)."""

SNOOKER_LENGTH = 140.5
SNOOKER_BAULK, SNOOKER_D, SNOOKER_BLACK = (
    inches / SNOOKER_LENGTH for inches in (29.0, 11.5, 12.75)
)
"""Baulk line and black spot from their cushions, radius of the D, as parts of the length (WPBSA: of
11 feet 8 1/2 inches)."""

CAROM_ASIDE = 0.1825 / 2.84
"""How far from the head spot the first player's ball lies, as a part of the length (UMB)."""

WHITE = (1.0, 1.0, 1.0)
COLORS: tuple[Color, ...] = (
    (1.0, 1.0, 0.0),
    (0.0, 0.0, 1.0),
    (1.0, 0.0, 0.0),
    (0.5, 0.0, 0.5),
    (1.0, 0.5, 0.0),
    (0.0, 0.5, 0.0),
    (0.5, 0.0, 0.0),
    (0.0, 0.0, 0.0),
)
"""Of the balls 1 to 8; 9 to 15 have those of 1 to 7 again."""

SNOOKER_COLORS: dict[str, Color] = {
    'yellow': (1.0, 1.0, 0.0),
    'green': (0.0, 0.5, 0.0),
    'brown': (0.5, 0.25, 0.0),
    'blue': (0.0, 0.0, 1.0),
    'pink': (1.0, 0.5, 0.75),
    'black': (0.0, 0.0, 0.0),
}


class Place(NamedTuple):
    """Where a ball lies, m, and what it looks like."""

    label: str
    position: Point
    color: Color


def rack(
    table: Table, kind: RackKind, spacing: float = SPACING, seed: int | None = None
) -> tuple[Ball, ...]:
    """Return the balls of a game, racked; the cue ball, 'C', is the first.

    They have the radius and the mass of the first ball of the table.

    Parameters
    ----------
    table : Table
    kind : {'triangle', 'eight_ball', 'nine_ball', 'ten_ball', 'snooker', 'carom'}
        'triangle' is 'eight_ball'. The cue ball lies on the head spot; in snooker between the spots
        of brown and yellow, in carom beside the head spot.
    spacing : float, optional
        Mean gap of the neighbours in the rack, m; 0 for balls that touch.
    seed : int, optional
        Balls lie a little, less than half the spacing, away from their places; the same seed gives
        the same rack. None: each gap is equal.

    Returns
    -------
    tuple of Ball

    Raises
    ------
    ValueError
        Where there is no such rack, or it does not fit on the table.
    """
    radius, mass = table.balls[0].radius, table.balls[0].mass
    places = rack_places(kind, table.length, table.width, radius, spacing, seed)
    return tuple(
        Ball(place.label, mass, radius, place.position, place.color, is_cue=k == 0)
        for k, place in enumerate(places)
    )


def rack_places(
    kind: RackKind,
    length: float,
    width: float,
    radius: float,
    spacing: float = SPACING,
    seed: int | None = None,
) -> list[Place]:
    """Return where the balls of `rack` lie on a table of `length` and `width`, m."""
    if kind not in RACKS:
        known = ', '.join(repr(each) for each in RACKS)
        raise ValueError(f'kind: {kind!r} is no rack; there are {known}')
    spacing = number('spacing', spacing, least=0.0)
    rng = None if seed is None else np.random.default_rng(whole_number('seed', seed, 0))
    middle = width / 2.0
    if kind == 'snooker':
        places = _snooker(length, middle, radius, spacing, rng)
    elif kind == 'carom':
        places = [
            Place('C', (HEAD * length, middle - CAROM_ASIDE * length), WHITE),
            Place('yellow', (HEAD * length, middle), SNOOKER_COLORS['yellow']),
            Place('red', (FOOT * length, middle), (1.0, 0.0, 0.0)),
        ]
    else:
        rows = {'nine_ball': NINE_BALL_ROWS, 'ten_ball': TEN_BALL_ROWS}.get(kind, EIGHT_BALL_ROWS)
        sizes = [len(row) for row in rows]
        packed = _packed(sizes, (FOOT * length, middle), radius, spacing, rng)
        balls = list(itertools.chain.from_iterable(rows))
        places = [Place('C', (HEAD * length, middle), WHITE)]
        places += [
            Place(str(ball), position, COLORS[(ball - 1) % len(COLORS)])
            for ball, position in sorted(zip(balls, packed, strict=True))
        ]
    _check_fit(kind, places, (length, width), radius)
    return places


def _snooker(
    length: float, middle: float, radius: float, spacing: float, rng: np.random.Generator | None
) -> list[Place]:
    """Return 'C', 15 reds behind the pink, and the colours on their spots."""
    baulk, aside = (1.0 - SNOOKER_BAULK) * length, SNOOKER_D * length
    spots = {
        'yellow': (baulk, middle + aside),
        'green': (baulk, middle - aside),
        'brown': (baulk, middle),
        'blue': (length / 2.0, middle),
        'pink': (length / 4.0, middle),
        'black': (SNOOKER_BLACK * length, middle),
    }
    # As near to the pink as can be without touching it.
    first = length / 4.0 - 2.0 * radius - max(spacing, SPACING)
    reds = _packed([1, 2, 3, 4, 5], (first, middle), radius, spacing, rng)
    places = [Place('C', (baulk, middle + aside / 2.0), WHITE)]
    places += [Place(f'R{k}', spot, (1.0, 0.0, 0.0)) for k, spot in enumerate(reds, 1)]
    return places + [Place(label, spots[label], color) for label, color in SNOOKER_COLORS.items()]


def _packed(
    sizes: list[int], apex: Point, radius: float, spacing: float, rng: np.random.Generator | None
) -> list[Point]:
    """Return the places of rows of balls, the first at `apex`, that touch but for gaps.

    The mean of the gaps of neighbours is the spacing, and none is negative.
    """
    lattice = np.array(
        [
            (-row * math.sqrt(0.75), k - (size - 1) / 2.0)
            for row, size in enumerate(sizes)
            for k in range(size)
        ]
    )
    near = [
        (i, j)
        for i, j in itertools.combinations(range(len(lattice)), 2)
        if math.dist(lattice[i], lattice[j]) < 1.5
    ]
    shifts, scale = np.zeros_like(lattice), 0.0
    if rng is not None:
        # Evenly over a disc.
        angles, shares = rng.uniform(0.0, (math.tau, 1.0), (len(lattice), 2)).T
        shifts = (np.sqrt(shares) * (np.cos(angles), np.sin(angles))).T
        scale = JITTER * spacing
    places = _spread(lattice, near, scale * shifts, 2.0 * radius + spacing)
    while scale > ROUNDING * radius and _distances(places, near).min() < 2.0 * radius:
        # To make up for gaps that are wide by chance, others would have to be negative.
        scale *= 0.9
        places = _spread(lattice, near, scale * shifts, 2.0 * radius + spacing)
    return [(float(x), float(y)) for x, y in places + apex]


def _distances(places: NDArray[np.float64], pairs: list[tuple[int, int]]) -> NDArray[np.float64]:
    first, second = np.array(pairs).T
    return np.hypot(*(places[first] - places[second]).T)


def _spread(
    lattice: NDArray[np.float64],
    pairs: list[tuple[int, int]],
    shifts: NDArray[np.float64],
    mean: float,
) -> NDArray[np.float64]:
    """Return a lattice with shifts, stretched so that the distances of `pairs` have this mean."""
    pitch = mean
    for _ in range(STRETCHES):
        pitch += mean - _distances(lattice * pitch + shifts, pairs).mean()
    return lattice * pitch + shifts


def _check_fit(kind: str, places: list[Place], size: Point, radius: float) -> None:
    """Raise ValueError where a ball overlaps a cushion or another ball."""
    message = f'kind: a rack {kind!r} of balls of radius {radius:g} m does not fit on a table of '
    message += f'{size[0]:g} x {size[1]:g} m; '
    for place in places:
        if any(not radius <= place.position[k] <= size[k] - radius for k in (0, 1)):
            raise ValueError(f'{message}ball {place.label!r} is beyond a cushion')
    for one, other in itertools.combinations(places, 2):
        if math.dist(one.position, other.position) < 2.0 * radius - OVERLAP:
            raise ValueError(f'{message}balls {one.label!r} and {other.label!r} overlap')
