"""High-precision oracle: event-driven motion in 50-digit arithmetic, one contact at a time.

Independent of the compiled engine: the next contact is found by isolating the roots of the exact
gap polynomials, never by stepping.  A shot whose outcome hangs on less than the margins below
raises `AmbiguousShotError`, so that a test can skip it and say so.

Command line: `python test/oracle.py --shots 200 --seed 1 --ball-friction coulomb` compares the
engine with it on random shots.
"""

import argparse
import dataclasses
import math
import sys
from collections import namedtuple

import numpy as np
import oracle_roots as roots
from mpmath import mp, mpf

DIGITS = 50
INSTANT = mpf('1e-12')  # s: two contacts closer in time than this have no safe order
NEAR = mpf('1e-8')  # m: a second contact of the same ball nearer than this is simultaneous
GRAZE = mpf('1e-12')  # m^2: a closest approach this near to contact may be a hit or a miss
SLOW = mpf('2e-4')  # m/s: the engine's rule for sustained contact may apply to slower ones
NO_SLIP = mpf('1e-13')  # of the closing speed: the rounding of a head-on hit, no slip at all
SLIP = mpf('1e-8')  # m/s: under the report's law the sign of a smaller slip is not safe

OracleResult = namedtuple('OracleResult', 'final_positions duration events')
Prediction = namedtuple('Prediction', 'time kind a b')


class AmbiguousShotError(Exception):
    """The outcome hangs on less than double precision can carry."""


