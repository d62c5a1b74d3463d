"""A layout of its own for each of many shots, and results that are written where one wants them."""

import dataclasses

import numpy as np
import pytest
from tables import LAWS, random_layout, random_table, random_velocity, table_of

from pool_sim_ros.physics import INTEGRATORS, cores, report_table, simulate, simulate_many
from pool_sim_ros.physics.event_driven.cell_grid import FEW
from pool_sim_ros.physics.outcomes import Outcomes

COARSE = {'time_slice': 1e-3}


def random_layouts(rng, table, count):
    return np.array(
        [random_layout(rng, table.radii, table.length, table.width) for _ in range(count)]
    )


def assert_one_by_one(table, velocities, layouts, outcomes, **options):
    for k, (velocity, layout) in enumerate(zip(velocities, layouts, strict=True)):
        shot = simulate(table, velocity, positions=layout, **options)
        assert outcomes.finals[k].tobytes() == shot.final_positions.tobytes()
        assert outcomes.durations[k] == shot.duration
        assert outcomes.event_counts[k] == len(shot.events)


@pytest.mark.parametrize('threads', [1, 2])
@pytest.mark.parametrize('law', LAWS)
def test_layouts_of_few_balls(law, threads, monkeypatch):
    monkeypatch.setattr(cores, 'CHUNK', 30)
    rng = np.random.default_rng(55)
    table = dataclasses.replace(report_table(), ball_friction=law)
    layouts = random_layouts(rng, table, 100)
    velocities = [random_velocity(rng) for _ in layouts]
    outcomes = simulate_many(table, velocities, positions=layouts, threads=threads)
    assert_one_by_one(table, velocities, layouts, outcomes)


@pytest.mark.parametrize('law', LAWS)
def test_one_shot_from_another_layout_each_time(law):
    """What is kept for the table is put to each layout, and back to the table's own."""
    rng = np.random.default_rng(59)
    table = dataclasses.replace(report_table(), ball_friction=law)
    layouts = random_layouts(rng, table, 10)
    layouts[::3] = table.positions
    velocities = [random_velocity(rng) for _ in layouts]
    whole = simulate_many(table, velocities, positions=layouts)
    for k, (velocity, layout) in enumerate(zip(velocities, layouts, strict=True)):
        given = {} if k % 3 == 0 else {'positions': layout}
        alone = simulate_many(table, [velocity], **given)
        for one, all_ in zip(alone[:6], whole[:6], strict=True):
            assert one[0].tobytes() == all_[k].tobytes()


@pytest.mark.parametrize('threads', [1, 2])
def test_layouts_of_many_balls(threads, monkeypatch):
    monkeypatch.setattr(cores, 'CHUNK', 7)
    rng = np.random.default_rng(56)
    count = FEW + 20
    places = random_layout(rng, np.full(count, 0.02), 1.4, 0.8)
    table = table_of(places, length=1.4, width=0.8, radius=0.02, ball_friction='coulomb')
    layouts = random_layouts(rng, table, 20)
    velocities = rng.normal(size=(20, count, 2))
    velocities[::2, 1:] = 0.0
    outcomes = simulate_many(table, velocities, positions=layouts, threads=threads, until=1.0)
    assert_one_by_one(table, velocities, layouts, outcomes, until=1.0)


def test_layouts_under_the_report_s_integrator():
    rng = np.random.default_rng(57)
    table = random_table(rng, 4, mu_ball_surface=0.2)
    layouts = random_layouts(rng, table, 5)
    velocities = rng.normal(size=(5, 4, 2))
    options = {'integrator': 'time_slice', **COARSE}
    outcomes = simulate_many(table, velocities, positions=layouts, **options)
    assert_one_by_one(table, velocities, layouts, outcomes, **options)


