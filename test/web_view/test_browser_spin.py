"""Balls that spin and fall into pockets, in a real browser: a seven-foot table."""

import chromium  # noqa: F401  # first: it skips all of this where there is no browser
import numpy as np
import pytest

pytest.importorskip('aiohttp', reason='pip install aiohttp')

from browser_page import PHONE  # noqa: E402
from paths import distance_to_way  # noqa: E402
from site_harness import simulator, web_view  # noqa: E402

from pool_sim_ros.physics import EventKind, cue_strike, pool_table, simulate  # noqa: E402

TABLE = pool_table('7ft')
BREAK = {'strength': '9', 'direction': '179.2'}


@pytest.fixture(scope='module')
def site(domain):
    named = ['--ros-args', '-r', '__node:=spins', '-p', 'table.preset:=7ft']
    with simulator(*named, real_time_factor=10.0), web_view('--node', 'spins') as site:
        yield site


@pytest.fixture
def page(site, show):
    page = show(site.address)
    page.start_over()
    return page


def broken(**cue):
    """Return the shot that a stroke makes of the rack."""
    velocity, spin = cue_strike(TABLE, **cue)
    return simulate(TABLE, velocity, spins=spin)


def test_a_stroke_with_spin_is_played_as_it_is_predicted(page):
    page.fill(strength='2.5', direction='150', side='0.2', above='-0.4', elevation='20')
    request = {'speed': 2.5, 'azimuth': 150, 'elevation': 20, 'side': 0.2, 'above': -0.4}
    assert page.get('page.aim.request') == {'cue': request}
    page.wait('page.prediction && page.prediction.asked.cue.elevation === 20')
    prediction = page.get('page.prediction')
    page.page.select_option('#speed', '0.5')
    page.wait('page.state.real_time_factor === 0.5')
    page.record()
    page.page.click('#shoot')
    page.wait('page.strike.first !== null')  # from now on the page knows its clock
    page.page.select_option('#speed', '5')
    page.wait_for_result()
    expected = broken(**request)
    assert page.get('page.places') == expected.final_positions.ravel().tolist()
    drawn = np.array(page.get('page.record')).reshape(-1, len(TABLE.balls), 2)
    metre = page.get('page.painter.geometry.scale')
    ways = {path['ball']: path['points'] for path in prediction['paths']}
    assert 0 in ways and len(ways[0]) > 10, 'the path is curved'
    for ball, way in ways.items():
        off = max(distance_to_way(way, place) for place in drawn[:, ball])
        assert off * metre < 1.0, f'ball {ball}'
    page.page.select_option('#speed', '10')
    page.wait('page.state.real_time_factor === 10')


def test_the_target_says_where_the_tip_hits(page):
    page.page.locator('#target').scroll_into_view_if_needed()
    box = page.page.locator('#target').bounding_box()
    radius = box['width'] / 2 / 1.04
    middle = box['x'] + box['width'] / 2, box['y'] + box['height'] / 2
    page.page.mouse.click(middle[0] - 0.3 * radius, middle[1] + 0.2 * radius)
    side, above = page.get('[page.aim.side, page.aim.above]')
    assert (side, above) == pytest.approx((0.3, -0.2), abs=0.03)
    assert page.page.input_value('#side') == str(side)
    page.page.mouse.click(middle[0] + 0.9 * radius, middle[1])
    side, above = page.get('[page.aim.side, page.aim.above]')
    assert -0.5 <= side < -0.49
    page.page.focus('#target')
    page.press('ArrowUp', 'ArrowLeft')
    assert page.get('[page.aim.side, page.aim.above]') == pytest.approx([-0.45, 0.05], abs=0.01)
    page.fill(side='0.4', above='0.4')
    assert 'the tip slips off' in page.text('refusal')
    page.page.click('#center')
    assert page.get('[page.aim.side, page.aim.above]') == [0, 0]


