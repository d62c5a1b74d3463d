"""The page in the browser: how often it draws, and what its server takes, while the balls roll."""

import os
import time

import chromium  # first: it skips all of this where there is no browser
import numpy as np
import pytest
from benchmark.test_bench_node import processor_seconds
from browser_page import DESKTOP, Page
from site_harness import simulator, web_view

SECTION = 'The page in the browser'
ROUNDS, SECONDS = 3, 5.0
POOL = {'table.preset': '7ft'}
SMOOTH = {'table.mu_ball_surface': 0.01, 'report_integrator': 'event'}  # a shot lasts longer


def test_scrubbing_a_break(domain, results):
    rates = []
    with (
        simulator('--ros-args', '-p', 'table.preset:=7ft', real_time_factor=10.0),
        web_view() as site,
        chromium.open_browser() as browser,
    ):
        page = Page(browser.new_page(viewport=DESKTOP))
        page.page.goto(site.address)
        page.start_over()
        page.fill(strength='8')
        page.shoot()
        for _ in range(ROUNDS):
            start, drawn = time.monotonic(), page.get('page.drawn')
            page.get("""async () => {
              const bar = document.getElementById('bar');
              const end = performance.now() + 3000;
              for (let frame = 0; performance.now() < end; frame += 1) {
                bar.value = (3 * frame) % Number(bar.max);
                bar.dispatchEvent(new Event('input'));
                await new Promise(requestAnimationFrame);
              }
            }""")
            rates.append((page.get('page.drawn') - drawn) / (time.monotonic() - start))
    load = f'(load {os.getloadavg()[0]:.1f})'
    rate = f'{np.median(rates):.1f} frames a second {load}'
    results.note(SECTION, 'drawn while 16 balls are scrubbed, of 60 a second', rate, '55')


@pytest.mark.parametrize(
    ('what', 'options', 'strength'),
    [("the report's balls", SMOOTH, '3'), ('a break on 7 feet', POOL, '8')],
)
def test_rolling_balls(domain, results, what, options, strength):
    rates, shares = [], []
    with (
        simulator(**options),
        web_view() as site,
        chromium.open_browser() as browser,
    ):
        page = Page(browser.new_page(viewport=DESKTOP))
        page.page.goto(site.address)
        page.wait_for_rest()
        for _ in range(ROUNDS):
            page.start_over()
            page.fill(strength=strength)
            page.page.click('#shoot')
            page.wait('page.state.moving')
            since, used, drawn = time.monotonic(), processor_seconds(site), page.get('page.drawn')
            page.page.wait_for_timeout(SECONDS * 1e3)
            took = time.monotonic() - since
            shares.append((processor_seconds(site) - used) / took)
            rates.append((page.get('page.drawn') - drawn) / took)
            assert page.get('page.state.moving'), 'the shot is too short'
            page.wait_for_rest()
    load = f'(load {os.getloadavg()[0]:.1f})'
    rate = f'{np.median(rates):.1f} frames a second {load}'
    results.note(SECTION, f'{what}: drawn, of 60 a second', rate, '55')
    share = f'{np.median(shares):.1%} {load}'
    results.note(SECTION, f'{what}: processor of its server', share, '5 %')
