import numpy as np

from pool_sim_ros.physics.motion import DISC, RESTS
from pool_sim_ros.physics.motion.disc_record import discs_at_rest


def test_a_disc_takes_two_cache_lines_and_others_need_only_the_first():
    assert DISC.itemsize == 2 * 64
    ends = {name: offset + field.itemsize for name, (field, offset) in DISC.fields.items()}
    assert max(ends[n] for n in ('x', 'y', 'ux', 'uy', 'speed', 'since', 'radius', 'phase')) <= 64


def test_at_first_all_rest_where_they_lie():
    found = discs_at_rest(
        np.array([(0.2, 0.3), (0.5, 0.6)]),
        np.array([0.03, 0.05]),
        np.array([0.25, 0.5]),
        np.array([True, False]),
    )
    assert found.dtype == DISC
    assert found[['x', 'y']].tolist() == [(0.2, 0.3), (0.5, 0.6)]
    assert found['inverse_mass'].tolist() == [4.0, 2.0]
    assert found['radius'].tolist() == [0.03, 0.05] and found['is_cue'].tolist() == [1, 0]
    assert (found['phase'] == RESTS).all()
    assert (found['next_contact_time'] == np.inf).all()
    assert (found['cell_exit_time'] == np.inf).all()
    assert (found['last_contact_time'] == -np.inf).all()
    for name in ('ux', 'uy', 'speed', 'since', 'changes'):
        assert not found[name].any()
