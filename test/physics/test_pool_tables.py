"""The tables by name: the seven-foot one as its data have it, the others as their rules do."""

import numpy as np
import pytest
from billiards import seven_foot

from pool_sim_ros.physics.pool_tables import POOL_TABLES, pool_table_dimensions
from pool_sim_ros.physics.units import INCH


def test_the_seven_foot_table_equals_its_data_in_order():
    table, data = pool_table_dimensions('7ft'), seven_foot()
    assert (table.length, table.width) == (data['length'], data['width'])
    assert table.nose_height == data['nose_height']
    for found, expected in (
        (table.cushions.segments, data['segments']),
        (table.cushions.noses, data['noses']),
        (table.pockets, data['pockets']),
    ):
        np.testing.assert_array_equal(found, expected)


def test_coefficients_are_those_of_the_notes():
    """Pool, snooker and carom: mass, radius, mu_slide, mu_roll, mu_spin, f, height of the nose."""
    expected = {
        '7ft': (0.170097, 0.028575, 0.2, 0.01, 0.0127, 0.2, 0.036576),
        'snooker': (0.140, 0.02619375, 0.5, 0.01, 4 / 9 * 0.02619375, 0.5, 0.028),
        'carom': (0.210, 0.03075, 0.2, 0.01, 4 / 9 * 0.03075, 0.15, 0.037),
    }
    for name, numbers in expected.items():
        table = pool_table_dimensions(name)
        found = (
            table.ball_mass,
            table.ball_radius,
            table.mu_slide,
            table.mu_roll,
            table.mu_spin,
            table.mu_ball_cushion,
            table.nose_height,
        )
        assert found == pytest.approx(numbers, rel=1e-14), name


@pytest.mark.parametrize(('name', 'length'), [('8ft', 92.0), ('9ft', 100.0)])
def test_wpa_tables_are_within_wpa_s_specifications(name, length):
    table = pool_table_dimensions(name)
    assert table.length == pytest.approx(length * INCH) == pytest.approx(2 * table.width)
    assert table.nose_height / (2 * table.ball_radius) == pytest.approx(0.635)
    segments, pockets = table.cushions.segments, table.pockets
    low, right = segments[0], segments[1]
    # The ends of the rails are the lips: points, no roundings.
    assert (table.cushions.noses[:, 2] == 0.0).all()
    assert 4.5 <= low[0] * np.sqrt(2) / INCH <= 4.625
    assert 5.0 <= (right[0] - low[2]) / INCH <= 5.125
    # Angle between the rail, seen from its lip, and the jaw: 142 and 104 degrees.
    for jaw, rail, angle in ((segments[11], (1.0, 0.0), 142.0), (segments[6], (1.0, 0.0), 104.0)):
        away = jaw[:2] - jaw[2:4]
        cosine = np.dot(away, rail) / np.linalg.norm(away)
        assert np.degrees(np.arccos(cosine)) == pytest.approx(angle, abs=1e-9)
    corner_shelf = low[0] / np.sqrt(2) - (pockets[0, 2] - np.hypot(*pockets[0, :2]))
    side_shelf = -pockets[1, 1] - pockets[1, 2]
    assert 1.0 <= corner_shelf / INCH <= 2.25
    assert 0.0 <= side_shelf / INCH <= 0.375


def test_carom_has_no_pockets():
    table = pool_table_dimensions('carom')
    assert table.cushions is None and table.pockets.shape == (0, 3)
    assert (table.length, table.width) == (2.84, 1.42)


@pytest.mark.parametrize('name', ['7ft', '8ft', '9ft', 'snooker'])
def test_a_ball_fits_into_every_mouth_and_lies_on_every_table(name):
    table = pool_table_dimensions(name)
    rails = table.cushions.segments[:6]
    gaps = [rails[1, 0] - rails[0, 2], np.hypot(rails[0, 0], rails[4, 1])]
    assert min(gaps) > 2 * table.ball_radius
    # No hole reaches a ball that lies at a rail beside the mouth.
    for x, y, hole in table.pockets:
        along = np.linspace(table.ball_radius, table.length - table.ball_radius, 2001)
        at_rail = np.column_stack([along, np.full_like(along, table.ball_radius)])
        caught = np.hypot(*(at_rail - (x, y)).T) < hole
        beside = (along > rails[0, 0]) & (along < rails[0, 2])
        assert not (caught & beside).any()


def distance_to_segment(x, y, segment):
    x0, y0, x1, y1 = segment[:4]
    length = (x1 - x0) ** 2 + (y1 - y0) ** 2
    share = np.clip(((x - x0) * (x1 - x0) + (y - y0) * (y1 - y0)) / length, 0.0, 1.0)
    return np.hypot(x - x0 - share * (x1 - x0), y - y0 - share * (y1 - y0))


@pytest.mark.parametrize('name', ['7ft', '8ft', '9ft', 'snooker'])
def test_no_ball_leaves_but_through_a_pocket(name):
    """Where a ball's centre gets from the middle without overlap, on a grid of 3 mm: to the rails,
    and to each hole before it is as far out as the jaws reach."""
    table = pool_table_dimensions(name)
    step, margin = 0.003, 0.15
    x, y = np.meshgrid(
        np.arange(-margin, table.length + margin, step),
        np.arange(-margin, table.width + margin, step),
        indexing='ij',
    )
    free = np.ones(x.shape, dtype=bool)
    for segment in table.cushions.segments:
        free &= distance_to_segment(x, y, segment) >= table.ball_radius
    for x0, y0, radius in table.cushions.noses:
        free &= np.hypot(x - x0, y - y0) >= table.ball_radius + radius
    holes = [np.hypot(x - x0, y - y0) < radius for x0, y0, radius in table.pockets]
    free &= ~np.any(holes, axis=0)
    reached = np.zeros_like(free)
    reached[free.shape[0] // 2, free.shape[1] // 2] = True
    count = 0
    while count != reached.sum():
        count = reached.sum()
        for _ in range(20):
            reached[1:] |= reached[:-1]
            reached[:-1] |= reached[1:]
            reached[:, 1:] |= reached[:, :-1]
            reached[:, :-1] |= reached[:, 1:]
            reached &= free
    out = np.maximum(np.maximum(-x, x - table.length), np.maximum(-y, y - table.width))
    assert out[reached].max() < 0.02
    for hole in holes:
        grown = hole.copy()
        grown[1:] |= hole[:-1]
        grown[:-1] |= hole[1:]
        assert (grown & reached).any()


def test_fields_are_those_of_a_table():
    table = pool_table_dimensions('9ft')
    fields = table.fields()
    assert fields['motion'] == 'ball' and fields['mu_spin'] == table.mu_spin
    assert fields['e_cue_ball'] == fields['e_ball_ball'] == 0.95
    assert fields['cushions'] is table.cushions and fields['pockets'] is table.pockets


def test_snooker_s_size_is_near_wpbsa_s():
    table = pool_table_dimensions('snooker')
    assert abs(table.length - 3.569) < 0.026 and abs(table.width - 1.778) < 0.033


@pytest.mark.parametrize('name', ['10ft', '', None, 7])
def test_another_name_is_refused(name):
    with pytest.raises(ValueError) as caught:
        pool_table_dimensions(name)
    message = str(caught.value)
    assert message.startswith(f'name: {name!r}')
    assert all(repr(known) in message for known in POOL_TABLES)
