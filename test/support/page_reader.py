"""Reads a page as a person would: its tables, pictures, links and words."""

import re
from html.parser import HTMLParser

import pytest

from pool_sim_ros.report.page import Content, make_page
from pool_sim_ros.report.played import log_of

VOID = {'meta', 'img', 'br', 'wbr', 'mspace'}


class Page(HTMLParser):
    """A parsed page.

    Attributes
    ----------
    tables : dict
        Caption -> rows of cells, the head first.
    bold : dict
        Caption -> texts of the cells that are marked.
    links, pictures : list
        Of `href`s; of (source, description).
    text : str
    """

    def __init__(self, html):
        super().__init__()
        self.tables, self.bold, self.links, self.pictures = {}, {}, [], []
        self.text, self._open, self._rows, self._marked = '', [], [], False
        self.feed(html)
        self.close()
        assert not self._open, f'never closed: {self._open}'

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        if tag not in VOID:
            self._open.append(tag)
        if tag == 'table':
            self._rows, self._bold, self._caption = [], [], ''
        elif tag == 'tr':
            self._rows.append([])
        elif tag in ('td', 'th'):
            self._rows[-1].append('')
            self._marked = attrs.get('class') == 'off'
        elif tag == 'img':
            self.pictures.append((attrs['src'], attrs['alt']))
        for name in ('href', 'src'):
            if tag != 'img' and name in attrs:
                self.links.append(attrs[name])

    def handle_endtag(self, tag):
        if tag in VOID:
            return
        assert self._open.pop() == tag
        if tag == 'td' and self._marked:
            self._bold.append(self._rows[-1][-1])
        if tag == 'table':
            assert self._caption not in self.tables
            self.tables[self._caption], self.bold[self._caption] = self._rows, self._bold

    def handle_startendtag(self, tag, attrs):
        if tag in VOID:
            self.handle_starttag(tag, attrs)

    def handle_data(self, data):
        if 'style' in self._open:
            return
        self.text += data
        if 'caption' in self._open:
            self._caption += data
        elif self._open and {'td', 'th'} & set(self._open):
            self._rows[-1][-1] += data

    def table(self, words):
        """Return the rows below the head of the one table whose caption has these words."""
        (found,) = (rows for caption, rows in self.tables.items() if words in caption)
        return found[1:]


def numbers(cell):
    """Return the numbers in a cell, as in ``−1.20, 3.40``."""
    return tuple(float(part) for part in cell.replace('\N{MINUS SIGN}', '-').split(','))


class AnyPicture(dict):
    """An empty SVG for every path."""

    def __missing__(self, path):
        return b'<svg/>'


def html_of(settings, shots, comparisons=(), films=None):
    """Return the HTML of the report's page, with empty pictures."""
    pytest.importorskip('latex2mathml', reason='pip install latex2mathml')
    log = log_of(settings, shots)
    pictures, files = AnyPicture(), ['output.log']
    return make_page(Content(settings, shots, comparisons, pictures, films or {}, files, log))


def page_of(settings, shots, comparisons=(), films=None):
    """Return the report's page with empty pictures; nothing in it is left to fill in."""
    html = html_of(settings, shots, comparisons, films)
    assert not re.search(r'\$[a-z]', html)
    assert '\\(' not in html
    assert '\\[' not in html
    return Page(html)


class _Skeleton(HTMLParser):
    def __init__(self):
        super().__init__()
        self.found = []

    def handle_starttag(self, tag, attrs):
        self.found.append((tag, *(name for name, _ in attrs)))

    def handle_endtag(self, tag):
        self.found.append(f'/{tag}')


def skeleton(html):
    """Return all tags of a page with the names of their attributes, in order: all but its text."""
    reader = _Skeleton()
    reader.feed(html)
    reader.close()
    return reader.found
