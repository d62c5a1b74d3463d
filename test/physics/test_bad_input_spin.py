"""Bad input of shots on a pool table: one line that names the argument, and nothing half done."""

import dataclasses
import math

import numpy as np
import pytest

from pool_sim_ros.physics import (
    Table,
    aim_at,
    collide_cushion,
    compile_kernels,
    cue_strike,
    pool_table,
    rack,
    report_table,
    simulate,
    simulate_many,
)
from pool_sim_ros.physics.outcomes import BAD_LAYOUT, PLAYED

FULL = pool_table('7ft')
TABLE = dataclasses.replace(FULL, balls=FULL.balls[:3])
STRIKE = (2.0, 0.1)


def refusal(make, *arguments, **options):
    """Return the one line with which something is refused."""
    with pytest.raises(ValueError) as caught:
        make(*arguments, **options)
    message = str(caught.value)
    assert message and '\n' not in message and len(message) < 300
    return message


def with_ball_in(ball, pocket):
    """Return a layout with a ball in a pocket, not at its centre."""
    places = np.array(TABLE.positions)
    places[ball] = TABLE.pockets[pocket, :2] + (0.01, -0.005)
    return places


@pytest.mark.parametrize(
    ('spins', 'words'),
    [
        ((math.nan, 0, 0), 'nan is not finite'),
        ((0, -math.inf, 0), '-inf is not finite'),
        ((3e8, 0, 0), '8.5725e+06 m/s at the surface must be at most 1e+06'),
        ((1, 2), 'shape (2,) must be (3)'),
        ([(1, 2, 3)], 'shape (1, 3) must be (3)'),
        (np.zeros((4, 3)), 'shape (4, 3) must be (3) for the cue ball alone or (3, 3)'),
        ((1j, 0, 0), 'is not an array of numbers'),
        ([[10**400, 0, 0]], 'is not an array of numbers'),
        (np.full((3, 3), 'fast'), 'is not an array of numbers'),
        ({}, 'is not an array of numbers'),
    ],
)
def test_spins(spins, words):
    message = refusal(simulate, TABLE, STRIKE, spins=spins)
    assert message.startswith('spins: ') and words in message


@pytest.mark.parametrize('shape', [(3, 3), (2, 2), (1, 3), (2, 4, 3), (2, 1, 3)])
def test_spins_of_many_shots(shape):
    message = refusal(simulate_many, TABLE, [STRIKE] * 2, spins=np.zeros(shape))
    assert message == (f'spins: shape {shape} must be (2, 3) for the cue ball alone or (2, 3, 3)')


@pytest.mark.parametrize('solve', [simulate, simulate_many])
def test_discs_do_not_spin(solve):
    velocities = STRIKE if solve is simulate else [STRIKE]
    message = refusal(
        solve, report_table(), velocities, spins=np.zeros((*np.shape(velocities)[:-1], 3))
    )
    assert message.startswith('spins: discs do not spin')
    message = refusal(solve, TABLE, velocities, integrator='time_slice')
    assert message.startswith("integrator: 'time_slice' plays discs only")


def test_one_spin_for_all_shots():
    velocities, spin = [STRIKE, (-1.0, 0.3)], (3.0, -20.0, 40.0)
    one, each = (simulate_many(TABLE, velocities, spins=s) for s in (spin, [spin, spin]))
    np.testing.assert_array_equal(one.finals, each.finals)
    assert np.any(one.finals != simulate_many(TABLE, velocities).finals)


@pytest.mark.parametrize(
    'layouts', [with_ball_in(0, 2), np.array([TABLE.positions, with_ball_in(0, 2)])]
)
def test_a_strike_on_a_caught_ball(layouts):
    """Whether one layout is given for all shots or one for each."""
    last = layouts if layouts.ndim == 2 else layouts[1]
    words = "is for ball 'C', which lies in pocket 2; place it on the cloth first"
    assert refusal(simulate, TABLE, STRIKE, positions=last) == f'velocities: [2.0, 0.1] {words}'
    many = dict(spins=(0.0, 0.0, 5.0), positions=layouts)
    assert refusal(simulate_many, TABLE, [STRIKE] * 2, **many) == f'velocities: [2.0, 0.1] {words}'
    still = np.zeros((2, 2))
    assert refusal(simulate_many, TABLE, still, **many) == f'spins: [0.0, 0.0, 5.0] {words}'
    marked = simulate_many(TABLE, still, **many, errors='mark')
    assert marked.failed.tolist() == [BAD_LAYOUT if layouts.ndim == 2 else PLAYED, BAD_LAYOUT]
    assert np.isnan(marked.finals[1]).all() and np.all(marked.pocketed[1] == -1)


def test_a_spin_on_a_caught_ball_that_is_not_the_cue_ball():
    spins = np.zeros((3, 3))
    spins[1] = 0.0, 0.0, 9.0
    message = refusal(simulate, TABLE, STRIKE, spins=spins, positions=with_ball_in(1, 4))
    assert message.startswith("spins: [0.0, 0.0, 9.0] is for ball '1', which lies in pocket 4")


