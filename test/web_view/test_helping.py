"""A page that asks for help gets the best three shots, and one that asks again has to wait."""

import asyncio
import json
import threading

import numpy as np
import pytest
from waiting import PATIENCE

from pool_sim_ros.oracle import find_shots
from pool_sim_ros.physics import report_table
from pool_sim_ros.web_view import helping
from pool_sim_ros.web_view.helping import Helper, help_fields
from pool_sim_ros.web_view.pages import Page

TABLE = report_table()
LAYOUT = np.array(TABLE.positions)
GOAL = {'ball': '9', 'to': [0.3, 0.2], 'within': 0.3}


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    monkeypatch.setattr(helping, 'SHOTS', 3000)
    monkeypatch.setattr(helping, 'SECONDS', None)


def test_the_shots_are_the_best_three_of_a_search():
    fields = help_fields(TABLE, LAYOUT, GOAL)
    plan = find_shots(TABLE, GOAL, 'fastfiz', 3000, count=3)
    assert len(plan) == 3 and json.loads(json.dumps(fields)) == fields
    assert fields['goal'] == GOAL and fields['positions'] == LAYOUT.tolist()
    assert fields['played'] == plan.played
    for told, shot in zip(fields['shots'], plan, strict=True):
        assert told['strike'] == {'velocity': shot.velocity.tolist()}
        assert [told['chance'], told['low'], told['high']] == [shot.chance, shot.low, shot.high]


def test_a_page_that_asks_while_it_waits_is_told_so(monkeypatch):
    go, real = threading.Event(), find_shots

    def search(*args, **options):
        assert go.wait(PATIENCE)
        return real(*args, **options)

    monkeypatch.setattr(helping, 'find_shots', search)

    async def ask():
        helper, page, other = Helper(), Page(), Page()
        tasks = [
            asyncio.create_task(helper.help(asker, TABLE, LAYOUT, goal))
            for asker, goal in ((page, GOAL), (page, GOAL), (other, {'ball': '99'}))
        ]
        first = json.loads(await page.next())
        go.set()
        await asyncio.gather(*tasks)
        again = asyncio.create_task(helper.help(page, TABLE, LAYOUT, GOAL))
        await again
        return first, [json.loads(await asker.next()) for asker in (page, page, other, other)]

    first, (answer, again, nothing, problem) = asyncio.run(ask())
    assert first['kind'] == 'problem' and 'wait for its answer' in first['content']
    assert answer['kind'] == again['kind'] == 'help' and answer == again
    assert (nothing['kind'], nothing['content']) == ('help', None)
    assert problem['kind'] == 'problem' and 'is no goal' in problem['content']
