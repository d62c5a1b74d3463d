import pytest

from pool_sim_ros.simulator.pacer import MAX_LAG, Pacer


class Clock:
    def __init__(self, now=1000.0):
        self.now = now

    def __call__(self):
        return self.now


def due_frames(pacer, moving=False, limit=100_000):
    """Show every frame that is due, and return how many there were."""
    count = 0
    while pacer.wait(moving) <= 0.0:
        pacer.shown()
        count += 1
        assert count < limit, 'frames without end'
    return count


@pytest.mark.parametrize('factor', [0.1, 1.0, 7.0, 100.0])
def test_frames_come_at_the_rate_times_the_factor_without_drift(factor):
    clock = Clock()
    pacer = Pacer(60, factor, clock)
    shown = 0
    while clock.now < 1100.0:
        shown += due_frames(pacer)
        clock.now += pacer.wait(False) + 1e-9
    assert shown == pytest.approx(100 * 60 * factor, abs=1.01)


def test_sleeping_for_what_wait_says_is_enough():
    clock = Clock()
    pacer = Pacer(60, 1.0, clock)
    due_frames(pacer)
    clock.now += pacer.wait(False) / 2
    assert pacer.wait(False) > 0.0
    clock.now += pacer.wait(False) + 1e-9
    assert due_frames(pacer) == 1


def test_a_little_lateness_is_caught_up():
    clock = Clock()
    pacer = Pacer(60, 1.0, clock)
    due_frames(pacer)
    clock.now += 3.5 / 60
    assert due_frames(pacer) == 3
    assert pacer.wait(False) == pytest.approx(0.5 / 60)


def test_after_a_long_stop_there_is_no_flood():
    clock = Clock()
    pacer = Pacer(60, 1.0, clock)
    due_frames(pacer)
    clock.now += 5.0
    assert 1 <= due_frames(pacer) <= MAX_LAG * 60
    assert 0.0 < pacer.wait(False) <= 1 / 60 + 1e-9


def test_a_clock_that_is_set_back_does_not_stop_the_frames():
    clock = Clock()
    pacer = Pacer(60, 1.0, clock)
    due_frames(pacer)
    clock.now -= 3600.0
    assert due_frames(pacer) == 1
    clock.now += 1 / 60 + 1e-9
    assert due_frames(pacer) == 1


def test_as_fast_as_possible_only_while_moving():
    clock = Clock()
    pacer = Pacer(60, 0.0, clock)
    assert due_frames(pacer, moving=False) == 1
    for _ in range(1000):
        assert pacer.wait(True) <= 0.0
        pacer.shown()
    clock.now += 0.25
    assert due_frames(pacer, moving=False) == 1
    clock.now += 1 / 60 + 1e-9
    assert due_frames(pacer, moving=False) == 1


def test_a_new_factor_counts_at_once():
    clock = Clock()
    pacer = Pacer(60, 0.01, clock)
    due_frames(pacer)
    pacer.real_time_factor = 10.0
    assert due_frames(pacer) == 1
    assert pacer.wait(False) == pytest.approx(1 / 600)


def test_lateness_is_that_of_the_latest_frame():
    clock = Clock()
    pacer = Pacer(60, 1.0, clock)
    due_frames(pacer)
    clock.now += 1 / 60 + 0.002
    assert pacer.wait(False) <= 0.0
    pacer.shown()
    assert pacer.lateness == pytest.approx(0.002)


def test_frames_that_are_due_are_counted_and_so_are_slips():
    clock = Clock()
    pacer = Pacer(60, 1.0, clock)
    due_frames(pacer)
    clock.now += 3.5 / 60
    assert pacer.ticks_behind == 2
    due_frames(pacer)
    assert (pacer.ticks_behind, pacer.slips) == (0, 0)
    clock.now += 5.0
    due_frames(pacer)
    assert (pacer.ticks_behind, pacer.slips) == (0, 1)


def test_no_frame_is_behind_as_fast_as_possible():
    clock = Clock()
    pacer = Pacer(60, 0.0, clock)
    assert pacer.wait(True) <= 0.0
    clock.now += 0.05
    assert (pacer.ticks_behind, pacer.slips) == (0, 0)
    pacer.shown()
    assert pacer.lateness == 0.0
