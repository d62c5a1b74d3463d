"""What a Trajectory says about a shot: its events and look-ups."""

import math

import naive_shots
import numpy as np
import pytest
from segments import by_hand
from tables import LAWS, random_shots, random_table, random_velocity, table_of

from pool_sim_ros.physics import report_table, simulate

INTEGRATORS = ('event', 'time_slice')
FIELDS = ('t', 'kind', 'a', 'b', 'x', 'y', 'nx', 'ny', 'speed')


def shots(seed, law, integrator, count=4):
    rng = np.random.default_rng(seed)
    for _ in range(count):
        table = random_table(rng, 6, law, mu_ball_surface=0.2)
        velocities = [random_velocity(rng, 0.5, 3.0) for _ in table.balls]
        shot = simulate(table, velocities, integrator=integrator, time_slice=1e-5)
        assert len(shot.events) > 7
        yield table, shot


@pytest.mark.parametrize('integrator', INTEGRATORS)
@pytest.mark.parametrize('law', LAWS)
def test_events(law, integrator):
    # A slice finds a contact late: by up to its own length of motion, 3 m/s * 1e-5 s each.
    slack = 1e-12 if integrator == 'event' else 1e-4
    for table, shot in shots(61, law, integrator):
        assert shot.events.dtype.names == FIELDS
        assert np.all(np.diff(shot.events['t']) >= 0)
        for event in shot.events:
            center = shot.positions(event['t'])
            a, b, normal = event['a'], event['b'], np.array([event['nx'], event['ny']])
            point = np.array([event['x'], event['y']])
            if event['kind'] == 2:
                assert b == -1
                assert not normal.any() and event['speed'] == 0.0
                assert math.dist(point, center[a]) < 1e-12
                continue
            assert np.linalg.norm(normal) == pytest.approx(1.0, abs=1e-15)
            assert event['speed'] >= 0.0 or integrator == 'time_slice'
            assert math.dist(point, center[a] + table.radii[a] * normal) < slack
            if event['kind'] == 0:
                assert a < b
                assert math.dist(point, center[b] - table.radii[b] * normal) < slack
            else:
                outward = [(-1, 0), (1, 0), (0, -1), (0, 1)][b]
                assert tuple(normal) == outward
                wall = [0.0, table.length, 0.0, table.width][b]
                assert point[b // 2] == pytest.approx(wall, abs=slack)


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_speed_of_an_event_is_that_just_before_it(integrator):
    step = 1e-7 if integrator == 'event' else 2.5e-5
    checked = 0
    for table, shot in shots(62, 'coulomb', integrator):
        for event in shot.events[shot.events['kind'] != 2]:
            near = np.abs(shot.events['t'] - event['t']) < 3 * step
            if np.sum(near) > 1 or event['t'] < step:
                continue
            before = shot.velocities(event['t'] - step)
            closing = before[event['a']] @ [event['nx'], event['ny']]
            if event['kind'] == 0:
                closing -= before[event['b']] @ [event['nx'], event['ny']]
            assert event['speed'] == pytest.approx(closing, abs=4 * step * table.gravity)
            checked += 1
    assert checked > 20


@pytest.mark.parametrize('integrator', INTEGRATORS)
@pytest.mark.parametrize('law', LAWS)
def test_every_moving_ball_stops_once_more_than_it_is_set_off_from_rest(law, integrator):
    for _, shot in shots(63, law, integrator):
        assert not shot.final_velocities.any()
        assert shot.duration == shot.events['t'][-1]
        assert shot.events['kind'][-1] == 2
        for ball in range(6):
            own = shot.events[(shot.events['a'] == ball) | (shot.events['b'] == ball)]
            own = own[(own['kind'] != 1) | (own['a'] == ball)]
            stops = own[own['kind'] == 2]
            assert len(stops) >= 1 and own['kind'][-1] == 2
            for stop in stops:
                assert not shot.velocities(stop['t'])[ball].any()


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_positions_and_velocities_belong_together(integrator):
    """Positions are continuous, and their differences are the velocities."""
    step = 1e-6
    for _, shot in shots(64, 'coulomb', integrator, count=2):
        times = np.linspace(0.0, shot.duration - step, 5000)
        fast = np.abs(shot.velocities(times)).max()
        moved = shot.positions(times + step) - shot.positions(times)
        assert np.abs(moved).max() < (1.5 * fast + 2.0) * step
        quiet = np.ones(len(times), dtype=bool)
        for t in shot.events['t']:
            quiet &= (times < t - 3 * step - 2e-5) | (times > t + 3 * step + 2e-5)
        velocity = moved[quiet] / step
        assert quiet.sum() > 1000
        assert np.abs(velocity - shot.velocities(times[quiet])).max() < 1e-5


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_the_ends(integrator):
    table = report_table()
    shot = simulate(table, (-4.0, 0.0), integrator=integrator, time_slice=1e-5)
    np.testing.assert_array_equal(shot.positions(0.0), table.positions)
    np.testing.assert_array_equal(shot.velocities(0.0)[0], [-4.0, 0.0])
    ends = shot.positions([shot.duration, shot.duration + 1.0, 1e9])
    assert np.abs(ends - shot.final_positions).max() < 1e-9
    assert not shot.velocities([shot.duration + 1e-9, 1e9]).any()


def test_look_ups_take_any_order_and_any_number():
    shot = simulate(report_table(), (-4.0, 0.0))
    times = np.array([1.2, 0.0, 0.7, 0.7])
    positions = shot.positions(times)
    assert positions.shape == shot.velocities(times).shape == (4, 11, 2)
    for k, time in enumerate(times):
        np.testing.assert_array_equal(positions[k], shot.positions(time))
    assert shot.positions([]).shape == (0, 11, 2)
    assert shot.positions(0.5).shape == (11, 2)


@pytest.mark.parametrize('times', [-1e-9, [0.1, math.nan], math.inf * -1, [[0.0]], 'soon'])
def test_bad_times(times):
    shot = simulate(report_table(), (-1.0, 0.0))
    for look_up in (shot.positions, shot.velocities):
        with pytest.raises(ValueError, match=r'\S'):
            look_up(times)


def test_times_after_a_cut_are_refused():
    shot = simulate(report_table(), (-4.0, 0.0), until=0.5)
    assert shot.positions([0.5]).shape == (1, 11, 2)
    with pytest.raises(ValueError, match='0.6'):
        shot.positions([0.6])


def test_nothing_moves():
    for integrator in INTEGRATORS:
        shot = simulate(report_table(), (0.0, 0.0), integrator=integrator)
        assert shot.duration == 0.0
        assert len(shot.events) == 0
        np.testing.assert_array_equal(shot.final_positions, report_table().positions)


def test_results_do_not_share_memory_with_the_input():
    table = report_table()
    positions = table.positions.copy()
    shot = simulate(table, (-1.0, 0.0), positions=positions)
    start = shot.positions(0.0)
    positions[:] = 0.0
    np.testing.assert_array_equal(shot.positions(0.0), start)


def test_what_is_kept_is_in_proportion_to_what_happened():
    """A log is enlarged by doubling; its two parts must not swell each other."""
    side = 30
    places = [(0.06 + 0.12 * i, 0.06 + 0.12 * j) for i in range(side) for j in range(side)]
    table = table_of(places, length=0.12 * side, width=0.12 * side)
    velocities = np.random.default_rng(8).normal(size=(len(places), 2))
    shot = simulate(table, velocities, until=0.3)
    assert len(shot.events) > 2 * len(places)
    for kept in (shot.events, shot.segments):
        assert kept.base.nbytes < 8 * kept.nbytes


# --- By hand: any motion of constant acceleration between segments ---


def random_segments(rng, n):
    segments, starts = [], np.sort(np.r_[0.0, rng.uniform(0.0, 2.0, 8)])
    for t in starts:
        for ball in range(n):
            if t == 0.0 or rng.random() < 0.7:
                rests = rng.random() < 0.3
                motion = np.zeros(4) if rests else rng.normal(size=4)
                segments.append((ball, t, *rng.normal(size=2), *motion))
    return segments


def test_look_ups_by_hand():
    rng = np.random.default_rng(65)
    for _ in range(30):
        segments = random_segments(rng, 3)
        shot = by_hand(segments, 3.0, n=3)
        times = np.r_[rng.uniform(0.0, 3.0, 50), [s[1] for s in segments]]
        positions, velocities = shot.positions(times), shot.velocities(times)
        for k, t in enumerate(times):
            for ball in range(3):
                x, v = naive_shots.on_segments(segments, ball, t)
                assert positions[k, ball] == pytest.approx(x, abs=1e-14)
                assert velocities[k, ball] == pytest.approx(v, abs=1e-14)


def test_a_ball_that_rests_is_where_it_is_for_ever():
    shot = by_hand([(0, 0.0, 0.5, 0.25, 0, 0, 0, 0)], 0.0)
    assert shot.positions([0.0, 1e300, math.inf]).tolist() == [[[0.5, 0.25]]] * 3
    assert not shot.velocities([0.0, 1e300]).any()


def test_a_ball_may_set_off_along_one_axis_only():
    """Also where it is at rest for an instant, with an acceleration along y alone."""
    shot = by_hand([(0, 0.0, 0.5, 0.25, 0.0, 0.0, 0.0, 2.0)], 1.0)
    assert shot.positions(0.5)[0].tolist() == [0.5, 0.5]
    assert shot.velocities(0.5)[0].tolist() == [0.0, 1.0]


@pytest.mark.parametrize('time_slice', [1e-2, 1e-3])
@pytest.mark.parametrize('law', LAWS)
def test_after_a_coarse_slice_no_ball_turns_back(law, time_slice):
    """A ball rests within the slice in which it stops; its parabola ends there too."""
    for table, velocities in random_shots(66, 5, law, balls=4, mu_ball_surface=0.2):
        shot = simulate(table, velocities, integrator='time_slice', time_slice=time_slice)
        times = np.r_[
            np.linspace(0.0, shot.duration, 3000), np.add(shot.duration, [1e-6, 1.0, 1e6])
        ]
        velocities = shot.velocities(times)
        for k, earlier in enumerate(times[:-1]):
            quiet = ~np.any((shot.segments['t'] > earlier) & (shot.segments['t'] <= times[k + 1]))
            if quiet:
                turned = np.sum(velocities[k] * velocities[k + 1], axis=1) < -1e-12
                assert not turned.any()
        assert np.abs(shot.positions(times[-3:]) - shot.final_positions).max() < 1e-9
        assert not velocities[-3:].any()
