"""What a shot did, and what can be done with it, in a real browser: the table of the report."""

import chromium  # noqa: F401  # first: it skips all of this where there is no browser
import numpy as np
import pytest

pytest.importorskip('aiohttp', reason='pip install aiohttp')

from browser_page import PHONE  # noqa: E402
from site_harness import simulator, web_view  # noqa: E402

from pool_sim_ros.me212 import cue_velocity  # noqa: E402
from pool_sim_ros.physics import EventKind, report_table, simulate  # noqa: E402

TABLE = report_table()
FRAME = 1 / 60
CUSHIONS = ('left', 'right', 'bottom', 'top')


@pytest.fixture(scope='module')
def site(domain):
    named = ['--ros-args', '-r', '__node:=shots']
    with simulator(*named, real_time_factor=4.0), web_view('--node', 'shots') as site:
        yield site


@pytest.fixture
def page(site, show):
    """Return a page on which shot 1 of the report is over."""
    page = show(site.address)
    page.start_over()
    page.press('1')
    page.wait_for_result()
    return page


def shot(number, integrator='time_slice'):
    return simulate(TABLE, cue_velocity(number, TABLE), integrator=integrator)


def paths(page):
    return {path['ball']: np.array(path['points']) for path in page.get('page.strike.paths')}


def test_paths_stay_until_the_next_strike(page):
    played = shot(1)
    drawn = paths(page)
    moved = np.flatnonzero(np.any(played.final_positions != TABLE.positions, axis=1))
    assert sorted(drawn) == moved.tolist()
    for ball, path in drawn.items():
        assert np.array_equal(path[0], TABLE.positions[ball])
        assert np.array_equal(path[-1], played.final_positions[ball])
    page.press('u')
    start = TABLE.positions.ravel().tolist()
    page.wait(f'page.places.every((place, i) => place === {start}[i])')
    page.wait('page.standing && document.getElementById("result").hidden')
    assert sorted(paths(page)) == sorted(drawn)
    page.press('3')
    page.wait_for_result()
    ends = {ball: path[-1].tolist() for ball, path in paths(page).items()}
    other = shot(3).final_positions
    assert ends and all(end == other[ball].tolist() for ball, end in ends.items())


def test_the_bar_shows_any_time_of_the_shot(page):
    played = shot(1)
    for frame in (0, 7, 40, 90):
        page.scrub(frame)
        expected = played.positions(min(frame * FRAME, played.duration)).ravel()
        np.testing.assert_allclose(page.get('page.shown'), expected, rtol=0, atol=1e-9)
    page.scrub(10)
    page.press('.', '.', ',')
    page.wait('!page.dirty')
    assert page.get('page.replay.time') == pytest.approx(11 * FRAME)
    np.testing.assert_allclose(
        page.get('page.shown'), played.positions(11 * FRAME).ravel(), rtol=0, atol=1e-9
    )
    assert '0.183 of 1.519 s' in page.text('when')
    later = page.page.locator('#collisions tr.later').count()
    contacts = played.events[played.events['kind'] != EventKind.STOP]
    assert later == np.count_nonzero(contacts['t'] > 11 * FRAME) > 0


def test_the_keys_alone_scrub_replay_and_undo(page):
    page.page.focus('#bar')
    page.press('Home', 'ArrowRight', 'ArrowRight', 'ArrowRight', 'ArrowLeft')
    assert page.get('page.replay.time') == pytest.approx(2 * FRAME)
    assert page.page.get_attribute('#bar', 'aria-valuetext') == '0.033 of 1.519 s'
    page.press('End')
    assert page.get('page.replay.time') == page.get('page.strike.shot.duration')
    page.page.focus('#table')
    page.press('p')
    page.wait('page.replay.playing')
    page.press('Escape')
    page.wait('page.replay.time === null')
    page.press('u')
    start = TABLE.positions.ravel().tolist()
    page.wait(f'page.places.every((place, i) => place === {start}[i])')
    page.wait('page.strike.rewound')
    assert page.text('when').startswith('0.000 of')