def test_a_break_turns_the_balls_and_lists_what_falls(page, site, show):
    page.fill(**BREAK)
    page.shoot()
    expected = broken(speed=9.0, azimuth=179.2)
    fallen = np.flatnonzero(expected.pocketed >= 0)
    assert len(fallen), 'nothing falls: choose another break'
    assert page.get('page.places') == expected.final_positions.ravel().tolist()
    assert set(page.text('pocketed').split()) == {TABLE.labels[ball] for ball in fallen}
    assert np.flatnonzero(page.get('page.sunk')).tolist() == fallen.tolist()
    events = expected.events
    fell = int(np.count_nonzero(events['kind'] == EventKind.POCKETED))
    words = page.page.locator('#collisions tbody tr').all_inner_texts()
    assert sum('into the' in text for text in words) == fell == len(fallen)
    for frame in (0, 30, 100, 1000):
        page.scrub(frame)
        time = min(page.get('page.replay.time'), expected.duration)
        np.testing.assert_allclose(
            page.get('page.shown'), expected.positions(time).ravel(), rtol=0, atol=1e-9
        )
        turns = np.array(page.get('page.strike.shot.turnsAt(page.replay.time)'))
        alike = np.abs(np.sum(turns * expected.orientations(time), axis=1))
        assert alike.min() > np.cos(0.01 / 2), 'within 0.01 rad'
        caught = events[(events['kind'] == EventKind.POCKETED) & (events['t'] <= time)]['a']
        sunk = page.get('page.strike.shot.sunk(page.replay.time)')
        assert np.flatnonzero(sunk).tolist() == sorted(caught.tolist())
    late = show(site.address)
    late.wait('page.standing && page.strike.shot && page.strike.shot.turns')
    turns = np.array(late.get('page.strike.shot.turnsAt(0.5)'))
    alike = np.abs(np.sum(turns * expected.orientations(0.5), axis=1))
    assert alike.min() > np.cos(0.01 / 2), 'within 0.01 rad'


def test_a_cue_ball_in_a_pocket_is_put_back_by_hand(page):
    page.fill(**BREAK)
    page.shoot()
    assert broken(speed=9.0, azimuth=179.2).pocketed[0] >= 0
    page.wait('!document.getElementById("notice").hidden')
    assert 'The cue ball is in a pocket' in page.text('notice')
    assert page.page.is_disabled('#shoot')
    page.press('ArrowLeft')
    assert page.get('page.aim.active') is False
    page.get('scrollTo(0, 0)')
    page.page.mouse.move(*page.pixel(*page.get('page.places.slice(0, 2)')))
    page.page.mouse.down()
    page.page.mouse.move(*page.pixel(1.5, 0.3), steps=5)
    page.page.mouse.up()
    page.wait('page.sunk && !page.sunk[0] && !document.getElementById("shoot").disabled')
    assert page.get('page.places.slice(0, 2)') == pytest.approx([1.5, 0.3], abs=0.02)
    page.wait('document.getElementById("notice").hidden')


def test_the_shots_of_the_report_are_not_offered_here(page):
    assert not page.page.is_visible('#shots')
    page.press('1')
    page.wait('page.words')
    assert page.get('page.state.moving || page.state.computing') is False


def test_undo_takes_balls_out_of_the_pockets(page):
    page.fill(**BREAK)
    page.shoot()
    page.page.click('#undo')
    start = TABLE.positions.ravel().tolist()
    page.wait(f'page.places.every((place, i) => place === {start}[i])')
    assert not any(page.get('page.sunk'))


def test_a_link_keeps_the_spin(page, site, show):
    page.fill(strength='2', direction='170', side='-0.3', above='0.2')
    page.shoot()
    played = page.get('page.places')
    page.page.click('#link')
    page.wait("location.search.includes('spin=')")
    address = page.page.url
    page.start_over()
    other = show(address)
    other.wait('page.aim.active')
    other.shoot()
    assert other.get('page.places') == played


def test_on_a_phone(site, show):
    page = show(site.address, PHONE, has_touch=True, is_mobile=True)
    page.start_over()
    for width, height in ((320, 568), (390, 844), (844, 390)):
        page.page.set_viewport_size({'width': width, 'height': height})
        page.wait(f'innerWidth === {width} && innerHeight === {height}')
        assert page.get('document.documentElement.scrollWidth') <= width
        box = page.page.locator('#target').bounding_box()
        assert min(box['width'], box['height']) >= 44
