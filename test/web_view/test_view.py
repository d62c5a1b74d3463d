"""What the pages are shown and what they may ask for, with a bridge that leads nowhere."""

import asyncio
import json
import threading

import numpy as np
import pytest
from plain_messages import to_collisions, to_poses
from rclpy.serialization import serialize_message
from waiting import PATIENCE

from pool_sim_ros.me212 import published_final_positions
from pool_sim_ros.physics import compile_kernels, report_table, simulate
from pool_sim_ros.ros import interface, messages
from pool_sim_ros.simulator import Phase, Response, table_to_json
from pool_sim_ros.web_view import view as module
from pool_sim_ros.web_view.bridge import NoAnswerError
from pool_sim_ros.web_view.view import View

TABLE = report_table()
RESTING = {'paused': False, 'moving': False, 'computing': False, 'tick': 3}
DONE = Response(
    'x',
    Phase.DONE,
    shot=2,
    velocity=(-4.0, 0.0),
    integrator='time_slice',
    t_start=1.0,
    t_end=2.0,
    final_positions={'C': [0.5, 0.5]},
    final_positions_in={'C': [19.69, 19.69]},
    as_printed=True,
)


class FakeBridge:
    """Keeps what it is asked for, and answers as it is told to."""

    simulator = '/pool_sim'

    def __init__(self, context, simulator, listener):
        self.matched = True
        self.poses = None
        self.asked = []
        self.answer = True, ''
        self.complaints = []

    def is_matched(self):
        return self.matched

    def latest_poses(self):
        poses, self.poses = self.poses, None
        return poses

    async def request(self, **fields):
        self.asked.append(fields)

    async def call(self, service, **fields):
        self.asked.append((service.name, fields))
        return self.answer

    async def set_parameter(self, name, value):
        self.asked.append((name, value))
        return self.answer

    def left_out(self, error):
        self.complaints.append(error)

    def close(self):
        self.closed = True


class Site:
    """A view, its bridge and a page that is open from the beginning."""

    def __init__(self):
        self.view = View(None, 'pool_sim')
        self.bridge = self.view._bridge
        self.page = self.view.pages.open()

    async def obey(self, **fields):
        await self.view.obey(self.page, json.dumps(fields))

    def state(self, **changes):
        self.view.on_state(messages.to_json_string(RESTING | changes))

    def respond(self, **changes):
        self.view.on_response(messages.to_json_string(json.loads(DONE.to_json()) | changes))

    async def heard(self, page=None):
        """Return all that a page is to be sent, by kind."""
        found = {}
        while True:
            try:
                item = await asyncio.wait_for((page or self.page).next(), 0.05)
            except asyncio.TimeoutError:
                return found
            if isinstance(item, bytes):
                found.setdefault('frame', []).append(np.frombuffer(item, '<f8'))
            else:
                fields = json.loads(item)
                found.setdefault(fields['kind'], []).append(fields['content'])


@pytest.fixture(autouse=True)
def no_ros(monkeypatch):
    monkeypatch.setattr(module, 'Bridge', FakeBridge)


def on_site(use):
    async def within():
        site = Site()
        try:
            return await asyncio.wait_for(use(site), PATIENCE)
        finally:
            site.view.close()
            assert site.bridge.closed

    return asyncio.run(within())


def test_without_a_simulator_the_pages_are_told_and_can_ask_for_nothing():
    async def use(site):
        await site.obey(do='shot', number=1)
        return site.bridge.asked, await site.heard()

    asked, heard = on_site(use)
    assert asked == []
    [told], [problem] = heard['simulator'], heard['problem']
    assert told == {'name': '/pool_sim', 'problem': problem}
    assert 'No simulator answers as /pool_sim' in problem


def test_a_simulator_is_there_once_it_hears_too():
    async def use(site):
        site.bridge.matched = False
        site.state()
        before = await site.heard()
        site.bridge.matched = True
        site.state()
        return before, await site.heard()

    before, after = on_site(use)
    assert 'state' not in before
    assert after['state'] == [RESTING]
    assert after['simulator'] == [{'name': '/pool_sim', 'problem': None}]


@pytest.mark.parametrize(
    ('wish', 'asked'),
    [
        ({'do': 'shot', 'number': 3}, {'shot': 3}),
        ({'do': 'strike', 'velocity': [-4.0, 0.5]}, {'velocity': [-4.0, 0.5]}),
        ({'do': 'place', 'places': {'9': [1.0, 0.5]}}, {'place': {'9': [1.0, 0.5]}}),
        ({'do': 'pause', 'paused': True}, (interface.SET_PAUSED.name, {'data': True})),
        ({'do': 'step'}, (interface.STEP.name, {})),
        ({'do': 'reset'}, (interface.RESET.name, {})),
        ({'do': 'speed', 'factor': 2}, ('real_time_factor', 2.0)),
    ],
)
def test_a_wish_is_passed_on(wish, asked):
    async def use(site):
        site.state()
        await site.obey(**wish)
        return site.bridge.asked, await site.heard()

    passed, heard = on_site(use)
    assert passed == [asked] and 'problem' not in heard


