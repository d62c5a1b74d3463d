"""JSON that anybody may have written."""

from __future__ import annotations

import json
import re
from typing import Any

MOST_DIGITS = 18
"""Digits of a whole number: no tick or count needs more, and all of them fit into 64 bits."""

_SURROGATE = re.compile(r'\\u[dD][89a-fA-F]')
"""Half a character: harmless beside its other half, and no text without it."""


def read_json(text: str, most_digits: int = MOST_DIGITS) -> Any:
    """Return the value of a text, in which a whole number of too many digits becomes a float.

    Floats may be infinite or no number, as `json` reads them.

    Parameters
    ----------
    text : str
    most_digits : int, optional
        Of a whole number that stays one.

    Raises
    ------
    ValueError
        Where it is no JSON, an object has a key twice, values are nested too deeply, or a string
        is no text; says which, in one line.
    """

    def whole(digits: str) -> int | float:
        return int(digits) if len(digits) <= most_digits else float(digits)

    try:
        text.encode()
        value = json.loads(text, object_pairs_hook=_once, parse_int=whole)
        if _SURROGATE.search(text):
            json.dumps(value, ensure_ascii=False).encode()
    except RecursionError:
        raise ValueError('it is nested too deeply') from None
    except UnicodeEncodeError:
        raise ValueError('it has half a character') from None
    except json.JSONDecodeError as error:
        raise ValueError(f'it is not JSON: {error.msg}, column {error.colno}') from None
    return value


def read_json_object(text: str, most_digits: int = MOST_DIGITS) -> dict[str, Any]:
    """Return the fields of a text that is a JSON object; arguments are as those of `read_json`.

    Raises
    ------
    ValueError
        As `read_json` does, and where it is something else.
    """
    value = read_json(text, most_digits)
    if not isinstance(value, dict):
        raise ValueError('it is not a JSON object')
    return value


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    fields: dict[str, Any] = {}
    for name, value in pairs:
        if name in fields:
            raise ValueError(f'the key {json.dumps(name[:40])} is given twice')
        fields[name] = value
    return fields
