"""Numbers, contents and lists: of the sections, figures, tables and listings of a page."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import count
from string import ascii_uppercase

from pool_sim_ros.report.markup import Html, join

_CAPTION = re.compile(r'<(?P<tag>caption|figcaption)>(?P<text>.+?)</(?P=tag)>', re.DOTALL)
_NUMBER = re.compile(r'(?P<kind>Figure|Table|Listing) (?P<number>\w+): ')
_HEADING = re.compile(r'<h(?P<level>[23])(?: id="(?P<id>.+?)")?>(?P<title>.+?)</h[23]>')
_ENTRY = re.compile(
    r'<(?:fig)?caption id="(?P<id>.+?)">(?P<kind>\w+) (?P<number>\w+): (?P<title>[^.<(]+)'
)


def numbered(sections: Html) -> Html:
    """Return sections in which every heading and every numbered caption has an id to link to.

    The report's figures, tables and listings have its numbers, as in ``Table 2: ...``. A table
    without one is not the report's: it gets a letter, in order.
    """
    letters = _letters()

    def caption(match: re.Match[str]) -> str:
        tag, text = match['tag'], match['text']
        if tag == 'caption' and not _NUMBER.match(text):
            text = f'Table {next(letters)}: {text}'
        number = _NUMBER.match(text)
        if number is None:
            return match[0]
        name = f'{number["kind"]}-{number["number"]}'.lower()
        return f'<{tag} id="{name}">{text}</{tag}>'

    def heading(match: re.Match[str]) -> str:
        level, title = match['level'], match['title']
        name = match['id'] or f'section-{title.partition(" ")[0]}'
        return f'<h{level} id="{name}">{title}</h{level}>'

    return Html(_HEADING.sub(heading, _CAPTION.sub(caption, sections)))


def contents(sections: Html) -> Html:
    """Return the items of a list of the sections and, inside it, their subsections."""
    chapters: list[tuple[str, list[str]]] = []
    for found in _HEADING.finditer(sections):
        link = f'<a href="#{found["id"]}">{found["title"]}</a>'
        if found['level'] == '2':
            chapters.append((link, []))
        else:
            chapters[-1][1].append(f'<li>{link}</li>')
    items = []
    for link, parts in chapters:
        inner = f'\n<ol>\n{join(map(Html, parts), chr(10))}\n</ol>' if parts else ''
        items.append(Html(f'<li>{link}{inner}</li>'))
    return join(items, '\n')


def list_of(kind: str, sections: Html) -> Html:
    """Return the items of a list of all figures, tables or listings: the report's come first.

    Parameters
    ----------
    kind : {'Figure', 'Table', 'Listing'}
    sections : Html
        As `numbered` returns them.
    """
    found = [entry for entry in _ENTRY.finditer(sections) if entry['kind'] == kind]
    found.sort(key=lambda entry: not entry['number'].isdigit())
    items = (
        f'<li><a href="#{entry["id"]}">{entry["number"]} {entry["title"].strip()}</a></li>'
        for entry in found
    )
    return join(map(Html, items), '\n')


def _letters() -> Iterator[str]:
    """Yield A to Z, then A1 to Z1, and so on."""
    for turn in count():
        for letter in ascii_uppercase:
            yield f'{letter}{turn or ""}'