def test_replay_plays_at_a_chosen_speed_to_the_end(page):
    page.page.select_option('#replay-speed', '0.5')
    page.page.click('#replay')
    page.wait('page.replay.playing && page.replay.time > 0.1')
    assert page.text('replay') == 'Stop'
    page.page.select_option('#replay-speed', '5')
    page.wait('!page.replay.playing')
    assert page.get('page.replay.time') == page.get('page.strike.shot.duration')


def test_a_strike_ends_a_replay(page):
    page.scrub(10)
    page.press('2')
    page.wait('page.replay.time === null')
    page.wait_for_result()


def test_all_contacts_are_listed_in_words_by_time_since_the_strike(page):
    events = shot(1).events
    events = events[events['kind'] != EventKind.STOP]
    listed = [
        [cell.strip() for cell in row.split('\t')]
        for row in page.page.locator('#collisions tbody tr').all_inner_texts()
    ]
    labels = TABLE.labels
    assert listed == [
        [
            f'{event["t"]:.3f}',
            f'{labels[event["a"]]} hits {labels[event["b"]]}'
            if event['kind'] == EventKind.BALL_BALL
            else f'{labels[event["a"]]} off the {CUSHIONS[event["b"]]} cushion',
            f'{event["speed"]:.2f}',
        ]
        for event in events
    ]


def test_upright_the_cushions_are_named_as_they_are_seen(page, site, show):
    phone = show(site.address, PHONE)
    phone.wait('page.strike.shot && page.places')
    assert phone.get('page.painter.geometry.upright')
    words = '[0, 1, 2, 3].map((row) => page.words.cushion(row, 0, 0))'
    assert phone.get(words) == [f'{side} cushion' for side in ('top', 'bottom', 'left', 'right')]
    assert page.get(words) == [f'{side} cushion' for side in CUSHIONS]


def test_print_and_exact_result_are_drawn_over_one_another_with_the_reason(page):
    page.press('4')
    page.wait('page.result && page.result.shot === 4 && page.strike.shot?.shot === 4')
    page.wait('page.standing')
    assert page.page.is_visible('#print')
    assert 'rounding error' in page.text('reason') and page.text('reason').count('.') == 2
    printed, exact = shot(4), shot(4, 'event')
    ends = {path['ball']: path['points'][-1] for path in page.get('page.strike.exact')}
    assert ends == {ball: exact.final_positions[ball].tolist() for ball in ends}
    off = np.abs(exact.final_positions - printed.final_positions).max(axis=1)
    assert off.argmax() in ends and off.max() > 0.05
    picture = "document.getElementById('table').toDataURL()"
    both = page.get(picture)
    page.page.uncheck('#exact')
    page.wait('!page.dirty')
    assert page.get(picture) != both


def test_results_stand_beside_no_layout_but_their_own(page, site, show):
    assert page.page.is_visible('#result')
    assert page.text('result-title') == 'Shot 1 of the report'
    page.start_over()
    page.wait('document.getElementById("result").hidden')
    assert not page.page.is_visible('#print')
    late = show(site.address)
    late.wait_for_rest()
    late.wait('page.result && document.getElementById("result").hidden')


def test_tables_have_headers_and_words_are_announced(page):
    page.wait(
        'document.getElementById("announcement").textContent.includes("Shot 1 of the report")'
    )
    assert '11 of 11 balls as printed' in page.text('announcement')
    for table in ('collisions', 'positions'):
        assert page.page.locator(f'#{table} thead th[scope=col]').count() >= 3
    assert page.page.locator('#positions tbody th[scope=row]').count() == 11
    page.press('ArrowLeft')
    page.wait('document.getElementById("announcement").textContent.startsWith("Aim -179°  3 m/s")')
    assert page.page.get_attribute('#table', 'role') == 'application'
    assert page.page.get_attribute('#state', 'aria-live') == 'polite'
    page.press('Escape')