def test_who_lies_in_a_pocket_may_have_company():
    places = with_ball_in(1, 0)
    places[2] = places[1]
    shot = simulate(TABLE, STRIKE, spins=(0.0, 0.0, 5.0), positions=places)
    assert shot.pocketed.tolist()[1:] == [0, 0]
    np.testing.assert_array_equal(shot.final_positions[1:], [TABLE.pockets[0, :2]] * 2)
    assert not shot.spins([0.0, shot.duration])[:, 1:].any()


def test_a_ball_that_overlaps_a_nose():
    places = np.array(TABLE.positions)
    places[1] = TABLE.cushions.noses[0, :2] + (0.01, 0.01)
    assert refusal(simulate, TABLE, STRIKE, positions=places).startswith("positions: ball '1' of")
    message = refusal(simulate_many, TABLE, [STRIKE] * 2, positions=[TABLE.positions, places])
    assert message.startswith("positions of shot 1: ball '1' of radius")


@pytest.mark.parametrize('look_up', ['positions', 'velocities', 'spins', 'orientations'])
@pytest.mark.parametrize('times', ['noon', [[0.1]], -1, math.nan, {}, [0.1, 'x'], 10**400])
def test_times(look_up, times):
    shot = simulate(TABLE, STRIKE)
    assert refusal(getattr(shot, look_up), times).startswith('times: ')


@pytest.mark.parametrize('ball', [3, -1, 1.5, 'C', None, 2**70])
def test_the_path_of_a_ball_that_is_not_there(ball):
    message = refusal(simulate(TABLE, STRIKE).path, ball)
    assert message.startswith(f'ball: {ball!r} ')


@pytest.mark.parametrize('out', [3, (1, 2, 3), np.zeros(2)])
def test_out_that_is_none(out):
    with pytest.raises(TypeError, match='out: a .* must be Outcomes'):
        simulate_many(TABLE, [STRIKE], out=out)


@pytest.mark.parametrize('field', ['motion', 'ball_friction', 'cushion_model', 'friction_bound'])
@pytest.mark.parametrize('value', [None, 3, [], np.array(['han', 'ball']), b'ball', 'Ball'])
def test_names_of_laws(field, value):
    assert refusal(dataclasses.replace, TABLE, **{field: value}).startswith(f'{field}: ')


@pytest.mark.parametrize('value', [10**400, np.zeros((9, 9)), 'x' * 1000, [[1.0] * 200]])
def test_a_long_value_stays_one_line(value):
    for field in ('mu_roll', 'gravity', 'length', 'nose_height'):
        assert refusal(dataclasses.replace, TABLE, **{field: value}).startswith(f'{field}: ')
    assert refusal(dataclasses.replace, TABLE, cushions=value).startswith('cushions: ')
    assert refusal(dataclasses.replace, TABLE, balls=[value]).startswith('balls[0]: ')
    assert refusal(cue_strike, TABLE, value, 0.0).startswith('speed: ')
    given = dict(R=0.03, h=value, e=0.9, f=0.2, model='han')
    assert refusal(collide_cushion, (1, 0, 0), (0, 0, 0), (1, 0), **given).startswith('h: ')


@pytest.mark.parametrize('spacing', [1e-300, 5e-324, 1e-17, 1e-12])
def test_a_spacing_below_rounding_is_a_rack_that_touches(spacing):
    """It once was looked for without end."""
    balls = rack(TABLE, 'eight_ball', spacing=spacing, seed=3)
    touching = rack(TABLE, 'eight_ball', spacing=0.0)
    for ball, other in zip(balls, touching, strict=True):
        assert ball.position == pytest.approx(other.position, abs=1e-11)
    assert len(dataclasses.replace(TABLE, balls=balls).balls) == 16


def test_reprs_are_short():
    shot = simulate(TABLE, STRIKE, until=0.25)
    assert repr(TABLE) == '<Table 1.9812 x 0.9906 m, ball, 3 balls>'
    assert repr(shot) == f'<Trajectory 0.25 s, 3 balls, {len(shot.events)} events, cut>'


def test_a_label_that_is_not_there():
    assert refusal(aim_at, TABLE, 'C', '9') == "label: '9' is not on the table; it has C, 1, 2"


def test_a_file_with_a_number_beyond_all_floats(tmp_path):
    file = tmp_path / 'table.json'
    TABLE.save(file)
    text = file.read_text().replace('"length": 1.9812', f'"length": 1{"0" * 400}')
    file.write_text(text)
    assert refusal(Table.load, file).startswith(f'{file}: length: 1000')
    for folder in (Table.load, TABLE.save, simulate(TABLE, STRIKE).save):
        with pytest.raises(OSError, match=tmp_path.name):
            folder(tmp_path)


def test_kernels_of_a_pool_table_are_compiled_in_silence(caplog):
    """The report's integrator, which plays discs only, is left out."""
    compile_kernels(TABLE)
    assert not caplog.records
