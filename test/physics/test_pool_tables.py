"""The tables by name: the seven-foot one as its data have it, the others as their rules do."""

import numpy as np
import pytest
from billiards import seven_foot

from pool_sim_ros.physics.pool_tables import POOL_TABLES, pool_table_dimensions
from pool_sim_ros.physics.units import INCH


def test_the_seven_foot_table_equals_its_data_in_order():
    table, data = pool_table_dimensions('7ft'), seven_foot()
    assert (table.length, table.width) == (data['length'], data['width'])
    assert table.nose_height == pytest.approx(data['nose_height'], abs=1e-16)
    for found, expected in (
        (table.cushions.segments, data['segments']),
        (table.cushions.noses, data['noses']),
        (table.pockets, data['pockets']),
    ):
        np.testing.assert_allclose(found, expected, rtol=0, atol=3e-15)


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
