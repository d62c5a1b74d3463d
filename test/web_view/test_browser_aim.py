"""Numbers, ball in hand, links and sizes of the page, in a real browser."""

import chromium  # noqa: F401  # first: it skips all of this where there is no browser
import numpy as np
import pytest

pytest.importorskip('aiohttp', reason='pip install aiohttp')

from site_harness import simulator, web_view  # noqa: E402

from pool_sim_ros.physics import report_table, simulate  # noqa: E402

TABLE = report_table()


@pytest.fixture(scope='module')
def site(domain):
    named = ['--ros-args', '-r', '__node:=aims']
    with simulator(*named, real_time_factor=4.0), web_view('--node', 'aims') as site:
        yield site


@pytest.fixture
def page(site, show):
    page = show(site.address)
    page.start_over()
    return page


def value(page, field):
    return page.page.input_value(f'#{field}')


def test_a_number_is_used_and_shown_as_it_is_typed(page):
    page.fill(direction='179.94', strength='2.345')
    assert page.get('[page.aim.direction, page.aim.speed]') == [179.94, 2.345]
    page.page.focus('#table')
    assert [value(page, 'direction'), value(page, 'strength')] == ['179.94', '2.345']
    assert '179.94°  2.345 m/s' in page.get('page.aim.readout')
    page.wait('page.prediction')
    angle = np.radians(179.94)
    expected = 2.345 * np.array([np.cos(angle), np.sin(angle)])
    np.testing.assert_allclose(page.get('page.prediction.velocity'), expected, rtol=1e-15)
    assert float(value(page, 'vx')) == pytest.approx(expected[0], abs=1e-4)
    velocities = []
    for direction in ('180', '-180', '540', '-540'):
        page.fill(direction=direction)
        velocities.append(page.get('page.aim.velocity'))
    page.page.focus('#table')
    assert value(page, 'direction') == '180' and velocities == [[-2.345, 0]] * 4


REFUSED = [
    ('direction', 'north', '“north” is no number'),
    ('direction', '', 'a number is missing'),
    ('strength', '1,5', 'write 1.5'),
    ('strength', '0', 'above 0'),
    ('strength', '-1', 'at least 0'),
    ('strength', '1e999', 'is no number'),
    ('vx', '--3', 'is no number'),
]


def test_what_is_refused_says_why_and_changes_nothing(page):
    for field, text, words in REFUSED:
        before = page.get('page.aim.request')
        page.fill(**{field: text})
        assert words in page.text('refusal'), (field, text)
        assert page.get('page.aim.request') == before
        assert page.page.get_attribute(f'#{field}', 'aria-invalid') == 'true'
        page.page.focus('#table')
        page.wait('document.getElementById("refusal").textContent === ""')


def test_too_fast_a_shot_is_refused_by_the_simulator_in_words(page):
    page.fill(strength='99')
    page.page.click('#shoot')
    page.wait("document.getElementById('advice').textContent.includes('max_cue_speed')")


def test_vx_and_vy_are_struck_as_they_are_typed(page):
    page.fill(vx='-2.1', vy='0.123')
    page.shoot()
    assert page.get('page.result.velocity') == [-2.1, 0.123]
    ends = simulate(TABLE, (-2.1, 0.123)).final_positions
    assert page.get('page.places') == ends.ravel().tolist()


def test_fine_mode_takes_a_tenth_of_the_motion(page):
    page.press('ArrowLeft', 'ArrowUp')
    coarse = page.get('[page.aim.direction, page.aim.speed]')
    assert coarse == [-179, 3.1]
    page.press('f', 'ArrowLeft', 'ArrowUp')
    fine = page.get('[page.aim.direction, page.aim.speed]')
    assert fine == [-178.9, 3.11]
    assert page.page.get_attribute('#fine', 'aria-pressed') == 'true'
    ball = page.get('page.places.slice(0, 2)')
    page.page.mouse.move(*page.pixel(*ball))
    page.page.mouse.down()
    page.page.mouse.move(*page.pixel(ball[0] + 0.2, ball[1]), steps=4)
    page.page.mouse.up()
    # 6 m/s for each metre of drag, and a tenth of that.
    assert page.get('page.aim.speed') == pytest.approx(3.11 + 6 * 0.2 * 0.1, abs=5e-3)
    assert page.get('page.aim.active && !page.state.moving')
    page.press('Escape')


def test_hover_shows_coordinates_in_metres_or_inches_and_axes_can_be_switched_on(page):
    page.page.mouse.move(*page.pixel(0.5, 0.25))
    x, y = (float(part.split()[0]) for part in page.text('where').split(','))
    assert (x, y) == pytest.approx((0.5, 0.25), abs=0.005)
    page.page.select_option('#units', 'in')
    page.page.mouse.move(*page.pixel(0.508, 0.254))
    x, y = (float(part.split()[0]) for part in page.text('where').split(','))
    assert (x, y) == pytest.approx((20.0, 10.0), abs=0.2)
    assert float(value(page, 'place-x')) == pytest.approx(TABLE.positions[0][0] / 0.0254, abs=0.01)
    picture = "document.getElementById('table').toDataURL()"
    without = page.get(picture)
    page.page.check('#axes')
    page.wait('!page.dirty')
    assert page.get(picture) != without
    page.page.select_option('#units', 'm')


