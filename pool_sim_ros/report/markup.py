"""Parts of a page: tables, figures, numbers, and the templates that hold the text.

Whatever is no `Html` is text: it is escaped where it goes into HTML.
"""

from __future__ import annotations

import base64
from collections.abc import Collection, Iterable, Mapping, Sequence
from html import escape
from importlib import resources
from string import Template

from pool_sim_ros.physics import Ball

MINUS = '\N{MINUS SIGN}'


class Html(str):
    """A text that is HTML already."""


class Cell(Html):
    """A cell of a table that is HTML already, with its CSS class."""

    css_class = ''

    def __new__(cls, html: str, css_class: str = '') -> Cell:
        """Return the cell."""
        cell = super().__new__(cls, html)
        cell.css_class = css_class
        return cell


def fill(template: str, **parts: object) -> Html:
    """Return a file of `templates` with `parts`, escaped, in place of its ``$names``."""
    text = (resources.files(__package__) / 'templates' / template).read_text('utf-8')
    return Html(Template(text).substitute({name: to_html(part) for name, part in parts.items()}))


def to_html(part: object) -> Html:
    """Return HTML as it is, and anything else escaped.

    A backslash is escaped too: `with_formulae` must not find a formula in a label.
    """
    if isinstance(part, Html):
        return part
    return Html(escape(str(part)).replace('\\', '&#92;'))


def join(parts: Iterable[object], between: str) -> Html:
    """Return parts one after another, each escaped unless it is HTML."""
    return Html(between.join(map(to_html, parts)))


def table(
    head: Sequence[str],
    rows: Iterable[Sequence[str]],
    caption: str,
    text_columns: Collection[int] = (),
) -> Html:
    """Return a table. Its cells and titles are text, except for those that are a `Cell`."""

    def line(tag: str, cells: Sequence[str]) -> str:
        return ''.join(_cell(tag, cell, i in text_columns) for i, cell in enumerate(cells))

    body = '\n'.join(f'<tr>{line("td", row)}</tr>' for row in rows)
    return Html(
        f'<div class="table" role="region" aria-label="{to_html(caption)}" tabindex="0">'
        f'<table>\n<caption>{to_html(caption)}</caption>\n'
        f'<thead><tr>{line("th", head)}</tr></thead>\n<tbody>\n{body}\n</tbody>\n</table></div>'
    )


def figure(
    pictures: Mapping[str, bytes], path: str, caption: str, description: str, css_class: str = ''
) -> Html:
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
    return Html(
        f'<figure class="{css_class}"><img src="data:image/svg+xml;base64,{data}" '
        f'alt="{to_html(description)}"><figcaption>{to_html(caption)} '
        f'(<a href="{to_html(path)}">600 dpi</a>).</figcaption></figure>'
    )


def listing(text: str, caption: str) -> Html:
    """Return a text line by line, as it is; the page's style numbers the lines."""
    lines = ''.join(f'<span>{to_html(line)}\n</span>' for line in text.split('\n'))
    return Html(
        f'<figure class="listing"><figcaption>{to_html(caption)}.</figcaption>'
        f'<pre>{lines}</pre></figure>'
    )


def link(path: str, text: str | None = None) -> Html:
    """Return a link to a file beside the page; its text is the path if there is no other."""
    return Html(f'<a href="{to_html(path)}">{to_html(text or path)}</a>')


def ball_name(ball: Ball) -> Cell:
    """Return a spot of a ball's colour and its label."""
    color = ' '.join(f'{round(255 * level)}' for level in ball.color)
    swatch = f'<span class="swatch" style="background: rgb({color})"></span>'
    return Cell(swatch + to_html(ball.label), 'label')


def number(value: float, decimals: int) -> str:
    """Return a number with a fixed count of decimals, without a minus sign if all are zero."""
    text = f'{value:.{decimals}f}'
    if not text.strip('-0.'):
        text = text.lstrip('-')
    return text.replace('-', MINUS)


def pair(values: Iterable[float], decimals: int) -> str:
    """Return x and y as ``x, y``, each as `number` writes it."""
    return ', '.join(number(value, decimals) for value in values)


def short(value: float) -> Html:
    """Return a number with few digits as HTML; small and large ones get a power of ten."""
    if value == 0.0 or 1e-3 <= abs(value) < 1e4:
        return Html(f'{value:g}')
    mantissa, exponent = f'{value:.5e}'.split('e')
    mantissa = mantissa.rstrip('0').rstrip('.')
    factor = '' if mantissa == '1' else f'{mantissa} · '
    return Html(f'{factor}10<sup>{MINUS if int(exponent) < 0 else ""}{abs(int(exponent))}</sup>')


def _cell(tag: str, cell: str, is_text: bool) -> str:
    css_class = getattr(cell, 'css_class', '') or ('text' if is_text else '')
    attribute = f' class="{css_class}"' if css_class else ''
    return f'<{tag}{attribute}>{to_html(cell)}</{tag}>'
