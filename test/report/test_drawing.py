import math
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.image import imread
from matplotlib.patches import Circle

from pool_sim_ros.physics import Ball, simulate
from pool_sim_ros.report.collision_drawing import draw_construction, draw_setup
from pool_sim_ros.report.drawing import CLOTH, TablePicture, label_outline
from pool_sim_ros.report.outputs import picture_count, write_pictures
from pool_sim_ros.report.part_one import example
from pool_sim_ros.report.paths import draw_paths


def pixels(picture, tmp_path, dpi=200):
    picture.save(str(tmp_path / 'picture.png'), 'png', dpi)
    return imread(tmp_path / 'picture.png')[..., :3]


def color_at(image, table, x, y):
    """The colour at a place in m; the picture has a margin of 1 % of the length."""
    margin = 0.01 * table.length
    height, width, _ = image.shape
    column = (x + margin) / (table.length + 2 * margin) * width
    row = height - (y + margin) / (table.width + 2 * margin) * height
    return tuple(image[int(row), int(column)])


def test_balls_have_their_colours_and_white_spots_where_they_are(settings, shots, tmp_path):
    table = settings.table
    picture = TablePicture(table)
    places = shots[1].trajectory.final_positions
    picture.place(places)
    image = pixels(picture, tmp_path)
    for ball, (x, y) in zip(table.balls, places, strict=True):
        ring, spot = 0.75 * ball.radius, 0.45 * ball.radius
        assert color_at(image, table, x, y + ring) == pytest.approx(ball.color, abs=0.02)
        assert color_at(image, table, x, y - ring) == pytest.approx(ball.color, abs=0.02)
        assert color_at(image, table, x, y + spot) == pytest.approx((1.0, 1.0, 1.0), abs=0.02)
    assert color_at(image, table, 2.0, 0.2) == pytest.approx(CLOTH, abs=0.02)


def test_labels_are_blue_and_in_the_spot(settings, tmp_path):
    image = pixels(TablePicture(settings.table), tmp_path, 400)
    for ball in settings.table.balls:
        offsets = np.linspace(-0.3, 0.3, 41) * ball.radius
        x, y = ball.position
        spot = [color_at(image, settings.table, x + dx, y + dy) for dx in offsets for dy in offsets]
        blue = pytest.approx((0.0, 0.0, 1.0), abs=0.02)
        assert any(color == blue for color in spot), ball.label


@pytest.mark.parametrize('label', ['1', '10', 'C', 'Cue', '$', '$a$', 'Ä8', 'W' * 12])
def test_a_label_fits_its_circle(label):
    outline = label_outline(label, 2.0)
    box = outline.get_extents()
    assert 0.5 < math.hypot(box.x1, box.y1) <= 1.0 + 1e-9
    assert (box.x0 + box.x1, box.y0 + box.y1) == pytest.approx((0.0, 0.0), abs=1e-9)


def test_a_blank_label_is_no_trouble(settings, tmp_path):
    balls = [replace(settings.table.balls[0], label=' ')]
    pixels(TablePicture(replace(settings.table, balls=balls)), tmp_path, 50)


@pytest.mark.parametrize('integrator', ['event', 'time_slice'])
@pytest.mark.parametrize('number', [1, 2, 3, 4])
def test_paths_go_where_the_balls_went(shots, number, integrator):
    velocity = shots[number].velocity
    trajectory = simulate(shots[number].table, velocity, integrator=integrator)
    places = trajectory.positions(np.linspace(0.0, trajectory.duration, 997))
    for index, ball in enumerate(trajectory.table.balls):
        corners = trajectory.path(index)
        assert tuple(corners[0]) == ball.position
        assert tuple(corners[-1]) == tuple(trajectory.final_positions[index])
        if len(corners) == 1:
            assert np.all(places[:, index] == ball.position)
            continue
        # A time-sliced ball gets as far into a cushion as it goes in a slice, and is put back.
        slack = 1e-9 if integrator == 'event' else 4.0 * 1e-6
        assert distances(places[:, index], corners).max() < slack
        assert distances(corners, places[:, index]).max() < 0.01