def test_layouts_near_the_table_s_own():
    """As a planner asks: noise of the camera, so small or so large that balls come near."""
    rng = np.random.default_rng(58)
    table = report_table()
    sizes = 10.0 ** rng.uniform(-6, -1.5, 80)
    layouts = table.positions + sizes[:, None, None] * rng.uniform(-1.0, 1.0, (80, 11, 2))
    velocities = [random_velocity(rng) for _ in layouts]
    outcomes = simulate_many(table, velocities, positions=layouts, errors='mark')
    for k, failed in enumerate(outcomes.failed):
        if failed:
            with pytest.raises(ValueError, match='positions: '):
                simulate(table, velocities[k], positions=layouts[k])
            continue
        shot = simulate(table, velocities[k], positions=layouts[k])
        assert outcomes.finals[k].tobytes() == shot.final_positions.tobytes()
    assert 0 < outcomes.failed.sum() < 80


@pytest.mark.parametrize('solve', [simulate, simulate_many])
@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_a_layout_in_any_memory_order(solve, integrator):
    table = table_of([(0.5, 0.5), (1.0, 0.5), (1.5, 0.52)])
    velocities = (2.0, 0.05) if solve is simulate else [(2.0, 0.05)]
    plain = np.array([(1.7, 0.2), (0.3, 0.25), (0.9, 0.22)])
    read_only = plain.copy()
    read_only.flags.writeable = False
    kinds = (
        plain.tolist(),
        np.asfortranarray(plain),
        np.repeat(plain, 2, axis=0)[::2],
        plain.astype('>f8'),
        read_only,
    )
    expected = solve(table, velocities, positions=plain, integrator=integrator, **COARSE)
    for layout in kinds:
        found = solve(table, velocities, positions=layout, integrator=integrator, **COARSE)
        for a, b in zip(ends_of(found), ends_of(expected), strict=True):
            assert a.tobytes() == b.tobytes()


def ends_of(result):
    if isinstance(result, Outcomes):
        return result.finals, result.durations
    return result.final_positions, result.events


@pytest.mark.parametrize('shape', [(10, 11, 2), (4, 10, 2), (4, 11, 3), (1, 4, 11, 2), (11,)])
def test_layouts_of_another_shape(shape):
    with pytest.raises(ValueError, match=r'positions: shape .*\(4, 11, 2\)'):
        simulate_many(report_table(), np.zeros((4, 2)), positions=np.zeros(shape))


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_results_are_written_to_out(integrator, tmp_path):
    table, velocities = report_table(), np.array([(-1.0, 0.01 * k) for k in range(4)])
    options = {'integrator': integrator, **COARSE}
    expected = simulate_many(table, velocities, **options)
    mapped = np.lib.format.open_memmap(
        tmp_path / 'finals.npy', mode='w+', dtype=float, shape=(4, 11, 2)
    )
    mine = Outcomes(
        finals=mapped,
        durations=np.full(4, 7.0),
        event_counts=np.full(4, 7),
        pocketed=np.full((4, 11), 7),
        first_hit=np.full(4, 7),
        failed=np.full(4, 7, np.int8),
        events=None,
        offsets=None,
    )
    found = simulate_many(table, velocities, out=mine, **options)
    mapped.flush()
    assert np.load(tmp_path / 'finals.npy').tobytes() == expected.finals.tobytes()
    for name in ('finals', 'durations', 'event_counts', 'pocketed', 'first_hit', 'failed'):
        assert np.shares_memory(getattr(found, name), getattr(mine, name))
        np.testing.assert_array_equal(getattr(mine, name), getattr(expected, name))


def test_outcomes_may_be_written_to_again():
    table = report_table()
    out = simulate_many(table, [(-4.0, 0.0), (-1.0, 0.0)])
    again = simulate_many(table, [(-1.0, 0.0), (-4.0, 0.0)], out=out)
    assert again.finals is out.finals
    assert again.finals[1].tobytes() == simulate(table, (-4.0, 0.0)).final_positions.tobytes()


def test_out_of_another_size():
    table = report_table()
    out = simulate_many(table, [(-1.0, 0.0)])
    with pytest.raises(ValueError, match=r'out\.finals: .*\(2, 11, 2\) float64'):
        simulate_many(table, [(-1.0, 0.0)] * 2, out=out)
