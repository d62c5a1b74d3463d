"""Help me on the page: a ball, a place, the best three shots, and one of them played."""

import chromium  # noqa: F401  # first: it skips all of this where there is no browser
import numpy as np
import pytest

pytest.importorskip('aiohttp', reason='pip install aiohttp')

from browser_page import PHONE  # noqa: E402
from site_harness import simulator, web_view  # noqa: E402

from pool_sim_ros.physics import report_table, simulate  # noqa: E402


@pytest.fixture(scope='module')
def site(domain):
    named = ['--ros-args', '-r', '__node:=helps']
    fast = {'real_time_factor': 20.0, 'report_integrator': 'event'}
    with simulator(*named, **fast), web_view('--node', 'helps') as site:
        yield site


@pytest.fixture
def page(site, show):
    page = show(site.address)
    page.start_over()
    return page


def ask(page):
    page.page.click('#help')
    page.wait('page.help.answer')


def test_the_best_three_are_listed_shown_and_one_is_played(page):
    page.page.select_option('#help-ball', '9')
    assert page.get('document.getElementById("help-where").value') == 'place'
    page.fill(help_x='0.35', help_y='0.25')
    ask(page)
    shots = page.get('page.help.answer.shots')
    lines = page.page.locator('#helped li')
    assert lines.count() == len(shots) == 3
    first = lines.nth(0).inner_text()
    assert f'{100 * shots[0]["chance"]:.0f} %' in first and 'm/s at' in first
    assert page.get('page.help.target') == {'x': 0.35, 'y': 0.25, 'within': 0.1}
    lines.nth(1).locator('button').first.click()
    page.wait('page.prediction && page.aim.active')
    velocity = shots[1]['strike']['velocity']
    np.testing.assert_array_equal(page.get('page.prediction.velocity'), velocity)
    page.page.locator('#helped li button', has_text='Play').nth(1).click()
    page.wait_for_result()
    ends = page.get('page.table.balls.map(({ label }) => page.result.final_positions[label])')
    assert np.array_equal(ends, simulate(report_table(), velocity).final_positions)
    page.wait('!page.help.answer')  # the balls lie elsewhere
    assert lines.count() == 0 and page.get('page.help.target') is None


def test_a_place_is_picked_on_the_table_and_nothing_else_happens(page):
    page.page.click('#pick')  # which brings the table into the window
    page.page.mouse.click(*page.pixel(0.6, 0.3))
    values = [float(page.page.input_value(f'#help-{axis}')) for axis in 'xy']
    assert values == pytest.approx([0.6, 0.3], abs=0.01)
    assert page.get('page.aim.active') is False and page.get('page.hand.held') is None
    assert page.page.get_attribute('#pick', 'aria-pressed') == 'false'


@pytest.mark.parametrize(
    ('x', 'element', 'words'),
    [('north', 'help-words', '“north” is no number'), ('9', 'advice', 'is off the cloth')],
)
def test_a_place_that_cannot_be_is_told(page, x, element, words):
    page.fill(help_x=x)
    page.page.click('#help')
    page.wait(f'document.getElementById("{element}").textContent.includes("{words}")')
    page.wait('!page.help.searching && !document.getElementById("help").disabled')


def test_it_fits_a_phone(site, show):
    page = show(site.address, PHONE)
    page.start_over()
    ask(page)
    assert page.get('document.documentElement.scrollWidth <= innerWidth')
    for button in page.page.locator('#helping button:visible').all():
        box = button.bounding_box()
        assert box['height'] >= 43 and box['x'] >= 0 and box['x'] + box['width'] <= 390
