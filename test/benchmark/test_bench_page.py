"""The page in the browser: how often it draws, and what its server takes, while the balls roll."""

import os
import time

import numpy as np
import pytest
from benchmark.test_bench_node import processor_seconds

browser_tests = pytest.importorskip(
    'web_view.test_browser', reason='Chromium or playwright is missing'
)
import chromium  # noqa: E402
from site_harness import simulator, web_view  # noqa: E402

SECTION = 'The page in the browser'
ROUNDS, SECONDS = 3, 5.0
SMOOTH = {'table.mu_ball_surface': 0.01, 'report_integrator': 'event'}  # a shot lasts longer


def test_rolling_balls(domain, results):
    rates, shares = [], []
    with (
        simulator(**SMOOTH),
        web_view() as site,
        chromium.open_browser() as browser,
    ):
        page = browser_tests.Page(browser.new_page(viewport=browser_tests.DESKTOP))
        page.page.goto(site.address)
        page.wait_for_rest()
        for _ in range(ROUNDS):
            page.wait_for_rest()
            page.press('1')
            page.wait('page.state.moving')
            start, used, drawn = time.monotonic(), processor_seconds(site), page.get('page.drawn')
            page.page.wait_for_timeout(SECONDS * 1e3)
            took = time.monotonic() - start
            shares.append((processor_seconds(site) - used) / took)
            rates.append((page.get('page.drawn') - drawn) / took)
            assert page.get('page.state.moving'), 'the shot is too short'
    load = f'(load {os.getloadavg()[0]:.1f})'
    rate = f'{np.median(rates):.1f} frames a second {load}'
    results.note(SECTION, 'drawn, of 60 a second', rate, '55')
    results.note(SECTION, 'processor of its server', f'{np.median(shares):.1%} {load}', '5 %')