def ball_at(page, ball):
    return page.get(f'page.places.slice({2 * ball}, {2 * ball + 2})')


def wait_for_ball(page, ball, x, y):
    """Wait until a ball lies where a pointer, which is exact to a pixel, left it."""
    place = f'page.places[{2 * ball}] - {x}, page.places[{2 * ball + 1}] - {y}'
    page.wait(f'Math.hypot({place}) < 0.005')


def test_a_ball_is_dragged_to_where_it_shall_lie(page):
    page.page.mouse.move(*page.pixel(*TABLE.positions[9]))
    page.page.mouse.down()
    page.page.mouse.move(*page.pixel(1.6, 0.3), steps=5)
    page.page.mouse.up()
    wait_for_ball(page, 9, 1.6, 0.3)
    other = TABLE.positions[4]
    page.page.mouse.move(*page.pixel(1.6, 0.3))
    page.page.mouse.down()
    page.page.mouse.move(*page.pixel(*other), steps=5)
    assert page.get('page.hand.held.free') is False
    assert '9 cannot lie there: 4 is in the way' in page.text('advice')
    page.page.mouse.up()
    assert 'it stays where it was' in page.text('advice')
    assert ball_at(page, 9) == pytest.approx([1.6, 0.3], abs=0.005)


def test_the_cue_ball_is_dragged_where_this_is_chosen(page):
    page.page.locator('#take').scroll_into_view_if_needed()
    page.page.click('#take')
    top = page.get("document.getElementById('table').getBoundingClientRect().top")
    assert top > -1.0
    page.page.mouse.move(*page.pixel(*TABLE.positions[0]))
    page.page.mouse.down()
    page.page.mouse.move(*page.pixel(1.7, 0.8), steps=5)
    page.page.mouse.up()
    wait_for_ball(page, 0, 1.7, 0.8)
    assert page.get('page.aim.active') is False


def test_a_position_is_typed(page):
    page.page.select_option('#ball', '5')
    page.fill(place_x='1.25', place_y='0.75')
    page.page.click('#place')
    page.wait('page.places[10] === 1.25 && page.places[11] === 0.75')
    for (x, y), words in {
        ('0.01', '0.5'): '5 cannot lie there: the cushion is in the way',
        ('a', '0.5'): 'x: “a” is no number',
    }.items():
        page.fill(place_x=x, place_y=y)
        page.page.click('#place')
        assert words in page.text('place-refusal')
    assert ball_at(page, 5) == [1.25, 0.75]


def test_a_link_opens_the_same_shot(page, site, show):
    page.page.select_option('#ball', '2')
    page.fill(place_x='1.5', place_y='0.9')
    page.page.click('#place')
    page.wait('page.places[4] === 1.5')
    page.fill(vx='-3.3', vy='0.2')
    page.shoot()
    played = page.get('page.places')
    page.page.click('#link')
    page.wait("location.search.includes('vx=-3.3')")
    address = page.page.url
    page.start_over()
    other = show(address)
    other.wait('page.aim.active && page.places[4] === 1.5')
    assert other.get('page.aim.velocity') == [-3.3, 0.2]
    other.shoot()
    assert other.get('page.places') == played


SENSELESS = {
    '?vx=a&vy=0': 'vx: “a” is no number',
    '?vx=0&vy=0': 'both 0',
    '?spin=1,2,3': 'spin needs vx and vy',
    '?vx=1&vy=0&layout=C': 'layout must be',
    '?vx=1&vy=0&layout=C:1': 'must be 2 numbers',
    '?vx=1&vy=0&layout=Q:1,0.5': '"Q"',
    '?vx=1&vy=0&spin=0,0,1': 'no spin',
}


def test_a_link_that_makes_no_sense_is_refused_in_one_line(page, site):
    for search, words in SENSELESS.items():
        page.page.goto(f'{site.address}/{search}')
        page.wait("document.getElementById('advice').textContent")
        assert words in page.text('advice'), search
        assert page.get('page.places') == TABLE.positions.ravel().tolist()


PHONES = [(320, 568), (390, 844), (844, 390), (430, 932)]


@pytest.mark.parametrize(('sizes', 'phone'), [(PHONES, True), ([(768, 1024), (1440, 900)], False)])
def test_nothing_scrolls_sideways_and_a_finger_finds_everything(site, show, sizes, phone):
    size = dict(zip(('width', 'height'), sizes[0], strict=True))
    page = show(site.address, size, has_touch=phone, is_mobile=phone)
    page.start_over()
    page.press('1')
    page.wait_for_result()
    for width, height in sizes:
        page.page.set_viewport_size({'width': width, 'height': height})
        page.wait(f'innerWidth === {width} && innerHeight === {height} && !page.dirty')
        assert page.get('document.documentElement.scrollWidth') <= width
        small = page.get("""[...document.querySelectorAll('button, input, select')]
          .filter((element) => element.checkVisibility())
          .map((element) => (element.type === 'checkbox' ? element.closest('label') : element))
          .filter((element) => Math.min(element.offsetWidth, element.offsetHeight) < 44)
          .map((element) => element.id || element.textContent)""")
        assert not phone or small == [], (width, height)
        box = page.page.locator('#table').bounding_box()
        assert box['x'] >= 0 and box['x'] + box['width'] <= width and box['height'] <= height
