import math
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.patches import Circle

from pool_sim_ros.physics import Ball
from pool_sim_ros.report.collision_drawing import draw_construction, draw_setup
from pool_sim_ros.report.part_one import example


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


def test_the_figures_name_what_the_equations_use(settings):
    collision = example(settings.table)
    assert {'$v_a$', '$e$', '$x$', '$y$'} <= texts(draw_setup(collision))
    names = texts(draw_construction(collision))
    assert {'$n$', '$t$', '$h$', '$e$', '$\\theta$'} <= names
    assert any('impact' in name for name in names)
    assert any('velocity' in name for name in names)


def texts(figure):
    return {text.get_text() for text in figure.axes[0].texts}
