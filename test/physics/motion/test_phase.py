from pool_sim_ros.physics.motion import MOVES, RESTS, phase


def test_a_record_of_zeros_rests():
    """Records begin as zeros; all that is not at rest moves."""
    assert RESTS == phase.RESTS == 0
    assert MOVES == phase.MOVES != RESTS
