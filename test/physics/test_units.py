import pool_sim_ros.physics
from pool_sim_ros.physics import units


def test_an_inch():
    """By definition, since 1959."""
    assert units.INCH == 0.0254 == pool_sim_ros.physics.INCH
