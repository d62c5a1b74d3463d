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


def test_finds_the_response_and_the_content():
    history = RequestHistory()
    assert history.find('a') is None
    done = add(history, 'a', Phase.DONE)
    assert history.find('a') == ('content of a', done)


def test_the_oldest_is_forgotten_beyond_the_capacity():
    history = RequestHistory(capacity=3)
    for name in 'abcd':
        add(history, name)
    assert [history.find(name) is not None for name in 'abcd'] == [False, True, True, True]


def test_a_made_id_is_known_by_its_beginning_and_takes_no_room():
    history = RequestHistory(prefix='node', capacity=3)
    made = history.make_id()
    assert made == 'node-1'
    assert all(history.is_made(name) for name in (made, 'node-2', 'node', 'nodes'))
    assert not any(history.is_made(name) for name in ('nod', 'a-node-1', 'Node-1', ''))
    add(history, 'a')
    for _ in range(10):
        add(history, history.make_id())
    assert history.find('a') is not None
    assert history.find(made) is None
