"""The page in a real browser: Chromium, without a window."""

import os

import chromium  # first: it skips all of this where there is no browser
import numpy as np
import pytest

pytest.importorskip('aiohttp', reason='pip install aiohttp')

from browser_page import DESKTOP, PHONE  # noqa: E402
from paths import distance_to_way  # noqa: E402
from process_harness import start_node  # noqa: E402
from site_harness import simulator, web_view  # noqa: E402

from pool_sim_ros.physics import report_table  # noqa: E402

TABLE = report_table()


@pytest.fixture(scope='module')
def site(domain):
    with simulator('--ros-args', '-r', '__node:=seen'), web_view('--node', 'seen') as site:
        yield site


def test_a_drag_makes_a_shot_and_the_path_played_is_the_path_predicted(site, show):
    page = show(site.address)
    page.start_over()
    page.wait("document.getElementById('problem').hidden")
    prediction = page.drag(0.55, -0.03)
    assert len(prediction['paths']) >= 4
    # So that a collision which the browser hears of late is not yet past when it is drawn.
    page.page.select_option('#speed', '0.25')
    page.wait('page.state.real_time_factor === 0.25')
    page.record()
    page.page.mouse.up()
    ends = {path['ball']: path['points'][-1] for path in prediction['paths']}
    for ball, (x, y) in ends.items():
        page.wait(f'page.places[{2 * ball}] === {x} && page.places[{2 * ball + 1}] === {y}')
    page.wait('page.record.at(-1) === page.places')
    metre = page.get('page.painter.geometry.scale')
    drawn = np.array(page.get('page.record')).reshape(-1, len(TABLE.balls), 2)
    assert len(drawn) > 10
    for ball, way in ((path['ball'], path['points']) for path in prediction['paths']):
        off = [distance_to_way(way, place) for place in drawn[:, ball]]
        assert max(off) * metre < 1.0, f'ball {ball}'
        assert np.array_equal(drawn[-1, ball], way[-1])
    still = sorted(set(range(len(TABLE.balls))) - set(ends))
    assert np.array_equal(drawn[-1, still], TABLE.positions[still])
    assert page.page.locator('#collisions tbody tr').count() >= 4
    page.wait_for_rest()
    page.page.select_option('#speed', '1')
    page.wait('page.state.real_time_factor === 1')


def test_a_drag_that_ends_on_the_ball_or_is_escaped_shoots_nothing(site, show):
    page = show(site.address)
    page.start_over()
    page.drag(0.3, 0.0)
    page.page.mouse.move(*page.pixel(*page.get('page.places.slice(0, 2)')))
    page.page.mouse.up()
    page.drag(0.3, 0.0)
    page.press('Escape')
    page.page.mouse.up()
    assert page.get('page.aim.active') is False
    page.press('Space')
    page.wait('page.state.paused')
    assert page.get('page.state.moving || page.state.computing') is False
    page.press('Space')
    page.wait('!page.state.paused')


def test_the_buttons_reach_the_printed_positions(domain, show):
    named = ['--ros-args', '-r', '__node:=quick']
    with simulator(*named, real_time_factor=10.0), web_view('--node', 'quick') as site:
        page, other = show(site.address), show(site.address, PHONE)
        for number in '1234':
            page.wait_for_rest()
            page.page.click(f'[data-shot="{number}"]')
            for each in (page, other):
                title = f"document.getElementById('result-title').textContent.includes({number})"
                each.wait(title)
                assert '11 of 11' in each.text('verdict')
                assert each.page.locator('#positions .same').count() == 11


def test_the_keys_alone_do_everything(site, show):
    page = show(site.address)
    page.start_over()
    page.press('ArrowUp', 'ArrowLeft', 'Shift+ArrowRight', 'ArrowDown')
    assert page.get('[page.aim.active, page.aim.direction, page.aim.speed]') == [
        True,
        pytest.approx(-179.1),
        pytest.approx(3.0),
    ]
    page.wait('page.prediction')
    page.press('Enter')
    page.wait('page.state.moving')
    page.press('Space')
    page.wait('page.state.paused')
    before = page.get('page.timeline.newest.stamp')
    page.press('s')
    page.wait(f'page.timeline.newest.stamp > {before}')
    assert 'paused' in page.text('state')
    page.press('r', 'Space')
    page.wait('!page.state.paused && !page.state.moving')
    page.press('1')
    page.wait('page.state.moving')
    page.press('r')
    page.wait_for_rest()
    page.press('3')
    page.wait_for_result()
    page.page.locator('h1').click()
    reached = set()
    for _ in range(45):
        page.press('Tab')
        reached.add(page.get('document.activeElement.id || document.activeElement.dataset.shot'))
        if page.get('document.activeElement !== document.body'):
            assert page.get('getComputedStyle(document.activeElement).outlineStyle') != 'none'
    wanted = {'table', 'direction', 'strength', 'vx', 'vy', 'fine', 'shoot', '1', '4', 'pause'}
    wanted |= {'replay', 'back', 'bar', 'forward', 'replay-speed', 'undo', 'reset', 'link', 'speed'}
    wanted |= {'ball', 'place-x', 'place-y', 'place', 'take', 'axes', 'units', 'contacts'}
    assert wanted <= reached


