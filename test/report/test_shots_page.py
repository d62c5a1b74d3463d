import re
from pathlib import Path

from page_reader import AnyPicture, Page

from pool_sim_ros.report.played import log_of
from pool_sim_ros.report.shots_page import shots_section

LOG = Path(__file__).parents[1] / 'me212' / 'data' / 'published_output.log'


def section(settings, shots, films=None):
    return shots_section(log_of(settings, shots), shots, AnyPicture(), films or {})


def test_listing_1_is_the_published_log_whole(settings, shots):
    html = section(settings, list(shots.values()))
    (listing,) = re.findall('<pre>(.+?)</pre>', html, re.DOTALL)
    assert Page(listing).text == LOG.read_text().rstrip('\n') + '\n'
    assert listing.count('<span>') == len(LOG.read_text().rstrip('\n').split('\n'))


def test_table_2_has_both_pictures_of_every_shot_in_the_report_s_order(settings, shots):
    page = Page(section(settings, list(shots.values())))
    rows = page.table('Table 2')
    assert [row[0] for row in rows] == ['1', '2', '3', '4']
    figures = [
        re.match(r'Figure (\d+): Simulation (\d), (start|end)', cell)
        for row in rows
        for cell in row[1:]
    ]
    assert [found.groups() for found in figures] == [
        (str(4 + 2 * shot + (when == 'end')), str(1 + shot), when)
        for shot in range(4)
        for when in ('start', 'end')
    ]


def test_some_shots_alone_keep_their_figures(settings, shots):
    page = Page(section(settings, [shots[3]]))
    ((number, start, end),) = page.table('Table 2')
    assert number == '3'
    assert start.startswith('Figure 8: ') and end.startswith('Figure 9: ')
    assert 'Simulation 3: Cue velocity = [-1.299,  0.750] (m/s)' in page.text


def test_a_film_stands_with_its_shot(settings, shots):
    html = section(settings, [shots[2], shots[3]], {3: 'videos/collision_3.mp4'})
    assert html.index('3.3 Simulation 3') < html.index('videos/collision_3.mp4')
    assert html.count('<video') == 1
