"""Names that are nearly those of parameters: a misspelt one is told, one of another node is not."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable

from pool_sim_ros.simulator.parameter_table import PARAMETERS

GROUPS = ('table.', 'balls.')
"""How the names begin that are surely meant for this node, if they are close to one of its own."""

CLOSE_IN_GROUP = 0.65
"""Likeness (difflib's ratio, 0 to 1) of what follows the group in two names that are close:
`lenght` has 0.83 and `mu_ball_cloth` 0.72, while `height` and `frame` have less than 0.6."""

CLOSE_WHOLE_WORD = 0.75
"""The same where a name is a whole word of ours: `height` has 0.71 of `nose_height`."""

CLOSE_WORD = 0.7
"""Least likeness of each word in two names that are close: `facter` has 0.83, `clok` 0.89, and the
last word of `publish_tf` 0.33."""

CLOSE = 0.9
"""Least likeness of two names whose words are run together or apart, as in `realtimefactor`."""


MOST_MORE = 5
"""Characters that a close name may have more or fewer; to compare all others takes time."""


def near_misses(names: Iterable[str]) -> dict[str, str]:
    """Return the names that are nearly those of parameters, each with the one that it resembles.

    Parameters
    ----------
    names : iterable of str
        A parameter file may be shared, so most of what is unknown belongs to other nodes.
    """
    close = {name: _resembles(name) for name in names if name not in PARAMETERS}
    return {name: ours for name, ours in close.items() if ours is not None}


def _resembles(name: str) -> str | None:
    for group in GROUPS:
        if name.startswith(group):
            rest = name.removeprefix(group)
            ours = [own.removeprefix(group) for own in PARAMETERS if own.startswith(group)]
            found = difflib.get_close_matches(rest, ours, 1, CLOSE_IN_GROUP)
            if not found:
                return None
            is_word = rest in found[0].split('_') and _likeness(rest, found[0]) < CLOSE_WHOLE_WORD
            return None if is_word else group + found[0]
    close = [own for own in PARAMETERS if _is_close(name, own)]
    if close:
        return max(close, key=lambda own: _likeness(name, own))
    if '_' in name or name == 'preset':
        left_out = [own for own in PARAMETERS if own.endswith(f'.{name}')]
        return left_out[0] if left_out else None
    return None


def _is_close(name: str, own: str) -> bool:
    if abs(len(name) - len(own)) > MOST_MORE:
        return False
    words, own_words = _words(name), _words(own)
    if len(words) == len(own_words):
        pairs = zip(words, own_words, strict=True)
        if all(_likeness(word, own_word) >= CLOSE_WORD for word, own_word in pairs):
            return True
    return _likeness(''.join(words), ''.join(own_words)) >= CLOSE


def _words(name: str) -> list[str]:
    return [word for word in re.split(r'[^a-z0-9]+', name.lower()) if word]


def _likeness(one: str, other: str) -> float:
    return difflib.SequenceMatcher(None, one, other, autojunk=False).ratio()