def test_a_path_ends_where_a_shot_was_cut(shots):
    cut = simulate(shots[1].table, shots[1].velocity, until=0.5)
    corners = cut.path(0)
    assert len(corners) > 1
    assert tuple(corners[-1]) == tuple(cut.final_positions[0])


def distances(points, corners):
    """How far each point is from the line through `corners`, plainly: over each piece of it."""
    best = np.full(len(points), np.inf)
    for start, end in zip(corners[:-1], corners[1:], strict=True):
        step = end - start
        if not step.any():
            continue
        along = np.clip((points - start) @ step / (step @ step), 0.0, 1.0)
        best = np.minimum(best, np.hypot(*(points - start - along[:, None] * step).T))
    return best


def test_end_pictures_show_the_path_of_each_ball_that_moved_and_only_those(shots, tmp_path):
    shot = shots[2]
    table = shot.table
    picture = TablePicture(table)
    picture.place(shot.trajectory.final_positions)
    before = pixels(picture, tmp_path)
    draw_paths(picture.axes, shot.trajectory)
    after = pixels(picture, tmp_path)
    # Points on the ways of the cue ball and of ball 2, and one where nothing was.
    halfway = shot.trajectory.positions(0.3)[0]
    assert color_at(before, table, *halfway) == pytest.approx(CLOTH, abs=0.02)
    assert color_at(after, table, *halfway) == pytest.approx((1.0, 1.0, 1.0), abs=0.02)
    start_of_2 = table.balls[2].position
    assert color_at(after, table, *start_of_2) != pytest.approx(CLOTH, abs=0.02)
    changed = np.abs(after - before).max(axis=2) > 0.02
    height, width = changed.shape
    assert not changed[:, : width // 50].any()
    assert not changed[height // 2 :, width // 10 : width // 2].any()


def test_pictures_have_600_dots_per_inch(settings, shots, tmp_path):
    made = dict(write_pictures(tmp_path, settings.table, [shots[3]]))
    assert len(made) == picture_count([shots[3]]) == 5
    for path, vectors in made.items():
        data = (tmp_path / path).read_bytes()
        place = data.index(b'pHYs') + 4
        per_metre = int.from_bytes(data[place : place + 4], 'big')
        assert round(per_metre * 0.0254) == 600
        assert int.from_bytes(data[16:20], 'big') == 3900
        assert b'<svg' in vectors
    assert sorted(p.name for p in (tmp_path / 'images').iterdir()) == sorted(
        path.removeprefix('images/') for path in made
    )


def test_the_same_picture_is_the_same_bytes(settings, shots, tmp_path):
    first, second = (
        dict(write_pictures(tmp_path / name, settings.table, [])) for name in ('a', 'b')
    )
    assert first == second
    for path in first:
        assert (tmp_path / 'a' / path).read_bytes() == (tmp_path / 'b' / path).read_bytes()


@pytest.mark.parametrize('radii', [(0.05, 0.05), (0.02, 0.06), (0.06, 0.02)])
def test_construction_lines_are_those_of_equation_4(settings, radii):
    a, b = (
        Ball(label, 0.1, radius, (0.5 + i, 0.5))
        for i, (label, radius) in enumerate(zip('ab', radii, strict=True))
    )
    collision = example(replace(settings.table, balls=[a, b]))
    assert collision.impact_angle == pytest.approx(
        math.pi / 2 - collision.collide('coulomb').impact_angle
    )
    centre_a, centre_b = circles(draw_construction(collision))
    between = np.subtract(centre_b, centre_a)
    assert math.hypot(*between) == pytest.approx(sum(radii))
    # The offset: the distance of b's centre from the line of a's motion.
    along = np.array(collision.velocity) / math.hypot(*collision.velocity)
    for figure in (draw_construction(collision), draw_setup(collision)):
        centre_a, centre_b = circles(figure)
        x, y = np.subtract(centre_b, centre_a)
        assert along[0] * y - along[1] * x == pytest.approx(collision.offset)


def circles(figure):
    return [patch.center for patch in figure.axes[0].patches if isinstance(patch, Circle)]
