from pool_sim_ros.simulator.request_history import RequestHistory
from pool_sim_ros.simulator.shot_request import Phase, Response


def add(history, request_id, phase=Phase.REJECTED):
    response = Response(id=request_id, phase=phase)
    history.add(request_id, f'content of {request_id}', response)
    return response


def test_made_ids_are_never_the_same():
    one, other = RequestHistory(), RequestHistory()
    ids = [history.make_id() for history in (one, other) for _ in range(100)]
    assert len(set(ids)) == 200


def test_finds_the_latest_response_and_the_content():
    history = RequestHistory()
    assert history.find('a') is None
    add(history, 'a', Phase.ACCEPTED)
    done = Response(id='a', phase=Phase.DONE)
    history.update(done.id, done)
    assert history.find('a') == ('content of a', done)


def test_the_oldest_is_forgotten_beyond_the_capacity():
    history = RequestHistory(capacity=3)
    for name in 'abcd':
        add(history, name)
    assert [history.find(name) is not None for name in 'abcd'] == [False, True, True, True]


def test_the_shot_in_hand_is_not_forgotten():
    history = RequestHistory(capacity=3)
    add(history, 'in hand', Phase.ACCEPTED)
    for number in range(10):
        add(history, str(number))
    assert history.find('in hand') is not None
    done = Response(id='in hand', phase=Phase.DONE)
    history.update(done.id, done)
    add(history, 'one more')
    assert history.find('in hand')[1] is done


def test_requests_without_an_id_do_not_push_out_those_with_one():
    history = RequestHistory(capacity=3)
    add(history, 'a')
    for _ in range(10):
        add(history, history.make_id())
    assert history.find('a') is not None
