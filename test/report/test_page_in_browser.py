"""The report's page in a real browser, opened as a file: what it shows, and what does not run."""

from dataclasses import replace

import chromium  # first: it skips all of this where there is no browser
import pytest
from page_reader import html_of
from waiting import wait_until

from pool_sim_ros.report.outputs import write_film
from pool_sim_ros.report.played import play_shots

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
