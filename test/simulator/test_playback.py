from fractions import Fraction

import numpy as np
import pytest
from fakes import Glide
from hypothesis import given
from hypothesis import strategies as st

from pool_sim_ros.simulator.layout import Layout
from pool_sim_ros.simulator.playback import BLOCK, BLOCK_BALLS, Motion, Playback

LAYOUT = np.array([[0.5, 0.5], [1.0, 0.5]])


def play(playback, trajectory):
    """Strike, and return the frames until all balls rest."""
    playback.strike()
    playback.computed(trajectory)
    frames = [playback.next_frame()]
    while not frames[-1].finished:
        frames.append(playback.next_frame())
    return frames


@given(st.integers(1, 1000), st.integers(0, 10**9))
def test_stamp_is_the_exact_time_rounded_down(rate, tick):
    exact = Fraction(tick, rate) * 10**9
    assert 0 <= exact - Playback(Layout(LAYOUT), rate).stamp_of(tick) < 1


def test_frames_at_rest_show_the_layout_tick_by_tick():
    playback = Playback(Layout(LAYOUT), 60)
    frames = [playback.next_frame() for _ in range(3)]
    assert [f.tick for f in frames] == [0, 1, 2]
    assert [f.stamp for f in frames] == [0, 16_666_666, 33_333_333]
    for frame in frames:
        assert np.array_equal(frame.positions, LAYOUT)
        assert not frame.velocities.any() and frame.velocities.shape == (2, 2)
        assert frame.collisions.shape == (0, 10)
        assert not frame.started and not frame.finished
    assert playback.tick == 2


def test_motion_starts_at_the_tick_after_the_result_and_is_looked_up_from_there():
    playback = Playback(Layout(LAYOUT), 100)
    playback.next_frame()
    playback.strike()
    waiting = [playback.next_frame() for _ in range(4)]
    assert all(np.array_equal(f.positions, LAYOUT) and not f.started for f in waiting)
    start = LAYOUT + 0.1
    playback.computed(Glide(start, (1.0, 0.0), 0.035))
    first, second = playback.next_frame(), playback.next_frame()
    assert first.started and first.tick == 5
    assert playback.start_time == pytest.approx(0.05, abs=1e-15)
    assert np.array_equal(first.positions, start)
    assert np.array_equal(first.velocities, [[1.0, 0.0]] * 2)
    assert not second.started
    assert np.allclose(second.positions, start + [0.01, 0.0], atol=1e-15)


def test_the_first_frame_at_rest_finishes_the_shot_on_its_final_positions():
    playback = Playback(Layout(LAYOUT), 100)
    shot = Glide(LAYOUT, (1.0, 0.0), 0.035)
    frames = play(playback, shot)
    assert len(frames) == 5  # t = 0, 0.01, 0.02, 0.03 moving, 0.04 at rest
    assert np.array_equal(frames[-1].positions, shot.final_positions)
    assert not frames[-1].velocities.any()
    assert all(f.velocities.any() for f in frames[:-1])
    after = playback.next_frame()
    assert np.array_equal(after.positions, shot.final_positions) and not after.finished
    assert playback.motion is Motion.AT_REST


@pytest.mark.parametrize('ticks', [BLOCK - 1, BLOCK, BLOCK + 1, 3 * BLOCK])
def test_a_shot_longer_than_what_is_looked_up_at_once(ticks):
    playback = Playback(Layout(LAYOUT), 100)
    playback.next_frame()
    shot = Glide(LAYOUT, (1.0, 0.0), ticks / 100 - 0.005)
    for _ in range(2):
        frames = play(playback, shot)
        assert len(frames) == ticks + 1
        for k, frame in enumerate(frames[:-1]):
            assert np.allclose(frame.positions, LAYOUT + [k / 100, 0.0], atol=1e-12)


def test_a_block_shows_what_the_next_frames_do_unless_the_layout_changes():
    playback = Playback(Layout(LAYOUT), 100)
    playback.strike()
    playback.computed(Glide(LAYOUT, (1.0, 0.0), 0.035, [(0.015, 0)]))
    block = playback.look_ahead()
    assert (block.first_tick, block.end_tick) == (0, 5)
    assert block.moving and block.ends_shot
    frames = [playback.next_frame() for _ in range(5)]
    assert [frame.stamp for frame in frames] == block.stamps
    for index, frame in enumerate(frames):
        assert frame.block is block and frame.index == index
        assert np.array_equal(frame.positions, block.positions[index])
        assert np.array_equal(frame.collisions, block.collisions[index])
    assert [len(rows) for rows in block.collisions] == [0, 0, 1, 0, 0]


def test_a_shot_that_ends_on_a_tick_finishes_there():
    frames = play(Playback(Layout(LAYOUT), 100), Glide(LAYOUT, (1.0, 0.0), 0.02))
    assert len(frames) == 3


def test_a_shot_of_no_length_starts_and_finishes_in_one_frame():
    frames = play(Playback(Layout(LAYOUT), 60), Glide(LAYOUT, (0.0, 0.0), 0.0))
    assert len(frames) == 1 and frames[0].started


