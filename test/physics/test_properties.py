"""Any table and any shot, as hypothesis finds them: the checks of `test_robust`."""

import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from soundness import assert_sound
from tables import under

from pool_sim_ros.physics import Ball, Table, simulate

CELL = 0.12  # m: the side of the square that each ball has to itself
COLUMNS = 10

speeds = st.one_of(
    st.just(0.0),
    st.sampled_from([-1.0, 1.0, 1e-12, -1e-4, 2.0]),
    st.floats(-5.0, 5.0, allow_subnormal=False),
)


@st.composite
def balls_in_cells(draw):
    """Draw 1 to 60 balls, each somewhere in a square of its own, often touching its sides."""
    balls = []
    for k in range(draw(st.integers(1, 60))):
        radius = draw(st.sampled_from([0.06, 0.06, 0.03, 0.01]))
        room = CELL - 2 * radius
        share = draw(st.tuples(*[st.sampled_from([0.0, 0.5, 1.0]) | st.floats(0.0, 1.0)] * 2))
        x = CELL * (k % COLUMNS) + radius + room * share[0]
        y = CELL * (k // COLUMNS) + radius + room * share[1]
        mass = draw(st.sampled_from([0.16, 0.16, 0.2, 0.01, 2.0]))
        balls.append(Ball(str(k), mass, radius, (x, y), is_cue=k == 0))
    return balls


@st.composite
def coulomb_tables(draw):
    balls = draw(balls_in_cells())
    fractions = st.sampled_from([0.0, 0.5, 0.7, 0.95, 1.0])
    return Table(
        CELL * min(len(balls), COLUMNS) + draw(st.sampled_from([0.0, 1e-3, 0.5])),
        CELL * -(-len(balls) // COLUMNS) + draw(st.sampled_from([0.0, 1e-3, 0.5])),
        balls,
        mu_ball_ball=draw(st.sampled_from([0.0, 0.05, 1.0])),
        mu_ball_surface=draw(st.sampled_from([0.05, 0.2])),
        mu_ball_cushion=draw(st.sampled_from([0.0, 0.2])),
        e_cue_ball=draw(fractions),
        e_ball_ball=draw(fractions),
        e_ball_cushion=draw(fractions),
        ball_friction='coulomb',
    )


def test_balls_without_room_between_rails_that_lose_nothing():
    radii, places = (0.06,) * 4 + (0.03, 0.06), (0.06, 0.18, 0.3, 0.42, 0.51, 0.66)
    balls = [
        Ball(str(k), 0.16, radius, (x, radius), is_cue=k == 0)
        for k, (radius, x) in enumerate(zip(radii, places, strict=True))
    ]
    table = Table(
        0.72,
        0.12,
        balls,
        mu_ball_ball=0.0,
        mu_ball_surface=0.05,
        mu_ball_cushion=0.0,
        e_cue_ball=0.0,
        e_ball_ball=0.0,
        e_ball_cushion=1.0,
        ball_friction='coulomb',
    )
    velocities = np.zeros((6, 2))
    velocities[5] = -1.0, -1.0
    shot = simulate(table, velocities, until=0.2)
    assert np.isfinite(shot.final_positions).all() and len(shot.events) < 5000


def velocities_of(table):
    return st.lists(
        st.tuples(speeds, speeds), min_size=len(table.balls), max_size=len(table.balls)
    ).map(np.array)


SETTINGS = settings(
    max_examples=25,
    derandomize=True,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)


@SETTINGS
@given(st.data())
def test_any_shot_under_coulomb(data):
    table = data.draw(coulomb_tables())
    assert_sound(table, data.draw(velocities_of(table)), most_events=100_000, until=0.2)


@SETTINGS
@given(st.data())
def test_any_shot_under_the_law_of_the_report(data):
    """With the report's own coefficients, for which its law is tame."""
    drawn = data.draw(coulomb_tables())
    table = under(
        Table(drawn.length, drawn.width, drawn.balls), e_cue_ball=0.7, ball_friction='report'
    )
    assert_sound(table, data.draw(velocities_of(table)), most_events=100_000, until=0.2)
