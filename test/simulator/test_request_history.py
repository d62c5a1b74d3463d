from pool_sim_ros.simulator.request_history import Ledger
from pool_sim_ros.simulator.shot_request import Phase, Request, Response


def enter(ledger, request_id, phase=Phase.REJECTED):
    response = Response(id=request_id, phase=phase)
    ledger.enter(Request(id=request_id, content=f'content of {request_id}'), response)
    return response


def test_made_ids_are_never_the_same():
    one, other = Ledger(), Ledger()
    ids = [ledger.make_id() for ledger in (one, other) for _ in range(100)]
    assert len(set(ids)) == 200


def test_finds_the_latest_response_and_the_content():
    ledger = Ledger()
    assert ledger.find('a') is None
    enter(ledger, 'a', Phase.ACCEPTED)
    done = Response(id='a', phase=Phase.DONE)
    ledger.update(done)
    assert ledger.find('a') == ('content of a', done)


def test_the_oldest_is_forgotten_beyond_the_capacity():
    ledger = Ledger(capacity=3)
    for name in 'abcd':
        enter(ledger, name)
    assert [ledger.find(name) is not None for name in 'abcd'] == [False, True, True, True]


def test_the_shot_in_hand_is_not_forgotten():
    ledger = Ledger(capacity=3)
    enter(ledger, 'in hand', Phase.ACCEPTED)
    for number in range(10):
        enter(ledger, str(number))
    assert ledger.find('in hand') is not None
    done = Response(id='in hand', phase=Phase.DONE)
    ledger.update(done)
    enter(ledger, 'one more')
    assert ledger.find('in hand')[1] is done


def test_requests_without_an_id_do_not_push_out_those_with_one():
    ledger = Ledger(capacity=3)
    enter(ledger, 'a')
    for _ in range(10):
        enter(ledger, ledger.make_id())
    assert ledger.find('a') is not None
