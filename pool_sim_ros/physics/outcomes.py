"""What comes of many shots."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import pandas
    import xarray

    from pool_sim_ros.physics.table import Table

PLAYED, BAD_LAYOUT, TOO_MANY_EVENTS, RUNS_AWAY = 0, 1, 2, 3
"""Values of `Outcomes.failed`."""

BAD_VELOCITY = 4
"""The same for a single shot, before it is told in words."""


NO_POCKET = np.int64(-1).tobytes()

NO_POCKETED: NDArray[np.int64] = np.empty((0, 0), np.int64)
"""For a table without pockets: nothing to write."""


class ShotTooLong(ValueError):  # noqa: N818, the public name
    """A shot had more events than it may have."""


class ShotCancelled(Exception):  # noqa: N818, as above
    """A shot was given up because its caller no longer wants it."""


class Shot(NamedTuple):
    """All of one shot: as `Trajectory` has it, and `failed` as `Outcomes`."""

    failed: int
    duration: float
    complete: bool
    final_positions: NDArray[np.float64]
    final_velocities: NDArray[np.float64]
    events: NDArray[np.void]
    segments: NDArray[np.void]
    pocketed: NDArray[np.int64]
    n_events: int
    first_hit: int


class Ends(NamedTuple):
    """The arrays of `Outcomes` that are written shot by shot, or a part of each.

    `pocketed` has no columns where there are no pockets.
    """

    finals: NDArray[np.float64]
    durations: NDArray[np.float64]
    event_counts: NDArray[np.int64]
    pocketed: NDArray[np.int64]
    first_hit: NDArray[np.int64]
    failed: NDArray[np.int8]

    def part(self, shots: slice) -> Ends:
        """Return that of some shots."""
        return Ends(
            self.finals[shots],
            self.durations[shots],
            self.event_counts[shots],
            self.pocketed[shots] if self.pocketed.size else self.pocketed,
            self.first_hit[shots],
            self.failed[shots],
        )


class Outcomes(NamedTuple):
    """What comes of m shots with n balls, shot by shot.

    Attributes
    ----------
    finals : ndarray of shape (m, n, 2)
        Where the balls are at the end, m.
    durations : ndarray of shape (m,)
        Time until the last ball rests, or `until`, s.
    event_counts : ndarray of shape (m,)
        All events that `Trajectory.events` has: contacts, stops, pocketed balls, slides that become
        rolls.
    pocketed : ndarray of shape (m, n)
        Number of the pocket in which a ball is, -1 for none.
    first_hit : ndarray of shape (m,)
        The ball that the cue ball touches first, -1 for none.
    failed : ndarray of shape (m,) of int8
        0 where the shot was played; 1: its layout cannot be, 2: it has too many events, 3: a ball
        runs away. The others then have NaN and -1 for it.
    events : structured ndarray of shape (k,), or None
        All events, one shot after another, with the fields of `Trajectory.events`.
    offsets : ndarray of shape (m + 1,), or None
        The events of shot i are ``events[offsets[i]:offsets[i + 1]]``.
    """

    finals: NDArray[np.float64]
    durations: NDArray[np.float64]
    event_counts: NDArray[np.int64]
    pocketed: NDArray[np.int64]
    first_hit: NDArray[np.int64]
    failed: NDArray[np.int8]
    events: NDArray[np.void] | None
    offsets: NDArray[np.int64] | None

    def __repr__(self) -> str:
        shots, balls = (*np.shape(self.finals), 0, 0)[:2]
        words = f'{shots} shots, {balls} balls'
        if self.events is not None:
            words += f', {len(self.events)} events'
        if failed := int(np.count_nonzero(self.failed)):
            words += f', {failed} failed'
        return f'<Outcomes {words}>'

    def to_xarray(self, table: Table | None = None) -> xarray.Dataset:
        """Return a dataset of xarray with all but the events (extra `frames`).

        Parameters
        ----------
        table : Table, optional
            That was played on. Its labels then name the balls, else their numbers do.

        Returns
        -------
        xarray.Dataset
            With the dimensions `shot`, `ball` and `axis`, and the units as attributes of the
            variables. The version of this package is an attribute of the whole, and so is the
            table, as JSON.

        Raises
        ------
        ValueError
            Where the table has another number of balls.
        ModuleNotFoundError
            Where xarray is not installed; names the extra.
        """
        from pool_sim_ros.physics.frames import outcomes_dataset

        return outcomes_dataset(self, table)

    def events_frame(self, table: Table | None = None) -> pandas.DataFrame:
        """Return the events of all shots as a frame of pandas, as `Trajectory.events_frame`.

        Parameters
        ----------
        table : Table, optional
            That was played on. Its labels then name the balls.

        Returns
        -------
        pandas.DataFrame
            A column `shot` stands before the others; without a table no column has labels.

        Raises
        ------
        ValueError
            Where no events were kept, or the table has another number of balls.
        ModuleNotFoundError
            Where pandas is not installed; names the extra.
        """
        from pool_sim_ros.physics.frames import outcomes_events_frame

        return outcomes_events_frame(self, table)


def new_outcomes(shots: int, balls: int, out: Outcomes | None, pockets: bool = False) -> Outcomes:
    """Return room for what comes of so many shots, in the arrays of `out` where it has them.

    Without `pockets` one number stands for all that is pocketed, which nobody can change.

    Raises
    ------
    ValueError
        Where one of these has another shape or type.
    TypeError
        Where `out` is something else.
    """

    def room(name: str, shape: tuple[int, ...], dtype: type) -> NDArray[Any]:
        given = getattr(out, name, None)
        return np.empty(shape, dtype) if given is None else _checked(name, given, shape, dtype)

    if out is not None and not isinstance(out, Outcomes):
        raise TypeError(f'out: a {type(out).__name__} must be Outcomes, as `simulate_many` returns')
    given = None if out is None else out.pocketed
    shared = given is None or (isinstance(given, np.ndarray) and not given.flags.writeable)
    if pockets or not shared:
        pocketed = room('pocketed', (shots, balls), np.int64)
        if not pockets:
            pocketed[...] = -1
    else:
        pocketed = np.ndarray((shots, balls), np.int64, NO_POCKET, strides=(0, 0))
    return Outcomes(
        finals=room('finals', (shots, balls, 2), np.float64),
        durations=room('durations', (shots,), np.float64),
        event_counts=room('event_counts', (shots,), np.int64),
        pocketed=pocketed,
        first_hit=room('first_hit', (shots,), np.int64),
        failed=room('failed', (shots,), np.int8),
        events=None,
        offsets=None,
    )


def with_events(outcomes: Outcomes, events: NDArray[np.void]) -> Outcomes:
    """Return outcomes with the events of all shots."""
    offsets = np.zeros(len(outcomes.durations) + 1, np.int64)
    np.cumsum(np.maximum(outcomes.event_counts, 0), out=offsets[1:])
    return outcomes._replace(events=events, offsets=offsets)


def _checked(name: str, array: Any, shape: tuple[int, ...], dtype: type) -> NDArray[Any]:
    right = isinstance(array, np.ndarray) and array.shape == shape and array.dtype == dtype
    if not (right and array.flags.c_contiguous and array.flags.writeable):
        kind = np.dtype(dtype).name
        raise ValueError(f'out.{name}: must be a writable C-contiguous array of {shape} {kind}')
    return np.asarray(array)
