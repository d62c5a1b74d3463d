"""Noise: presets, scaling, and what is none."""

import math
import re

import numpy as np
import pytest
from tables import table_of

from pool_sim_ros.oracle import Noise
from pool_sim_ros.oracle.noise import noise_of
from pool_sim_ros.physics import pool_table


def test_presets_are_those_of_their_sources():
    fastfiz, sjtu = Noise.preset('fastfiz'), Noise.preset('sjtu')
    assert (fastfiz.speed, fastfiz.azimuth, fastfiz.elevation) == (0.075, 0.125, 0.1)
    radius = pool_table('7ft').balls[0].radius
    assert fastfiz.side * radius == pytest.approx(0.5e-3)
    assert fastfiz.above * radius == pytest.approx(0.5e-3)
    assert sjtu == Noise(speed=0.1, azimuth=0.1, elevation=0.1, side=0.003, above=0.003)
    assert fastfiz.camera == sjtu.camera == 0.0


def test_a_factor_scales_every_part():
    noise = Noise(0.1, 0.2, 0.3, 0.4, 0.5, 0.6)
    assert 2 * noise == noise * 2.0 == Noise(0.2, 0.4, 0.6, 0.8, 1.0, 1.2)
    assert 0 * noise == Noise()


def test_discs_know_neither_elevation_nor_tip():
    noise = Noise(0.1, 0.2, 0.3, 0.4, 0.5, 0.6)
    np.testing.assert_array_equal(noise.of_stroke(table_of([(1, 0.5)])), [0.1, 0.2, 0, 0, 0])
    np.testing.assert_array_equal(noise.of_stroke(pool_table('7ft')), [0.1, 0.2, 0.3, 0.4, 0.5])


def test_a_noise_from_its_fields_or_its_name():
    assert noise_of({'speed': 0.1, 'camera': 1e-3}) == Noise(speed=0.1, camera=1e-3)
    assert noise_of('sjtu') == noise_of(Noise.preset('sjtu')) == Noise.preset('sjtu')


@pytest.mark.parametrize(
    ('given', 'message'),
    [
        ({'speed': -0.1}, 'noise: speed: -0.1 must be at least 0'),
        ({'azimuth': math.nan}, 'noise: azimuth: nan must be at least 0'),
        ({'camera': math.inf}, 'noise: camera: inf must be at least 0 and at most 1000'),
        ({'side': 'left'}, "noise: side: 'left' is not a number"),
        ({'above': None}, 'noise: above: None is not a number'),
        ({'angle': 1.0}, "noise: 'angle' is none of speed, azimuth"),
        ({3: 1.0}, 'noise: 3 is none of speed, azimuth'),
        ('pro', "noise: 'pro' is none; there are fastfiz, sjtu"),
        (0.5, 'noise: 0.5 must be a Noise'),
        (None, 'noise: None must be a Noise'),
    ],
)
def test_what_is_no_noise(given, message):
    with pytest.raises(ValueError, match=re.escape(message)):
        noise_of(given)


@pytest.mark.parametrize('factor', [-1.0, math.nan, 'twice'])
def test_what_is_no_factor(factor):
    with pytest.raises(ValueError, match='noise: the factor'):
        Noise(0.1) * factor