class Motion:
    """Positions and velocities at the time `t`, in 50 digits, and each ball's next contacts."""

    def __init__(self, table, velocities, positions):
        self.table = table
        balls = table.balls
        positions = [ball.position for ball in balls] if positions is None else positions
        velocities = np.asarray(velocities, dtype=float)
        if velocities.ndim == 1:
            velocities = np.vstack([velocities, np.zeros((len(balls) - 1, 2))])
        self.x = [[mpf(float(c)) for c in position] for position in positions]
        self.v = [[mpf(float(c)) for c in velocity] for velocity in velocities]
        self.radius = [mpf(ball.radius) for ball in balls]
        self.mass = [mpf(ball.mass) for ball in balls]
        self.size = [mpf(table.length), mpf(table.width)]
        self.a = mpf(table.mu_ball_surface) * mpf(table.gravity)
        self.t = mpf(0)
        self.predictions = {}
        for ball in range(len(balls)):
            self.predict(ball)

    def speed(self, i):
        return mp.sqrt(self.v[i][0] ** 2 + self.v[i][1] ** 2)

    def moving(self, i):
        return self.v[i][0] != 0 or self.v[i][1] != 0

    def half_acceleration(self, i):
        if not self.moving(i):
            return [mpf(0), mpf(0)]
        speed = self.speed(i)
        return [-self.a * self.v[i][0] / (2 * speed), -self.a * self.v[i][1] / (2 * speed)]

    def stop_after(self, i):
        return self.speed(i) / self.a if self.a > 0 and self.moving(i) else mp.inf

    def predict(self, i):
        """Set again everything that ball i takes part in."""
        for key in [key for key in self.predictions if i in key[1:]]:
            del self.predictions[key]
        if self.moving(i):
            self.keep(2, i, -1, self.stop_after(i))
            for cushion in range(4):
                self.keep(1, i, cushion, self.cushion_after(i, cushion))
        for j in range(len(self.x)):
            if j != i and (self.moving(i) or self.moving(j)):
                a, b = min(i, j), max(i, j)
                self.keep(0, a, b, self.ball_after(a, b))

    def keep(self, kind, a, b, after):
        if after is not None and not mp.isinf(after):
            # Key: kind and the balls; a cushion's number must not look like a ball's.
            key = (kind, a, b) if kind == 0 else ((kind, b), a)
            self.predictions[key] = Prediction(self.t + after, kind, a, b)

    def cushion_after(self, i, cushion):
        """s = v t - a t^2 / 2 along the straight path, its first root."""
        axis, outward = cushion // 2, 1 if cushion % 2 else -1
        closing = outward * self.v[i][axis]
        if closing <= 0:
            return None
        wall = self.size[axis] if outward == 1 else mpf(0)
        gap = outward * (wall - self.x[i][axis]) - self.radius[i]
        speed = self.speed(i)
        distance = max(gap, mpf(0)) * speed / closing
        under_root = speed * speed - 2 * self.a * distance
        if abs(under_root) < GRAZE and self.a > 0:
            raise AmbiguousShotError(f'ball {i} stops at cushion {cushion}')
        if under_root < 0:
            return None
        return 2 * distance / (speed + mp.sqrt(under_root))

    def ball_after(self, a, b):
        """First time at which the gap polynomial enters contact, before either ball stops.

        |d + w t + c t^2|^2 - reach^2 on [0, first stop].  Double precision only rejects pairs whose
        paths stay farther apart than any rounding could bridge.
        """
        reach = self.radius[a] + self.radius[b]
        horizon = min(self.stop_after(a), self.stop_after(b))
        if mp.isinf(horizon):
            horizon = self.contact_horizon(a, b)
        if self.out_of_reach(a, b, reach, horizon):
            return None
        d = [self.x[b][k] - self.x[a][k] for k in (0, 1)]
        w = [self.v[b][k] - self.v[a][k] for k in (0, 1)]
        half_a, half_b = self.half_acceleration(a), self.half_acceleration(b)
        c = [half_b[k] - half_a[k] for k in (0, 1)]
        gap = [
            d[0] * d[0] + d[1] * d[1] - reach * reach,
            2 * (d[0] * w[0] + d[1] * w[1]),
            w[0] * w[0] + w[1] * w[1] + 2 * (d[0] * c[0] + d[1] * c[1]),
            2 * (w[0] * c[0] + w[1] * c[1]),
            c[0] * c[0] + c[1] * c[1],
        ]
        slope = roots.derivative(gap)
        if gap[0] <= GRAZE and gap[1] < 0:
            return mpf(0)
        crossings = roots.real_roots(gap, mpf(0), horizon)
        entries = [t for t in crossings if roots.evaluate(slope, t) < 0]
        first = entries[0] if entries else horizon
        for turn in [*roots.real_roots(slope, mpf(0), first), horizon]:
            if turn > 0 and abs(roots.evaluate(gap, turn)) < GRAZE:
                raise AmbiguousShotError(f'balls {a} and {b} graze')
        return entries[0] if entries else None

    def contact_horizon(self, a, b):
        """Without surface friction: the time for the relative motion to cross the table."""
        w = mp.sqrt(sum((self.v[b][k] - self.v[a][k]) ** 2 for k in (0, 1)))
        return 2 * (self.size[0] + self.size[1]) / w if w > 0 else mpf(0)

    def out_of_reach(self, a, b, reach, horizon):
        """True only if the segments that the two balls can cover stay apart by more than 1 um."""
        span = float(horizon)
        ends = []
        for i in (a, b):
            start = np.array([float(c) for c in self.x[i]])
            velocity = np.array([float(c) for c in self.v[i]])
            bend = np.array([float(c) for c in self.half_acceleration(i)])
            ends.append((start, start + velocity * span + bend * span * span))
        return roots.segment_distance(*ends[0], *ends[1]) > float(reach) + 1e-6

    def advance(self, step):
        for i in range(len(self.x)):
            if self.moving(i):
                half = self.half_acceleration(i)
                for k in (0, 1):
                    self.x[i][k] += self.v[i][k] * step + half[k] * step * step
                    self.v[i][k] += 2 * half[k] * step
        self.t += step

    # --- Contacts ---

    def collide_cushion(self, i, cushion):
        axis = cushion // 2
        table = self.table
        normal, along = self.v[i][axis], self.v[i][1 - axis]
        self.check_speed(abs(normal), f'ball {i} on cushion {cushion}')
        new = -mpf(table.e_ball_cushion) * normal
        loss = mpf(table.mu_ball_cushion) * abs(new - normal)
        self.v[i][axis] = new
        self.v[i][1 - axis] = mp.sign(along) * max(mpf(0), abs(along) - loss)

    def collide_balls(self, a, b):
        """Equations 1 and 2 along the centre line; across it the table's friction law."""
        table = self.table
        m_a, m_b = self.mass[a], self.mass[b]
        d = [self.x[b][k] - self.x[a][k] for k in (0, 1)]
        distance = mp.sqrt(d[0] ** 2 + d[1] ** 2)
        n = [d[0] / distance, d[1] / distance]
        a_n, b_n = (self.v[i][0] * n[0] + self.v[i][1] * n[1] for i in (a, b))
        a_t, b_t = (self.v[i][1] * n[0] - self.v[i][0] * n[1] for i in (a, b))
        self.check_speed(a_n - b_n, f'balls {a} and {b}')
        involves_cue = table.balls[a].is_cue or table.balls[b].is_cue
        e = table.e_cue_ball if involves_cue else table.e_ball_ball
        mu = mpf(table.mu_ball_ball)
        j_n = (1 + mpf(e)) * (a_n - b_n) * m_a * m_b / (m_a + m_b)
        slip = a_t - b_t
        if table.ball_friction == 'report':
            if abs(slip) < NO_SLIP * (a_n - b_n):
                slip = mpf(0)
            if 0 < abs(slip) < SLIP:
                slip = mp.nstr(slip, 3)
                raise AmbiguousShotError(f'balls {a} and {b} meet with a slip of {slip} m/s')
            new_a = a_t - mp.sign(slip) * mu * j_n / m_a
            new_b = b_t - mp.sign(slip) * mu * j_n / m_b
            a_t = new_a if a_t == 0 or mp.sign(new_a) == mp.sign(a_t) else mpf(0)
            b_t = new_b if b_t == 0 or mp.sign(new_b) == mp.sign(b_t) else mpf(0)
        else:
            j_t = mp.sign(slip) * min(mu * j_n, abs(slip) * m_a * m_b / (m_a + m_b))
            a_t, b_t = a_t - j_t / m_a, b_t + j_t / m_b
        a_n, b_n = a_n - j_n / m_a, b_n + j_n / m_b
        self.v[a] = [a_n * n[0] - a_t * n[1], a_n * n[1] + a_t * n[0]]
        self.v[b] = [b_n * n[0] - b_t * n[1], b_n * n[1] + b_t * n[0]]

    @staticmethod
    def check_speed(closing, where):
        if closing < SLOW:
            raise AmbiguousShotError(f'{where} close at {mp.nstr(closing, 3)} m/s')

    def check_alone(self, event):
        """No other contact may fall into the same instant."""
        balls = {event.a, event.b} if event.kind == 0 else {event.a}
        for other in self.predictions.values():
            if other is event or other.kind == 2:
                continue
            if other.time - self.t < INSTANT:
                raise AmbiguousShotError(f'{event} and {other} at one instant')
            shares = balls & ({other.a, other.b} if other.kind == 0 else {other.a})
            if shares and self.gap(other) < NEAR:
                raise AmbiguousShotError(f'{event} and {other} nearly at one instant')

    def check_stop(self, event):
        for other in self.predictions.values():
            shares = event.a in ((other.a, other.b) if other.kind == 0 else (other.a,))
            if other.kind != 2 and shares and other.time - self.t < INSTANT:
                raise AmbiguousShotError(f'{event} and {other} at one instant')

    def gap(self, event):
        if event.kind == 1:
            axis = event.b // 2
            wall = self.size[axis] if event.b % 2 else mpf(0)
            return abs(wall - self.x[event.a][axis]) - self.radius[event.a]
        d = [self.x[event.b][k] - self.x[event.a][k] for k in (0, 1)]
        reach = self.radius[event.a] + self.radius[event.b]
        return mp.sqrt(d[0] ** 2 + d[1] ** 2) - reach


