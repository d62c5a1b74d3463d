"""What each open page is sent, and when."""

import asyncio
import json

from pool_sim_ros.web_view.pages import LONGEST_QUEUE, Pages


def drain(page):
    """Return everything that the page would be sent now."""

    async def take():
        items = []
        while True:
            try:
                items.append(await asyncio.wait_for(page.next(), 0.01))
            except asyncio.TimeoutError:
                return items

    return asyncio.run(take())


def contents(page):
    return [i if isinstance(i, bytes) else json.loads(i)['content'] for i in drain(page)]


def test_texts_come_in_order_and_of_the_frames_the_latest():
    pages = Pages()
    page = pages.open()
    pages.show(b'1')
    pages.tell('state', 'first')
    pages.show(b'2')
    pages.tell('state', 'second')
    assert contents(page) == ['first', 'second', b'2']


def test_a_late_page_is_told_what_was_kept():
    pages = Pages()
    pages.tell('state', 'old', keep=True)
    pages.tell('state', 'new', keep=True)
    pages.tell('result', 'gone', keep=True)
    pages.tell('collisions', 'past')
    pages.show(b'frame')
    pages.forget('result')
    assert contents(pages.open()) == ['new', b'frame']


def test_a_closed_page_is_told_nothing():
    pages = Pages()
    page = pages.open()
    pages.close(page)
    pages.tell('state', 'unheard')
    assert contents(page) == []


def test_a_page_that_is_too_slow_is_given_up_and_the_others_are_not():
    pages = Pages()
    slow, quick = pages.open(), pages.open()
    for _ in range(LONGEST_QUEUE + 1):
        pages.tell('collisions', [])
        quick._texts.clear()
    assert slow.lost and not quick.lost