def test_a_wish_that_is_refused_or_makes_no_sense_is_told_to_its_page_alone():
    async def use(site):
        site.state()
        other = site.view.pages.open()
        site.bridge.answer = False, 'only a paused table can be stepped'
        await site.obey(do='step')
        await site.obey(do='dance')

        async def silent(service):
            raise NoAnswerError('/pool_sim does not answer')

        site.bridge.call = silent
        await site.obey(do='reset')
        return await site.heard(), await site.heard(other)

    heard, other = on_site(use)
    refused, nonsense, unanswered = heard['problem']
    assert refused == 'only a paused table can be stepped'
    assert 'do must be one of' in nonsense
    assert unanswered == '/pool_sim does not answer'
    assert 'problem' not in other


def test_the_end_of_a_shot_of_the_report_comes_with_what_was_printed_also_for_late_pages():
    async def use(site):
        site.respond()
        return await site.heard(), await site.heard(site.view.pages.open())

    heard, late = on_site(use)
    printed = {k: list(place) for k, place in published_final_positions()[2].items()}
    assert heard['response'] == heard['result'] == late['result']
    assert heard['result'][0]['printed'] == printed
    assert 'response' not in late


@pytest.mark.parametrize('changes', [{'as_printed': False}, {'shot': None}, {'phase': 'accepted'}])
def test_any_other_response_comes_without(changes):
    async def use(site):
        site.respond(**changes)
        return await site.heard()

    heard = on_site(use)
    assert heard['response'][0]['printed'] is None
    assert ('result' in heard) == (changes.get('phase') is None)


def test_other_balls_than_the_printed_ones_are_not_compared_with_them():
    async def use(site):
        with pytest.raises(ValueError, match='other balls'):
            site.respond(final_positions_in={'C': [1.0, 1.0], 'Z': [2.0, 2.0]})
        return await site.heard()

    assert not {'response', 'result'} & set(on_site(use))


@pytest.mark.parametrize(
    'changes',
    [
        {'final_positions_in': {'C': [1.0]}},
        {'final_positions_in': None},
        {'velocity': 'x'},
        {'phase': 'over'},
        {'reason': ['x']},
    ],
)
def test_a_response_that_a_page_could_not_show_does_not_reach_it(changes):
    async def use(site):
        with pytest.raises(ValueError):
            site.respond(**changes)
        return await site.heard()

    assert not {'response', 'result'} & set(on_site(use))


COLLISIONS = np.array(
    [
        [0, 0.5, 0, 0, 10, 1.0, 0.5, 1.0, 0.0, 2.5],
        [1, 0.6, 1, 3, 2, 1.0, 0.0, 0.0, -1.0, 0.5],
    ]
)


def changed(row, column, value):
    rows = COLLISIONS.copy()
    rows[row, column] = value
    return rows


def test_collisions_are_shown_once_the_table_is_known():
    async def use(site):
        site.view.on_collisions(to_collisions(COLLISIONS))
        site.view.on_table(messages.to_string(table_to_json(TABLE)))
        site.view.on_collisions(to_collisions(COLLISIONS))
        return await site.heard(), site.bridge.complaints

    heard, complaints = on_site(use)
    assert heard['collisions'] == [COLLISIONS.tolist()] and complaints == []


@pytest.mark.parametrize(
    'rows',
    [
        changed(0, 1, np.nan),
        changed(1, 9, np.inf),
        changed(0, 3, 11),
        changed(0, 4, 11),
        changed(1, 3, -1),
        changed(1, 3, 0.5),
        changed(1, 4, -1),
    ],
)
def test_what_are_no_collisions_is_left_out(rows):
    async def use(site):
        site.view.on_table(messages.to_string(table_to_json(TABLE)))
        site.view.on_collisions(to_collisions(rows))
        return await site.heard(), site.bridge.complaints

    heard, complaints = on_site(use)
    assert 'collisions' not in heard and len(complaints) == 1


def test_a_simulator_that_falls_silent_is_gone_and_so_is_what_it_showed(monkeypatch):
    monkeypatch.setattr(module, 'SILENCE', 1)

    async def use(site):
        site.state()
        site.respond()
        await site.heard()
        heard = {}
        while 'simulator' not in heard:
            heard |= await site.heard()
        return heard, await site.heard(site.view.pages.open())

    heard, late = on_site(use)
    assert 'No simulator answers' in heard['simulator'][0]['problem']
    assert set(late) == {'simulator'}


