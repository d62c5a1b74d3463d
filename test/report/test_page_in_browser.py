"""The report's page in a real browser, opened as a file: what it shows, and what does not run."""

import base64
import re
from dataclasses import replace

import chromium  # first: it skips all of this where there is no browser
import pytest
from page_reader import html_of
from printed_pages import lines_on_pages
from waiting import wait_until

from pool_sim_ros.report.outputs import write_film
from pool_sim_ros.report.played import play_shots

FEWEST_LINES = 4
"""On a printed page, at the least."""

PICTURE = b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 100"/>'
"""Of the shape of the pictures of the table."""

EVIL = '<img src=x onerror="document.title = \'owned\'">'


@pytest.fixture(scope='module')
def opened(settings, tmp_path_factory):
    """The page of a table whose nearest ball has an evil label, with a film, as a file."""
    pytest.importorskip('imageio_ffmpeg', reason='pip install imageio-ffmpeg')
    folder = tmp_path_factory.mktemp('report')
    balls = [replace(ball, label=f'{EVIL}{i}') for i, ball in enumerate(settings.table.balls)]
    evil = replace(settings, table=replace(settings.table, balls=balls), report_integrator='event')
    shots = list(play_shots(evil, (3, 4)))
    films = {3: write_film(folder, shots[0], (64, 36))}
    (folder / 'report.html').write_text(html_of(evil, shots, films=films), encoding='utf-8')
    with chromium.open_browser() as browser:
        page = browser.new_page()
        page.goto((folder / 'report.html').as_uri())
        yield page


@pytest.fixture(scope='module')
def whole(opened, settings, shots, comparisons, other_settings, tmp_path_factory):
    """Pages of the report's own run, of one shot, and of a table with long labels, by name."""
    folder = tmp_path_factory.mktemp('whole')
    balls = other_settings.table.balls
    labelled = [replace(ball, label=f'{ball.label}{"W" * 30}') for ball in balls]
    long = replace(other_settings, table=replace(other_settings.table, balls=labelled))
    htmls = {
        'report': html_of(settings, list(shots.values()), comparisons),
        'shot 3': html_of(settings, [shots[3]], [comparisons[2]]),
        'long labels': html_of(long, list(play_shots(long, (1, 4)))),
    }
    pages = {}
    for name, html in htmls.items():
        picture = base64.b64encode(PICTURE).decode()
        (folder / f'{name}.html').write_text(
            re.sub('(data:image/svg.xml;base64,)[^"]*', rf'\g<1>{picture}', html), encoding='utf-8'
        )
        pages[name] = opened.context.browser.new_page()
        pages[name].goto((folder / f'{name}.html').as_uri())
    return pages


NAMES = ['report', 'shot 3', 'long labels']


@pytest.mark.parametrize('name', NAMES)
def test_everything_fits_a_phone(whole, name):
    whole[name].set_viewport_size({'width': 390, 'height': 844})
    assert whole[name].evaluate('document.documentElement.scrollWidth') == 390
    wide = whole[name].evaluate(
        """[...document.querySelectorAll('.table, .formula, pre')]
        .filter((part) => part.scrollWidth > part.clientWidth + 1)
        .map((part) => part.innerText)"""
    )
    assert wide == []


@pytest.mark.parametrize(
    ('name', 'height'), [('shot 3', 279), ('shot 3', 290), ('shot 3', 297), ('long labels', 275)]
)
def test_no_printed_page_has_a_single_line(whole, name, height):
    assert_full_pages(whole[name], height)


@pytest.mark.soak
@pytest.mark.parametrize('height', range(270, 300))
@pytest.mark.parametrize('name', NAMES)
def test_no_printed_page_of_any_height_has_a_single_line(whole, name, height):
    assert_full_pages(whole[name], height)


def assert_full_pages(page, height):
    """Print on paper of some height, mm, and look at every page."""
    counts = lines_on_pages(page.pdf(width='210mm', height=f'{height}mm'))
    assert len(counts) > 5
    assert min(counts) >= FEWEST_LINES, counts


def test_contents_and_lists_are_printed_too(whole):
    page = whole['report']
    page.emulate_media(media='print')
    shown = page.evaluate(
        "[...document.querySelectorAll('nav')].map((list) => list.getBoundingClientRect().height)"
    )
    page.emulate_media(media='screen')
    assert len(shown) == 4
    assert min(shown) > 20


def test_a_label_is_shown_and_not_run(opened):
    assert opened.title() == 'Collisions on a pool table'
    assert f'toward ball {EVIL}' in opened.inner_text('main')


def test_its_own_style_pictures_and_films_are_there(opened):
    colors = opened.evaluate(
        "[...document.querySelectorAll('.swatch')].map((s) => getComputedStyle(s).backgroundColor)"
    )
    assert len(set(colors)) > 5
    assert opened.evaluate("getComputedStyle(document.querySelector('main')).maxWidth") != 'none'
    assert opened.evaluate('[...document.images].every((image) => image.complete)')
    wait_until(
        lambda: opened.evaluate("document.querySelector('video').readyState > 0"), 'the film'
    )


def test_no_script_that_gets_into_it_runs(opened):
    free = opened.context.browser.new_page()  # without a policy all of them run
    assert set(chromium.inject_scripts(free)) >= {'handler', 'inline', 'data', 'link'}
    assert chromium.inject_scripts(opened) == []
    assert opened.title() == 'Collisions on a pool table'