@given(
    st.integers(1, 240),
    st.integers(0, 10**6),
    st.lists(st.tuples(st.floats(0.0, 1.0), st.sampled_from([0, 1, 2])), max_size=20),
)
def test_each_contact_comes_once_in_the_first_frame_at_or_after_it(rate, first_tick, events):
    events.sort()
    playback = Playback(Layout(LAYOUT), rate)
    playback.next_tick = first_tick
    frames = play(playback, Glide(LAYOUT, (0.1, 0.0), 1.0, events))
    rows = np.concatenate([frame.collisions for frame in frames])
    contacts = [(t, kind) for t, kind in events if kind != 2]
    assert rows[:, 0].tolist() == list(range(len(contacts)))
    assert rows[:, 2].tolist() == [kind for _, kind in contacts]
    assert np.allclose(rows[:, 1], [playback.start_time + t for t, _ in contacts], atol=1e-9)
    for before, frame in zip([None, *frames], frames, strict=False):
        times = frame.collisions[:, 1]
        assert np.all(times <= frame.stamp * 1e-9 * (1 + 1e-15))
        if before is not None:
            assert np.all(times > before.stamp * 1e-9 * (1 - 1e-15))


def test_seq_goes_on_without_a_gap_after_a_reset_in_the_middle():
    playback = Playback(Layout(LAYOUT), 100)
    events = [(0.005, 0), (0.015, 1), (0.5, 0)]
    playback.strike()
    playback.computed(Glide(LAYOUT, (0.1, 0.0), 1.0, events))
    seen = [playback.next_frame() for _ in range(3)]
    playback.reset(Layout(LAYOUT))
    after = playback.next_frame()
    assert np.array_equal(after.positions, LAYOUT) and len(after.collisions) == 0
    frames = [*seen, *play(playback, Glide(LAYOUT, (0.1, 0.0), 1.0, events))]
    rows = np.concatenate([f.collisions for f in frames])
    assert rows[:, 0].tolist() == [0, 1, 2, 3, 4]
    assert [f.tick for f in [*seen, after]] == [0, 1, 2, 3]


def test_an_abandoned_shot_leaves_the_balls_where_they_are():
    playback = Playback(Layout(LAYOUT), 60)
    playback.strike()
    playback.abandon()
    assert np.array_equal(playback.next_frame().positions, LAYOUT)
    playback.strike()
    assert playback.motion is Motion.COMPUTING


def test_calls_out_of_turn_are_errors():
    playback = Playback(Layout(LAYOUT), 60)
    with pytest.raises(RuntimeError):
        playback.computed(Glide(LAYOUT, (1.0, 0.0), 1.0))
    with pytest.raises(RuntimeError):
        playback.abandon()
    playback.strike()
    with pytest.raises(RuntimeError):
        playback.strike()


def test_frames_do_not_change_afterwards():
    playback = Playback(Layout(LAYOUT), 100)
    frames = play(playback, Glide(LAYOUT, (1.0, 0.0), 0.1, [(0.01, 0), (0.03, 0)]))
    copies = [(f.positions.copy(), f.velocities.copy(), f.collisions.copy()) for f in frames]
    playback.reset(Layout(LAYOUT))
    play(playback, Glide(LAYOUT, (-1.0, 0.0), 0.1, [(0.02, 1)]))
    for frame, copy in zip(frames, copies, strict=True):
        for now, then in zip(
            (frame.positions, frame.velocities, frame.collisions), copy, strict=True
        ):
            assert np.array_equal(now, then)


def state(playback):
    positions = playback.positions.tolist()
    return playback.motion, playback.next_tick, playback.start_time, positions


@given(
    st.integers(1, 240),
    st.lists(
        st.one_of(
            st.just('frame'),
            st.just('reset'),
            st.just('strike'),
            st.just('abandon'),
            st.tuples(st.integers(1, 200), st.floats(0.0, 1.0)),
        ),
        max_size=30,
    ),
)
def test_looking_ahead_changes_nothing(rate, commands):
    looking, plain = Playback(Layout(LAYOUT), rate), Playback(Layout(LAYOUT), rate)
    for command in commands:
        before = state(looking)
        block = looking.look_ahead()
        assert state(looking) == before == state(plain)
        assert looking.look_ahead() is block
        shown = []
        for playback in (looking, plain):
            match command, playback.motion:
                case 'reset', _:
                    playback.reset(Layout(LAYOUT + 0.01))
                case 'strike', Motion.AT_REST:
                    playback.strike()
                case 'abandon', Motion.COMPUTING:
                    playback.abandon()
                case (ticks, share), Motion.COMPUTING:
                    lasts = (ticks + share) / rate
                    events = [(lasts * share, 0), (lasts, 1), (lasts, 2)]
                    playback.computed(Glide(LAYOUT, (0.01, 0.02), lasts, events))
            shown.append([playback.next_frame() for _ in range(1 if command == 'frame' else 70)])
        for ours, others in zip(*shown, strict=True):
            assert (ours.tick, ours.stamp) == (others.tick, others.stamp)
            assert (ours.started, ours.finished) == (others.started, others.finished)
            assert ours.moving == others.moving == bool(ours.velocities.any())
            for name in ('positions', 'velocities', 'collisions'):
                assert np.array_equal(getattr(ours, name), getattr(others, name))


@pytest.mark.parametrize('balls', [1, BLOCK_BALLS // BLOCK + 1, BLOCK_BALLS + 1])
def test_tables_of_any_number_of_balls(balls):
    layout = np.arange(2.0 * balls).reshape(-1, 2)
    frames = play(Playback(Layout(layout), 100), Glide(layout, (1.0, 0.0), 0.035))
    assert [frame.positions[-1, 0] - layout[-1, 0] for frame in frames] == pytest.approx(
        [0.0, 0.01, 0.02, 0.03, 0.035]
    )