def test_a_finger_on_a_phone(site, show):
    page = show(site.address, PHONE, has_touch=True, is_mobile=True)
    page.start_over()
    assert page.get('document.documentElement.scrollWidth') <= PHONE['width']
    assert page.get('page.painter.geometry.upright')
    ball = page.get('page.places.slice(0, 2)')
    start, end = page.pixel(*ball), page.pixel(ball[0] + 0.3, ball[1])
    before = page.get('page.places[0]')
    touch = page.page.context.new_cdp_session(page.page)
    for kind, places in (('touchStart', [start]), ('touchMove', [end]), ('touchEnd', [])):
        points = [{'x': x, 'y': y} for x, y in places]
        touch.send('Input.dispatchTouchEvent', {'type': f'{kind}', 'touchPoints': points})
    page.wait(f'page.places[0] !== {before}')
    page.wait_for_rest()


def test_speed_of_the_simulation(site, show):
    page = show(site.address)
    page.wait_for_rest()
    page.page.select_option('#speed', '2')
    page.wait('page.state.real_time_factor === 2')
    page.page.select_option('#speed', '1')
    page.wait('page.state.real_time_factor === 1')


def test_it_says_what_is_wrong_and_comes_back_by_itself(domain, show):
    named = ['--ros-args', '-r', '__node:=mortal']
    with web_view('--node', 'mortal') as site:
        page = show(site.address)
        page.wait("!document.getElementById('problem').hidden")
        assert 'No simulator answers as /mortal' in page.text('problem')
        assert page.page.locator('button:enabled').count() == 0
        with simulator(*named):
            page.wait("document.getElementById('problem').hidden")
            page.start_over()
            page.drag(0.2, 0.05)
            before = page.get('page.places[0]')
            page.page.mouse.up()
            page.wait(f'page.places[0] !== {before}')
        page.wait("document.getElementById('state').textContent === 'no simulator'")
        with simulator(*named):
            page.start_over()
            site.interrupt()
            assert site.wait() == 0
            page.wait("document.getElementById('problem').textContent.includes('lost its server')")
            with web_view('--node', 'mortal', '--port', site.address.rsplit(':', 1)[1]):
                page.wait_for_rest()
                page.press('1')
                page.wait('page.state.moving')


@pytest.mark.soak
def test_a_cold_start_says_that_it_compiles_and_a_shot_waits_visibly(
    domain, show, tmp_path, monkeypatch
):
    monkeypatch.setenv('NUMBA_CACHE_DIR', str(tmp_path))
    named = ['--ros-args', '-r', '__node:=cold']
    with start_node(*named), web_view('--node', 'cold') as site:
        page = show(site.address)
        page.wait("document.getElementById('notice').textContent.includes('about 20 s')")
        assert page.text('notice').startswith('Compiling the physics')
        assert page.page.is_visible('#notice')
        page.page.click('[data-shot="3"]')
        page.wait("document.getElementById('notice').textContent.startsWith('Your shot waits')")
        assert page.text('state') == 'waiting'
        page.wait('page.state.moving')
        page.wait("document.getElementById('notice').hidden")


EVIL = '<img src=x onerror="document.title = 1">'


def test_a_label_is_text_and_no_script_runs_that_gets_into_the_page(domain, show):
    labels = f"['C', '{EVIL}']"
    named = ['--ros-args', '-r', '__node:=evil']
    table = {
        'balls.labels': labels,
        'balls.masses': '[0.2, 0.2]',
        'balls.radii': '[0.03, 0.03]',
        'balls.positions': '[1.0, 0.5, 0.5, 0.5]',
        'balls.colors': '[1.0, 1.0, 1.0, 0.0, 0.0, 0.0]',
    }
    with simulator(*named, **table), web_view('--node', 'evil') as site:
        page = show(site.address)
        page.wait_for_rest()
        title = page.page.title()
        page.page.click('#shoot')
        page.wait("!document.getElementById('result').hidden")
        assert EVIL in page.text('positions') and EVIL in page.text('collisions')
        assert chromium.inject_scripts(page.page) == []
        assert page.page.title() == title


@pytest.mark.skipif('SCREENSHOTS' not in os.environ, reason='SCREENSHOTS names no folder')
@pytest.mark.parametrize(('name', 'size'), [('desktop', DESKTOP), ('phone', PHONE)])
@pytest.mark.parametrize('scheme', ['light', 'dark'])
def test_screenshots_for_the_eye(site, show, name, size, scheme):
    page = show(site.address, size, color_scheme=scheme)
    page.start_over()
    page.drag(0.5, 0.02)
    file = os.path.join(os.environ['SCREENSHOTS'], f'{name}_{scheme}.png')
    page.page.screenshot(path=file, full_page=True)
    page.press('Escape')
    page.page.mouse.up()
    assert os.path.getsize(file) > 0