async def with_everything(site, moving=False):
    """Show the site a table, its balls and its state, and wait until it can predict."""
    site.state(moving=moving)
    site.view.on_table(messages.to_string(table_to_json(TABLE)))
    poses = to_poses('table', 1_500_000_000, TABLE.positions, TABLE.radii.tolist())
    site.bridge.poses = serialize_message(poses)
    heard = {}
    while not {'predicts', 'frame', 'table'} <= set(heard):
        heard |= await site.heard()
    return heard


def test_table_and_frames_are_shown():
    async def use(site):
        return await with_everything(site)

    heard = on_site(use)
    assert heard['frame'][0][0] == 1.5
    assert np.array_equal(heard['frame'][0][1:], TABLE.positions.ravel())
    assert [ball['label'] for ball in heard['table'][0]['balls']] == list(TABLE.labels)


def test_poses_that_are_none_are_left_out():
    async def use(site):
        site.bridge.poses = b'\0\1'
        while not site.bridge.complaints:
            await asyncio.sleep(0.005)
        return await site.heard()

    assert 'frame' not in on_site(use)


@pytest.mark.parametrize('places', [TABLE.positions[:10], TABLE.positions * np.nan])
def test_poses_of_other_balls_or_of_none_are_left_out(places):
    async def use(site):
        await with_everything(site)
        poses = to_poses('table', 2_000_000_000, places, [0.05] * len(places))
        site.bridge.poses = serialize_message(poses)
        while not site.bridge.complaints:
            await asyncio.sleep(0.005)
        return await site.heard()

    assert 'frame' not in on_site(use)


def test_who_aims_is_told_the_paths():
    compile_kernels(TABLE)

    async def use(site):
        await with_everything(site)
        await site.obey(do='aim', velocity=[-4.0, 0.0])
        await site.obey(do='aim', velocity=[0.0, 0.0])
        return await site.heard(), site.bridge.asked

    heard, asked = on_site(use)
    prediction, nothing = heard['prediction']
    assert prediction['velocity'] == [-4.0, 0.0] and prediction['segments'][0][:2] == [0.0, 0.0]
    assert nothing is None and asked == []


def test_who_asks_for_help_is_told_the_shots_and_meanwhile_does_other_things(monkeypatch):
    monkeypatch.setattr('pool_sim_ros.web_view.helping.SHOTS', 2000)
    goal = {'ball': '9', 'to': [0.3, 0.2], 'within': 0.3}

    async def use(site):
        await with_everything(site)
        await site.obey(do='help', goal=goal)
        await site.obey(do='pause', paused=True)
        heard = {}
        while 'help' not in heard:
            heard |= await site.heard()
        return heard, site.bridge.asked

    heard, asked = on_site(use)
    assert heard['help'][0]['goal'] == goal and len(heard['help'][0]['shots']) > 0
    assert heard['help'][0]['positions'] == TABLE.positions.tolist() and len(asked) == 1


def test_while_balls_move_there_is_no_help():
    async def use(site):
        await with_everything(site, moving=True)
        await site.obey(do='help', goal={'ball': '9'})
        return (await site.heard())['problem']

    assert on_site(use) == ['wait until the balls are at rest']


def test_while_balls_move_there_is_nothing_to_predict_from():
    async def use(site):
        await with_everything(site, moving=True)
        await site.obey(do='aim', velocity=[-4.0, 0.0])
        return (await site.heard())['prediction']

    assert on_site(use) == [None]


ACCEPTED = {'phase': 'accepted', 'shot': None, 'as_printed': None, 'integrator': 'event'}


def played(velocity):
    """Return what changes in a response where a shot from the start layout is done."""
    ends = simulate(TABLE, velocity).final_positions.tolist()
    final = dict(zip(TABLE.labels, ends, strict=True))
    return {'shot': None, 'as_printed': None, 'integrator': 'event', 'final_positions': final}


async def heard_strike(site):
    heard = {}
    while 'strike' not in heard:
        heard |= await site.heard()
    return heard['strike'][-1]


def test_what_was_struck_is_shown_at_once_and_to_late_pages():
    async def use(site):
        await with_everything(site)
        site.respond(**ACCEPTED)
        strike = await heard_strike(site)
        site.respond(**played((-4.0, 0.0)))
        late = await site.heard(site.view.pages.open())
        return strike, late

    strike, late = on_site(use)
    shot = simulate(TABLE, (-4.0, 0.0))
    assert strike['start'] == TABLE.positions.tolist()
    assert strike['ends'] == shot.final_positions.tolist()
    assert late['strike'] == [strike] and late['result'][0]['id'] == strike['id']


