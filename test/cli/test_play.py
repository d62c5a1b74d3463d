"""`make play`: simulator and page together."""

import asyncio
import re
import signal

import pytest

pytest.importorskip('aiohttp', reason="aiohttp is missing: pip install 'pool_sim_ros[web]'")

from process_harness import Process  # noqa: E402
from site_harness import talk  # noqa: E402


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_it_prints_the_address_of_a_page_that_plays_and_ends_both(domain, number):
    with Process('cli.play', '--port', '0') as both:
        both.wait_for('shows')
        address = re.search(r'http://\S+', both.stdout)[0]

        async def play():
            async with talk(address) as page:
                await page.hear('state')
                await page.hear('frame')
                await page.say(do='shot', number=3)
                await page.hear('response', lambda response: response['phase'] == 'accepted')
                both.signal(number)
                both.signal(number)  # as an impatient user does
                await page.closed()

        asyncio.run(play())
        assert both.wait() == 0
        assert f'ROS_DOMAIN_ID={domain}' in both.stdout and 'Traceback' not in both.stderr


def test_where_one_cannot_start_the_other_ends_too(domain):
    with Process('cli.play', '--port', '99999') as both:
        assert both.wait() == 1
        assert '99999' in both.stderr
