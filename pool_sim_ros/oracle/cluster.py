"""Shots of the oracle on a Dask cluster, part by part."""

from __future__ import annotations

import asyncio
from concurrent.futures import CancelledError
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pool_sim_ros.extras import needs
from pool_sim_ros.physics import Outcomes, Table, simulate_many

PART = 5_000
"""Shots of a task: a few milliseconds, far more than it takes to hand one out."""

CONNECT = '10s'
"""In which a scheduler must answer."""

LOOK_PERIOD = 5.0
"""Seconds between two looks whether there are workers, while shots are not played."""


class ClusterError(Exception):
    """The cluster does not play; the message is for the user."""


class Cluster:
    """A Dask cluster that plays shots, until `close`. Any thread may call it.

    The workers need this package. Results do not depend on how many there are.

    Parameters
    ----------
    address : str
        Of the scheduler, like tcp://host:8786.

    Attributes
    ----------
    address : str
    client : distributed.Client

    Raises
    ------
    ClusterError
        Where the scheduler does not answer.
    ModuleNotFoundError
        Where Dask is not installed.
    """

    def __init__(self, address: str) -> None:
        self.address = address
        with needs('a cluster', 'study'):
            from distributed import Client
            from distributed.comm.addressing import get_address_host_port
        try:
            get_address_host_port(address)  # where it cannot, a client waits long, and closes badly
            self.client = Client(address, timeout=CONNECT, set_as_default=False)
        except (OSError, ValueError, TypeError) as error:
            why = ' '.join(str(error).split()) or type(error).__name__
            raise ClusterError(f'scheduler: {address!r} does not answer: {why}') from None

    def simulate_many(
        self,
        table: Table,
        velocities: NDArray[np.float64],
        *,
        spins: NDArray[np.float64] | None = None,
        positions: ArrayLike | None = None,
        events: bool = False,
        errors: str = 'mark',
        threads: int | None = None,
    ) -> Outcomes:
        """Play shots as `physics.simulate_many` does, bit for bit.

        Parameters
        ----------
        table : Table
        velocities : ndarray of shape (m, 2)
            Of the cue ball, m/s.
        spins : ndarray of shape (m, 3), optional
            Of the cue ball, rad/s.
        positions : array_like of shape (n, 2) or (m, n, 2), optional
            Where the balls start instead of their own places, m.
        events : bool, optional
            Whether to keep all events.
        errors : str, optional
            'mark' alone: a shot that fails is marked.
        threads : int, optional
            Of no effect: a worker plays each part in one thread.

        Returns
        -------
        Outcomes
            Those of one call.

        Raises
        ------
        ClusterError
            Where the cluster is gone, has no workers, or one of them cannot play.
        ValueError
            As there.
        """
        assert errors == 'mark', 'a part does not know the numbers of its shots'
        layouts = None if positions is None else np.asarray(positions, dtype=float)
        tasks = [
            self.client.submit(
                play_part,
                table,
                velocities[part],
                None if spins is None else spins[part],
                layouts[part] if layouts is not None and layouts.ndim == 3 else layouts,
                events,
                pure=False,
            )
            for part in parts(len(velocities))
        ]
        try:
            self._await(tasks)
            return joined(self.client.gather(tasks))
        except (ValueError, ClusterError):
            raise
        except (OSError, CancelledError, asyncio.CancelledError):
            raise ClusterError(f'scheduler: {self.address!r} is gone') from None
        except Exception as error:
            why = ' '.join(str(error).split())
            raise ClusterError(
                f'scheduler: a worker of {self.address!r} cannot play: {why:.200}'
            ) from None

    def _await(self, tasks: list[Any]) -> None:
        """Wait for tasks as long as there is anybody to play them."""
        from distributed import wait

        while True:
            try:
                with self.client.as_current():
                    wait(tasks, timeout=LOOK_PERIOD)
                return
            except (TimeoutError, asyncio.TimeoutError):
                if not self.client.nthreads():
                    raise ClusterError(f'scheduler: {self.address!r} has no workers') from None

    def close(self) -> None:
        """Leave the cluster; it goes on for others."""
        self.client.close()


def parts(count: int) -> list[slice]:
    """Return the slices of so many shots, one at least."""
    return [slice(k, min(k + PART, count)) for k in range(0, max(count, 1), PART)]


def play_part(
    table: Table,
    velocities: NDArray[np.float64],
    spins: NDArray[np.float64] | None,
    positions: NDArray[np.float64] | None,
    events: bool,
) -> Outcomes:
    """Play some shots; this runs in a worker."""
    return simulate_many(
        table,
        velocities,
        spins=spins,
        positions=positions,
        events=events,
        errors='mark',
        threads=1,
    )


def joined(found: list[Outcomes]) -> Outcomes:
    """Return the outcomes of all parts as those of one call."""
    if len(found) == 1:
        return found[0]
    fields: dict[str, Any] = {
        name: np.concatenate([getattr(part, name) for part in found])
        for name in ('finals', 'durations', 'event_counts', 'pocketed', 'first_hit', 'failed')
    }
    events = [part.events for part in found if part.events is not None]
    if not events:
        return found[0]._replace(**fields)
    fields['events'] = np.concatenate(events)
    fields['offsets'] = np.zeros(len(fields['durations']) + 1, np.int64)
    # A shot that failed has a count of -1, and no events.
    np.cumsum(np.maximum(fields['event_counts'], 0), out=fields['offsets'][1:])
    return found[0]._replace(**fields)