def simulate(table, velocities, positions=None, until=None, most_events=2000):
    """Final positions (n, 2) as floats, duration (s) and events (t, kind, a, b) of a shot.

    Raises `AmbiguousShotError` where the outcome hangs on less than the margins of this module.
    """
    with mp.workdps(DIGITS):
        motion = Motion(table, velocities, positions)
        end = mp.inf if until is None else mpf(until)
        if motion.a == 0 and until is None:
            raise ValueError('until is required where mu_ball_surface is 0')
        events = []
        while motion.predictions:
            event = min(motion.predictions.values(), key=lambda prediction: prediction.time)
            if event.time > end or len(events) == most_events:
                break
            motion.advance(event.time - motion.t)
            if event.kind == 2:
                motion.check_stop(event)
                motion.v[event.a] = [mpf(0), mpf(0)]
            else:
                motion.check_alone(event)
                if event.kind == 1:
                    motion.collide_cushion(event.a, event.b)
                else:
                    motion.collide_balls(event.a, event.b)
                    motion.predict(event.b)
            motion.predict(event.a)
            events.append((float(event.time), event.kind, event.a, event.b))
        if len(events) == most_events:
            raise AmbiguousShotError(f'more than {most_events} events')
        if not mp.isinf(end):
            motion.advance(end - motion.t)
        final = np.array([[float(c) for c in position] for position in motion.x])
        return OracleResult(final, float(motion.t), events)


def random_velocity(rng, slowest=0.2, fastest=6.0):
    speed, angle = rng.uniform(slowest, fastest), rng.uniform(-math.pi, math.pi)
    return speed * np.array([math.cos(angle), math.sin(angle)])


def main(arguments=None):
    parser = argparse.ArgumentParser(description='Compare the engine with the oracle.')
    parser.add_argument('--shots', type=int, default=50)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--ball-friction', choices=('report', 'coulomb'), default='report')
    options = parser.parse_args(arguments)
    from pool_sim_ros.physics import report_table
    from pool_sim_ros.physics import simulate as engine

    table = dataclasses.replace(report_table(), ball_friction=options.ball_friction)
    rng = np.random.default_rng(options.seed)
    worst, skipped = 0.0, 0
    for shot in range(options.shots):
        velocity = random_velocity(rng)
        try:
            expected = simulate(table, velocity)
        except AmbiguousShotError as reason:
            skipped += 1
            print(f'shot {shot}, velocity {velocity.tolist()}: skipped, {reason}')
            continue
        difference = np.abs(engine(table, velocity).final_positions - expected.final_positions)
        worst = max(worst, float(difference.max()))
    print(f'{options.shots - skipped} shots compared, {skipped} skipped as ambiguous')
    print(f'largest position difference {worst:.2g} m')
    return 0


if __name__ == '__main__':
    sys.exit(main())
