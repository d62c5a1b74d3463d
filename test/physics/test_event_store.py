"""Events of parts of the shots, which come in any order, joined in that of the shots."""

import threading

import numpy as np
import pytest

from pool_sim_ros.physics.event_store import EventStore
from pool_sim_ros.physics.log import EVENT


def some_events(rng, count):
    events = np.empty(count, EVENT)
    for name in EVENT.names:
        events[name] = rng.integers(0, 1000, count)
    return events


def put(store, first, end, events):
    room = store.room(len(events))
    assert len(room) >= len(events)
    room[: len(events)] = events
    store.put(first, end, room, len(events))


def parts_of(rng, shots, largest):
    """Return (first, end, events) of all shots, of parts of 1 to 9 of them."""
    edges = [0]
    while edges[-1] < shots:
        edges.append(min(shots, edges[-1] + int(rng.integers(1, 10))))
    sizes = rng.integers(0, largest, len(edges) - 1)
    return [
        (first, end, some_events(rng, size))
        for first, end, size in zip(edges[:-1], edges[1:], sizes, strict=True)
    ]


@pytest.mark.parametrize('largest', [1, 5, 300])
@pytest.mark.parametrize('order', ['in order', 'backwards', 'at random'])
def test_any_order_gives_the_order_of_the_shots(order, largest):
    rng = np.random.default_rng(1)
    for shots in (1, 7, 100, 400):
        parts = parts_of(rng, shots, largest)
        coming = list(parts)
        if order == 'backwards':
            coming.reverse()
        elif order == 'at random':
            coming = [parts[k] for k in rng.permutation(len(parts))]
        store = EventStore(shots)
        for part in coming:
            put(store, *part)
        joined = store.joined()
        assert joined.tobytes() == b''.join(events.tobytes() for _, _, events in parts)
        assert joined.dtype == EVENT


def test_no_shots():
    assert len(EventStore(0).joined()) == 0


@pytest.mark.parametrize('first', [0, 1])
def test_a_part_with_nearly_all_events(first):
    """What came before says nothing of what comes."""
    rng = np.random.default_rng(2)
    sizes = [0, 5000] if first else [5000, 0]
    parts = [(k, k + 1, some_events(rng, size)) for k, size in enumerate(sizes)]
    parts += [(k, k + 1, some_events(rng, 1)) for k in range(2, 200)]
    store = EventStore(200)
    for part in parts:
        put(store, *part)
    assert store.joined().tobytes() == b''.join(events.tobytes() for _, _, events in parts)


def test_a_room_is_used_again_once_its_events_are_joined():
    rng = np.random.default_rng(3)
    store = EventStore(3)
    room = store.room(10)
    store.put(1, 2, room, 10)
    assert store.room(10) is not room, 'its shot still waits for the one before'
    put(store, 0, 1, some_events(rng, 4))
    rooms = [store.room(10), store.room(10)]
    assert any(one is room for one in rooms)


def test_a_room_has_room():
    store = EventStore(4)
    put(store, 0, 1, some_events(np.random.default_rng(4), 3))
    assert len(store.room(1000)) >= 1000
    assert store.room(0).dtype == EVENT


def test_parts_from_several_threads():
    rng = np.random.default_rng(5)
    parts = parts_of(rng, 2000, 40)
    store, left = EventStore(2000), iter(parts)

    def work():
        for part in left:
            put(store, *part)

    workers = [threading.Thread(target=work) for _ in range(4)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert store.joined().tobytes() == b''.join(events.tobytes() for _, _, events in parts)
