import math
from dataclasses import replace

import numpy as np
import pytest
from picture_reader import color_at, pixels

from pool_sim_ros.report.drawing import CLOTH, TablePicture, label_outline


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


@pytest.mark.filterwarnings('error')
@pytest.mark.parametrize(
    'label', ['\0\x01\x1b', '\n', '\u202e', '\ud800', '\u200b', '\u2800', '\u3164', '', ' ']
)
def test_a_label_that_cannot_be_drawn_is_left_out_or_a_box(label):
    outline = label_outline(label, 2.0)
    assert len(outline.vertices) == 0 or math.hypot(*outline.get_extents().max) <= 1.0 + 1e-9


@pytest.mark.filterwarnings('error')
@pytest.mark.parametrize(('label', 'same'), [('a\nb', 'ab'), ('\x1b[8m', '[8m')])
def test_what_cannot_be_printed_is_left_out_of_a_label(label, same):
    assert np.array_equal(label_outline(label, 2.0).vertices, label_outline(same, 2.0).vertices)


@pytest.mark.filterwarnings('error')
def test_a_character_that_the_font_has_not_is_no_trouble():
    assert len(label_outline('\N{GRINNING FACE}', 2.0).vertices)


def test_a_blank_label_is_no_trouble(settings, tmp_path):
    balls = [replace(settings.table.balls[0], label=' ')]
    pixels(TablePicture(replace(settings.table, balls=balls)), tmp_path, 50)
