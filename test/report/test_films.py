import math
from fractions import Fraction

import pytest
from film_reader import ball_positions, color_at, describe, frame_times, frames
from hypothesis import example, given
from hypothesis import strategies as st

from pool_sim_ros.report.films import moving_frames
from pool_sim_ros.report.outputs import join_films, write_film

SIZE = (640, 360)
PIXEL = 2.3 / 640
"""About one pixel, m. The edge of the cloth, which gives the scale, is drawn on whole ones."""


@pytest.fixture(scope='module')
def folder(shots, tmp_path_factory):
    """The films of shots 1 and 4, and the combined one."""
    folder = tmp_path_factory.mktemp('report')
    films = [write_film(folder, shots[number], SIZE) for number in (1, 4)]
    join_films(folder, films)
    return folder


def frames_to_rest(shot):
    """Frames from t = 0 to the first at which all rest, counted in exact arithmetic."""
    return math.ceil(Fraction(shot.trajectory.duration) * 60) + 1


@given(st.floats(0.0, 1e4))
@example(1 / 60)
@example(49 / 60)
@example(0.1 + 0.2)
@example(0.0)
def test_the_last_moving_frame_is_the_first_at_rest(duration):
    last = moving_frames(duration) - 1
    assert last / 60 >= duration
    assert last == 0 or (last - 1) / 60 < duration


@pytest.mark.parametrize('number', [1, 4])
def test_a_film_goes_on_for_one_second_after_the_first_frame_at_rest(folder, shots, number):
    times = frame_times(folder / f'videos/collision_{number}.mp4')
    assert times == list(range(frames_to_rest(shots[number]) + 60))


def test_the_combined_film_is_all_films_without_a_gap(folder, shots):
    times = frame_times(folder / 'videos/combinedCollisions.mp4')
    assert times == list(range(sum(frames_to_rest(shots[number]) + 60 for number in (1, 4))))


@pytest.mark.parametrize('name', ['collision_1', 'collision_4', 'combinedCollisions'])
def test_a_browser_can_play_the_films(folder, name):
    path = folder / f'videos/{name}.mp4'
    stream = describe(path)
    assert 'h264' in stream
    assert 'yuv420p(tv, bt709' in stream
    assert '640x360' in stream
    assert '60 fps' in stream
    content = path.read_bytes()
    # What a player must know comes before the pictures (+faststart).
    assert content.index(b'moov') < content.index(b'mdat')


@pytest.mark.parametrize('number', [1, 4])
def test_frame_k_shows_the_balls_at_k_60ths_of_a_second(folder, shots, number):
    shot = shots[number]
    table, trajectory = shot.table, shot.trajectory
    pictures = frames(folder / f'videos/collision_{number}.mp4', SIZE)
    last = frames_to_rest(shot) - 1
    for k in (0, 1, 7, 20, 40, last, last + 60):
        expected = dict(zip(table.labels, trajectory.positions(min(k, last) / 60), strict=True))
        for label, place in ball_positions(pictures[k], table).items():
            assert place == pytest.approx(tuple(expected[label]), abs=1.5 * PIXEL), (label, k)


def test_films_begin_with_the_start_layout_and_end_where_the_report_printed(folder, shots):
    shot = shots[1]
    first, *_, last = frames(folder / 'videos/collision_1.mp4', SIZE)
    starts = {ball.label: ball.position for ball in shot.table.balls}
    for label, place in ball_positions(first, shot.table).items():
        assert place == pytest.approx(starts[label], abs=1.5 * PIXEL), label
    for label, (x, y) in ball_positions(last, shot.table).items():
        printed = shot.printed[label]
        assert (x / 0.0254, y / 0.0254) == pytest.approx(printed, abs=1.5 * PIXEL / 0.0254), label
    # The cue ball has the colour of all spots; look for it where it must be, and not where not.
    beside_label = 0.7 * 0.05715
    cue_start = (starts['C'][0] + beside_label, starts['C'][1])
    cue_end = (shot.printed['C'][0] * 0.0254 + beside_label, shot.printed['C'][1] * 0.0254)
    white, green = (1.0, 1.0, 1.0), (0.5, 1.0, 0.5)
    assert color_at(first, shot.table, cue_start, white)
    assert color_at(last, shot.table, cue_start, green)
    assert color_at(last, shot.table, cue_end, white)
    assert color_at(first, shot.table, cue_end, green)


def test_the_combined_film_shows_the_shots_in_order(folder, shots):
    pictures = frames(folder / 'videos/combinedCollisions.mp4', SIZE)
    second = frames_to_rest(shots[1]) + 60
    for k, number, time in ((second - 1, 1, 9.0), (second, 4, 0.0), (-1, 4, 9.0)):
        shot = shots[number]
        expected = dict(zip(shot.table.labels, shot.trajectory.positions(time), strict=True))
        for label, place in ball_positions(pictures[k], shot.table).items():
            assert place == pytest.approx(tuple(expected[label]), abs=1.5 * PIXEL), (label, k)


def test_the_hold_does_not_move(folder, shots):
    pictures = frames(folder / 'videos/collision_4.mp4', SIZE).astype(int)
    held = pictures[frames_to_rest(shots[4]) - 1 :]
    assert len(held) == 61
    # What the encoder still refines is less than the eye sees.
    assert abs(held - held[-1]).max() < 48


def test_films_go_into_a_folder_with_an_awkward_name(shots, tmp_path):
    folder = tmp_path / "it's 100 % \\ ünïque, [1]"
    film = write_film(folder, shots[3], (128, 72))
    join_films(folder, [film, film])
    once, twice = (
        len(frame_times(folder / f'videos/{name}.mp4'))
        for name in ('collision_3', 'combinedCollisions')
    )
    assert twice == 2 * once
