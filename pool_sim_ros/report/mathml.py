"""Formulae in a page: LaTeX between \\( and \\) or \\[ and \\] becomes MathML.

A displayed formula may be broken at each ``\\quad`` where the page is narrow.
"""

from __future__ import annotations

import re

_FORMULA = re.compile(r'\\\((?P<inline>.+?)\\\)|\\\[(?P<display>.+?)\\\]', re.DOTALL)
_TAG = re.compile(r'\\tag\{(.+?)\}')


def with_formulae(html: str) -> str:
    """Return the page with its formulae set; one with a ``\\tag`` gets its number beside it."""
    from latex2mathml.converter import convert

    def set_formula(match: re.Match) -> str:
        if match['inline']:
            return convert(match['inline'])
        tag = _TAG.search(match['display'])
        number = f'<span class="number">({tag[1]})</span>' if tag else ''
        latex = _TAG.sub('', match['display'])
        parts = (convert(part.strip(), display='block') for part in latex.split(r'\quad'))
        return f'<div class="formula"><div>{"".join(parts)}</div>{number}</div>'

    return _FORMULA.sub(set_formula, html)
