"""Oracle data, published figures and a pocket table: what balls that spin are compared with."""

import csv
import functools
import json
from pathlib import Path

FOLDER = Path(__file__).parents[1] / 'physics' / 'billiards'


@functools.cache
def oracle():
    """Return the shots and single contacts that were computed with 40 digits."""
    return json.loads((FOLDER / 'oracle.json').read_text())


def oracle_contacts(*kinds):
    """Yield (input, parameters, output) of the single contacts of some kinds."""
    for kind in kinds:
        for contact in oracle()['contacts'][kind]:
            yield contact['input'], contact.get('parameters'), contact['output']


@functools.cache
def anchors():
    """Return the published figures: name -> rows of inputs and expected values, as text."""
    rows = {}
    with (FOLDER / 'anchors.csv').open() as file:
        for row in csv.DictReader(file):
            rows.setdefault(row['anchor'], []).append((row['inputs'], row['expected']))
    return rows


@functools.cache
def seven_foot():
    """Return the seven-foot pocket table."""
    return json.loads((FOLDER / 'seven_foot.json').read_text())
