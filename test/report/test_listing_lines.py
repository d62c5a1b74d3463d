import importlib
import inspect
import re

import pytest
from page_reader import Page

from pool_sim_ros.physics.time_slice import listing as kernels
from pool_sim_ros.report.listing_lines import LISTING_2, LISTING_3, listing_lines_section

LENGTHS = [(LISTING_2, 133), (LISTING_3, 195)]
"""Each listing, with the number of its last line in the report."""


def found(name):
    """Return what a dotted name below the package stands for."""
    module, _, rest = f'pool_sim_ros.{name}'.rpartition('.')
    try:
        return getattr(importlib.import_module(module), rest)
    except ModuleNotFoundError:
        outer, _, inner = module.rpartition('.')
        return getattr(getattr(importlib.import_module(outer), inner), rest)


@pytest.mark.parametrize(('listing', 'length'), LENGTHS)
def test_every_line_is_described_once(listing, length):
    lines = [line for part in listing for line in range(part.first, part.last + 1)]
    assert lines == list(range(1, length + 1))


@pytest.mark.parametrize(('listing', 'length'), LENGTHS)
def test_every_name_in_it_is_something_of_this_package(listing, length):
    names = {name for part in listing for name in part.here}
    assert len(names) > 5
    for name in names:
        assert found(name) is not None, name


def lines_that_do(name):
    """Return the lines of Listing 3 that stand beside a name."""
    return {
        line for part in LISTING_3 if name in part.here for line in range(part.first, part.last + 1)
    }


@pytest.mark.parametrize('name', ['move', 'meet_cushions', 'meet_balls', 'collide'])
def test_the_kernels_name_the_same_lines(name):
    cited = re.search(r'lines (\d+) to (\d+)', inspect.getdoc(getattr(kernels, name)))
    first, last = map(int, cited.groups())
    mine = lines_that_do(f'physics.time_slice.listing.{name}')
    if name == 'collide':  # it calls two laws
        mine |= lines_that_do('physics.contacts.restitution')
        mine |= lines_that_do('physics.contacts.report_friction')
    if name == 'meet_balls':  # it calls `collide`
        mine |= set(range(113, 144))
    assert set(range(first, last + 1)) <= mine


@pytest.mark.parametrize(
    ('line', 'name'),
    [
        # What the report's own text says of single lines of Listing 3 (its section 2.3).
        (58, 'physics.time_slice.listing.move'),
        (61, 'physics.time_slice.listing.move'),
        (79, 'physics.time_slice.listing.meet_cushions'),
        (89, 'physics.time_slice.listing.meet_cushions'),
        (121, 'physics.time_slice.listing.collide'),
        (131, 'physics.contacts.report_friction'),
        (132, 'physics.contacts.report_friction'),
        (134, 'physics.contacts.report_friction'),
        (137, 'physics.contacts.report_friction'),
    ],
)
def test_the_lines_that_the_report_names_are_where_it_says(line, name):
    assert line in lines_that_do(name)


def test_the_section_has_both_listings_with_lines_tasks_and_names():
    page = Page(listing_lines_section())
    for words, listing in (('Listing 2', LISTING_2), ('Listing 3', LISTING_3)):
        rows = page.table(words)
        assert len(rows) == len(listing)
        for row, part in zip(rows, listing, strict=True):
            assert [int(number) for number in row[0].split('–')] in (
                [part.first, part.last],
                [part.first],
            )
            assert row[1] == part.task
            assert row[2] == (''.join(part.here) or 'nothing')
