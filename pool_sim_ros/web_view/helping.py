"""The shots most likely to do what somebody wants, for a page that asks for help."""

from __future__ import annotations

import asyncio
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pool_sim_ros.oracle import Noise, RankedShot, find_shots
from pool_sim_ros.physics import Table
from pool_sim_ros.web_view.pages import Page, message

NOISE = Noise.preset('fastfiz')
"""How badly somebody shoots who plays on a page: as in the computer olympiads."""

SHOTS, SECONDS = 150_000, 4.0
"""At most so much is sought: half a second on one core where balls are discs."""

COUNT = 3
"""Shots of an answer."""


def help_fields(
    table: Table, positions: NDArray[np.float64], goal: dict[str, Any]
) -> dict[str, object]:
    """Return what a page is told that asks for help.

    Parameters
    ----------
    table : Table
    positions : ndarray of shape (n, 2)
        Of the resting balls, m.
    goal : dict
        Fields of a `Goal`.

    Returns
    -------
    dict
        ``goal``; ``positions``; ``played``: how many shots were; ``shots``, best first, each with
        ``strike``, as a request has it, and its ``chance``, ``low``, ``high``, ``speed`` and
        ``azimuth``.

    Raises
    ------
    ValueError
        For a goal that the table cannot have.
    """
    plan = find_shots(table, goal, NOISE, SHOTS, seconds=SECONDS, positions=positions, count=COUNT)
    return {
        'goal': goal,
        'positions': positions.tolist(),
        'played': plan.played,
        'shots': [_shot_fields(shot) for shot in plan],
    }


def _shot_fields(shot: RankedShot) -> dict[str, object]:
    strike = {'velocity': shot.velocity.tolist()} if shot.cue is None else {'cue': shot.cue}
    return {
        'strike': strike,
        'chance': shot.chance,
        'low': shot.low,
        'high': shot.high,
        'speed': shot.speed,
        'azimuth': shot.azimuth,
    }


class Helper:
    """Helps one page after another, beside the event loop in which it was made."""

    def __init__(self) -> None:
        self._turn = asyncio.Lock()
        self._asking: set[Page] = set()

    async def help(
        self, page: Page, table: Table, positions: NDArray[np.float64], goal: dict[str, Any]
    ) -> None:
        """Search, and tell the page; a page that asks while it waits is told so."""
        if page in self._asking:
            page.tell(message('problem', 'The search for a shot goes on; wait for its answer.'))
            return
        self._asking.add(page)
        try:
            async with self._turn:
                found = await asyncio.to_thread(help_fields, table, positions, goal)
            page.tell(message('help', found))
        except ValueError as error:
            page.tell(message('help', None))
            page.tell(message('problem', str(error)))
        finally:
            self._asking.discard(page)