def test_a_strike_is_withdrawn_where_the_balls_end_elsewhere():
    async def use(site):
        await with_everything(site)
        site.respond(**ACCEPTED)
        await heard_strike(site)
        site.respond(**played((-4.0, 0.1)))
        return await heard_strike(site)

    assert on_site(use) is None


@pytest.mark.parametrize('phase', ['accepted', 'done', 'preempted'])
def test_an_answer_to_a_request_that_was_sent_again_changes_nothing(phase):
    async def use(site):
        await with_everything(site)
        site.respond(**ACCEPTED)
        strike = await heard_strike(site)
        again = played((-4.0, 0.0)) | {'phase': phase, 'reason': 'x'}
        site.respond(**again, id='x' if phase == 'accepted' else 'an earlier one')
        heard = await site.heard()
        return strike, heard, await site.heard(site.view.pages.open())

    strike, heard, late = on_site(use)
    assert not {'strike', 'response', 'result'} & set(heard)
    assert late['strike'] == [strike] and 'result' not in late


def test_undo_puts_back_what_the_strike_moved():
    async def use(site):
        await with_everything(site)
        await site.obey(do='undo')
        site.respond(**ACCEPTED)
        await heard_strike(site)
        places = TABLE.positions + [0.0, 0.01] * (np.arange(11) == 9)[:, np.newaxis]
        poses = to_poses('table', 2_000_000_000, places, TABLE.radii.tolist())
        site.bridge.poses = serialize_message(poses)
        while 'frame' not in await site.heard():
            pass
        await site.obey(do='undo')
        return site.bridge.asked, await site.heard()

    asked, heard = on_site(use)
    assert asked == [{'place': {'9': TABLE.positions[9].tolist()}}]
    assert 'problem' not in heard


def test_there_is_nothing_to_undo_before_a_strike():
    async def use(site):
        await with_everything(site)
        await site.obey(do='undo')
        return site.bridge.asked, (await site.heard())['problem']

    assert on_site(use) == ([], ['there is no strike to undo'])


def test_a_new_table_takes_strike_and_result_away():
    async def use(site):
        await with_everything(site)
        site.respond(**ACCEPTED)
        await heard_strike(site)
        site.respond(**played((-4.0, 0.0)))
        site.view.on_table(messages.to_string(table_to_json(TABLE)))
        return await site.heard(site.view.pages.open())

    late = on_site(use)
    assert 'result' not in late and late['strike'] == [None]


def test_poses_that_come_before_the_table_are_shown_with_it():
    async def use(site):
        poses = to_poses('table', 1_500_000_000, TABLE.positions, TABLE.radii.tolist())
        site.bridge.poses = serialize_message(poses)
        while site.bridge.poses is not None:
            await asyncio.sleep(0.005)
        before = await site.heard()
        site.view.on_table(messages.to_string(table_to_json(TABLE)))
        return before, await site.heard()

    before, after = on_site(use)
    assert 'frame' not in before
    assert np.array_equal(after['frame'][0][1:], TABLE.positions.ravel())


def test_pages_are_told_while_the_physics_is_compiled(monkeypatch):
    compiled = threading.Event()
    monkeypatch.setattr(module, 'compile_kernels', lambda table: compiled.wait(PATIENCE))
    monkeypatch.setattr(module, 'COMPILE_NOTICE', 0.0)

    async def use(site):
        site.view.on_table(messages.to_string(table_to_json(TABLE)))
        during, late = await site.heard(), await site.heard(site.view.pages.open())
        compiled.set()
        after = {}
        while 'predicts' not in after:
            after |= await site.heard()
        return during, late, after

    during, late, after = on_site(use)
    assert during['compiling'] == late['compiling'] == [True]
    assert 'predicts' not in during
    assert after['compiling'] == [False] and after['predicts'] == [True]


def test_a_physics_that_is_compiled_already_is_not_told():
    compile_kernels(TABLE)
    heard = on_site(with_everything)
    assert True not in heard.get('compiling', [])


def test_a_physics_that_cannot_be_compiled_is_not_waited_for(monkeypatch):
    def fail(table):
        raise RuntimeError('no compiler')

    monkeypatch.setattr(module, 'compile_kernels', fail)

    async def use(site):
        site.view.on_table(messages.to_string(table_to_json(TABLE)))
        heard = {}
        while 'compiling' not in heard:
            heard |= await site.heard()
        return heard

    heard = on_site(use)
    assert heard['compiling'] == [False] and 'predicts' not in heard
