"""Parts of a page: tables, figures, numbers, and the templates that hold the text."""

from __future__ import annotations

import base64
from collections.abc import Collection, Iterable, Mapping, Sequence
from html import escape
from importlib import resources
from string import Template

from pool_sim_ros.physics import Ball

MINUS = '\N{MINUS SIGN}'


class Cell(str):
    """A cell of a table that is HTML already, with its CSS class."""

    css_class = ''

    def __new__(cls, html: str, css_class: str = '') -> Cell:
        """Return the cell."""
        cell = super().__new__(cls, html)
        cell.css_class = css_class
        return cell


def fill(template: str, **parts: object) -> str:
    """Return a file of `templates` with `parts` in place of its ``$names``."""
    text = (resources.files(__package__) / 'templates' / template).read_text('utf-8')
    return Template(text).substitute(parts)


def table(
    head: Sequence[str],
    rows: Iterable[Sequence[str]],
    caption: str,
    text_columns: Collection[int] = (),
) -> str:
    """Return a table. Its cells and titles are text, except for those that are a `Cell`."""

    def line(tag: str, cells: Sequence[str]) -> str:
        return ''.join(_cell(tag, cell, i in text_columns) for i, cell in enumerate(cells))

    body = '\n'.join(f'<tr>{line("td", row)}</tr>' for row in rows)
    return (
        f'<div class="table" role="region" aria-label="{escape(caption)}" tabindex="0">'
        f'<table>\n<caption>{escape(caption)}</caption>\n'
        f'<thead><tr>{line("th", head)}</tr></thead>\n<tbody>\n{body}\n</tbody>\n</table></div>'
    )


def figure(
    pictures: Mapping[str, bytes], path: str, caption: str, description: str, css_class: str = ''
) -> str:
    """Return a picture inside the page, with a link to its file.

    Parameters
    ----------
    pictures : mapping
        Path -> SVG.
    path : str
        Of the file, relative to the page.
    caption, description : str
        The text below the picture; a description for readers who cannot see it.
    css_class : str, optional
    """
    data = base64.b64encode(pictures[path]).decode()
    return (
        f'<figure class="{css_class}"><img src="data:image/svg+xml;base64,{data}" '
        f'alt="{escape(description)}"><figcaption>{escape(caption)} '
        f'(<a href="{path}">600 dpi</a>).</figcaption></figure>'
    )


def ball_name(ball: Ball) -> Cell:
    """Return a spot of a ball's colour and its label."""
    color = ' '.join(f'{round(255 * level)}' for level in ball.color)
    swatch = f'<span class="swatch" style="background: rgb({color})"></span>'
    return Cell(swatch + escape(ball.label))


def number(value: float, decimals: int) -> str:
    """Return a number with a fixed count of decimals, without a minus sign if all are zero."""
    text = f'{value:.{decimals}f}'
    if not text.strip('-0.'):
        text = text.lstrip('-')
    return text.replace('-', MINUS)


def pair(values: Iterable[float], decimals: int) -> str:
    """Return x and y as ``x, y``, each as `number` writes it."""
    return ', '.join(number(value, decimals) for value in values)


def short(value: float) -> str:
    """Return a number with few digits as HTML; small and large ones get a power of ten."""
    if value == 0.0 or 1e-3 <= abs(value) < 1e4:
        return f'{value:g}'
    mantissa, exponent = f'{value:.5e}'.split('e')
    mantissa = mantissa.rstrip('0').rstrip('.')
    factor = '' if mantissa == '1' else f'{mantissa} · '
    return f'{factor}10<sup>{MINUS if int(exponent) < 0 else ""}{abs(int(exponent))}</sup>'


def _cell(tag: str, cell: str, is_text: bool) -> str:
    css_class = getattr(cell, 'css_class', '') or ('text' if is_text else '')
    attribute = f' class="{css_class}"' if css_class else ''
    return f'<{tag}{attribute}>{_html(cell)}</{tag}>'


def _html(cell: str) -> str:
    return cell if isinstance(cell, Cell) else escape(cell)
