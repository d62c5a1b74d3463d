import pytest
from page_reader import Page

from pool_sim_ros.report.markup import Html, figure, listing, table
from pool_sim_ros.report.outline import contents, list_of, numbered

SECTIONS = Html(
    '<h2 id="one">1 One</h2><h3>1.1 First</h3>'
    + table(['a'], [['1']], 'Weights, kg. More about them.')
    + '<h3 id="named">1.2 Second</h3>'
    + figure({'f': b'<svg/>'}, 'f', 'Figure 7: A <drawing>, end', 'What it shows')
    + table(['a'], [['2']], 'Table 2: Snapshots.')
    + '<figure><figcaption>Film of it.</figcaption></figure>'
    + listing('x', 'Listing 1: Output (file.log)')
    + '<h2 id="two">2 Two</h2>'
    + table(['a'], [['3']], 'Lengths, m.')
)


@pytest.fixture(scope='module')
def sections():
    return numbered(SECTIONS)


def links(items):
    return Page(f'<ol>{items}</ol>').links


def test_a_table_that_is_not_the_report_s_gets_a_letter(sections):
    assert list(Page(sections).tables) == [
        'Table A: Weights, kg. More about them.',
        'Table 2: Snapshots.',
        'Table B: Lengths, m.',
    ]


def test_every_table_has_a_letter_of_its_own_beyond_z_too():
    many = Html(''.join(table(['a'], [], f'No {i}') for i in range(60)))
    names = [caption.partition(':')[0] for caption in Page(numbered(many)).tables]
    assert names[0] == 'Table A' and names[25:27] == ['Table Z', 'Table A1']
    assert len(set(names)) == 60


def test_contents_list_every_heading_in_order_and_link_to_it(sections):
    items = contents(sections)
    assert links(items) == ['#one', '#section-1.1', '#named', '#two']
    assert all(f'id="{link[1:]}"' in sections for link in links(items))
    assert items.index('<ol>') < items.index('1.1 First') < items.index('</ol>')
    assert items.count('<ol>') == items.count('</ol>') == 1


@pytest.mark.parametrize(
    ('kind', 'names', 'text'),
    [
        ('Figure', ['#figure-7'], '7 A &lt;drawing&gt;, end'),
        ('Table', ['#table-2', '#table-a', '#table-b'], 'A Weights, kg'),
        ('Listing', ['#listing-1'], '1 Output'),
    ],
)
def test_each_list_links_to_its_captions_the_report_s_first(sections, kind, names, text):
    items = list_of(kind, sections)
    assert links(items) == names
    assert all(f' id="{name[1:]}"' in sections for name in names)
    assert f'>{text}</a>' in items


def test_a_caption_without_a_number_stays_as_it_is(sections):
    assert '<figcaption>Film of it.</figcaption>' in sections
