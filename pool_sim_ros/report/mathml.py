"""Formulae in a page: LaTeX between \\( and \\) or \\[ and \\] becomes MathML.

Where the page is narrow, a displayed formula may break at each ``\\quad``.
"""

from __future__ import annotations

import re

_FORMULA = re.compile(r'\\\((?P<inline>.+?)\\\)|\\\[(?P<display>.+?)\\\]', re.DOTALL)
_TAG = re.compile(r'\\tag\{(.+?)\}')


def with_formulae(html: str) -> str:
    """Return a page with its formulae as MathML, and the number of a ``\\tag`` beside its formula.

    Parameters
    ----------
    html : str

    Returns
    -------
    str
    """
    from latex2mathml.converter import convert

    def set_formula(match: re.Match[str]) -> str:
        if match['inline']:
            return str(convert(match['inline']))
        tag = _TAG.search(match['display'])
        number = f'<span class="number">({tag[1]})</span>' if tag else ''
        latex = _TAG.sub('', match['display'])
        parts = (convert(part.strip(), display='block') for part in latex.split(r'\quad'))
        return f'<div class="formula"><div>{"".join(parts)}</div>{number}</div>'

    return _FORMULA.sub(set_formula, html)
