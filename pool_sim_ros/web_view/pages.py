"""The open pages, and what still has to go to each."""

from __future__ import annotations

import asyncio
import json
from collections import deque

LONGEST_QUEUE = 512
"""Most texts that wait for a page; a page that is further behind is given up. Frames never queue:
only the latest counts."""


class Page:
    """What still has to go to one page."""

    def __init__(self) -> None:
        self.lost = False
        """Whether it is too slow for everything it should be told."""
        self._texts: deque[str] = deque()
        self._frame: bytes | None = None
        self._something = asyncio.Event()

    def tell(self, text: str) -> None:
        """Send a text, after the earlier ones."""
        self.lost = self.lost or len(self._texts) >= LONGEST_QUEUE
        if not self.lost:
            self._texts.append(text)
        self._something.set()

    def show(self, frame: bytes) -> None:
        """Send a frame, in place of one that still waits."""
        self._frame = frame
        self._something.set()

    async def next(self) -> str | bytes | None:
        """Wait for the next item to send, and take it; texts go before the frame.

        None if there is no item but the page is lost.
        """
        await self._something.wait()
        item: str | bytes | None
        if self._texts:
            item = self._texts.popleft()
        else:
            item, self._frame = self._frame, None
        if not self._texts and self._frame is None and not self.lost:
            self._something.clear()
        return item


class Pages:
    """All open pages; a late page is told what counts at that time."""

    def __init__(self) -> None:
        self._open: set[Page] = set()
        self._kept: dict[str, str] = {}
        self._frame: bytes | None = None

    def open(self) -> Page:
        """Return a new page, and tell it at once what was kept."""
        page = Page()
        for text in self._kept.values():
            page.tell(text)
        if self._frame is not None:
            page.show(self._frame)
        self._open.add(page)
        return page

    def close(self, page: Page) -> None:
        """Send nothing more to this page."""
        self._open.discard(page)

    def tell(self, kind: str, content: object, *, keep: bool = False) -> None:
        """Send JSON to every page; with `keep` also to later pages, until the next of its kind."""
        text = message(kind, content)
        if keep:
            self._kept[kind] = text
        for page in self._open:
            page.tell(text)

    def forget(self, kind: str) -> None:
        """Stop telling new pages the last of this kind."""
        self._kept.pop(kind, None)

    def show(self, frame: bytes | None) -> None:
        """Send a frame to every page, also to later ones; None forgets the last."""
        self._frame = frame
        if frame is not None:
            for page in self._open:
                page.show(frame)


def message(kind: str, content: object) -> str:
    """Return the text of a message to a page: ``{"kind": ..., "content": ...}``."""
    return json.dumps({'kind': kind, 'content': content}, allow_nan=False)
