"""Counts the lines on each page of a PDF that Chromium has printed."""

import re
import zlib

_OBJECT = re.compile(rb'^(\d+) 0 obj\n(.*?)\nendobj', re.DOTALL | re.MULTILINE)
_TEXT = re.compile(rb'BT\n.*?([-\d.]+) Tm\n.*?ET', re.DOTALL)
SAME_LINE = 8.0
"""Texts whose heights differ by less stand on one line: CSS pixels."""


def lines_on_pages(pdf):
    """Return the number of lines of text on each page, without the number of the page.

    Parameters
    ----------
    pdf : bytes
    """
    objects = {int(number): body for number, body in _OBJECT.findall(pdf)}
    counts = []
    for body in objects.values():
        if re.match(rb'<</Type /Page\n', body):
            contents = objects[int(re.search(rb'/Contents (\d+) 0 R', body)[1])]
            stream = contents.partition(b'stream\n')[2].rpartition(b'\nendstream')[0]
            heights = sorted(float(y) for y in _TEXT.findall(zlib.decompress(stream)))
            lines = sum(b - a > SAME_LINE for a, b in zip(heights, heights[1:], strict=False))
            counts.append(lines)
    return counts
