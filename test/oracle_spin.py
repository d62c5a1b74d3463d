"""High-precision oracle for balls that slide, roll and spin, and fall into pockets.

Event by event in 40 digits, one contact at a time, slow and obvious; independent of the compiled
engine. The contacts are those of `naive_spin`, the roots those of `oracle_roots`. A shot whose
outcome depends on less than the margins below raises `AmbiguousShotError`.

`parameters` are named as in oracle.json: length, width, R, g, u_s, u_r, u_sp, e_b, e_c, f_c, h,
friction ('constant', mu) or ('alciatore', ...), cushion ('han', 'impulse', 'stronge'), impulse
('pooltool', 'physical'); and, if balls differ, e_cue (contacts with ball 0) and masses. `simulate`
takes a `Table` instead.
"""

from collections import Counter, namedtuple

import naive_spin
import numpy as np
import oracle_roots as roots
from mpmath import mp, mpf
from naive_spin import cross, dot, exact, plus, size, times

INSTANT = mpf('1e-10')  # s: two events of one ball closer in time than this have no safe order
GRAZE = mpf('1e-9')  # m or m^2: a closest approach this near to contact may be a hit or a miss
SLOW = mpf('2e-3')  # m/s: an engine's rule for sustained contact may apply to slower ones
CLOSED = mpf('1e-30')  # m or m^2: the gap of things that touch, after rounding

Result = namedtuple('Result', 'finals velocities spins duration events counts pocketed')
Event = namedtuple('Event', 'time kind ball other')


class AmbiguousShotError(Exception):
    """The outcome depends on less than double precision can carry."""


class Ball:
    """A ball: place, velocity (both with z = 0), spin, and its phase."""

    def __init__(self, place, strike):
        self.r = [*exact(place), mpf(0)]
        vx, vy, *w = exact(strike)
        self.v, self.w = [vx, vy, mpf(0)], w
        self.phase, self.pocket = 'rests', -1

    def slip(self, radius):
        return naive_spin.surface(self.v, self.w, [mpf(0), mpf(0), -radius])

    def set_phase(self, radius):
        """After a contact or at the start: by what moves."""
        speed = max(size(self.v), radius * size(self.w), mpf('1e-20'))
        if size(self.slip(radius)) > speed * mpf('1e-28'):
            self.phase = 'slides'
        elif size(self.v) > 0:
            self.phase = 'rolls'
        else:
            self.phase = 'spins' if self.w[2] != 0 else 'rests'


class Play:
    """The balls at the time t, and the next events of each."""

    def __init__(self, parameters, places, strikes, segments=None, noses=(), pockets=()):
        names = ('length', 'width', 'R', 'g', 'u_s', 'u_r', 'u_sp', 'e_b', 'e_c', 'f_c', 'h')
        self.given = parameters
        values = [mpf(parameters[name]) for name in names]
        length, width, self.R, self.g, self.u_s, self.u_r, self.u_sp, *_ = values
        if segments is None:
            segments = [
                (0, 0, 0, width, 1, 0),
                (length, 0, length, width, -1, 0),
                (0, 0, length, 0, 0, 1),
                (0, width, length, width, 0, -1),
            ]
        self.segments = [exact(segment) for segment in segments]
        self.noses, self.pockets = [exact(n) for n in noses], [exact(p) for p in pockets]
        self.balls = [Ball(*each) for each in zip(places, strikes, strict=True)]
        self.t = mpf(0)
        self.next = {}
        for ball in self.balls:
            for k, (x, y, radius) in enumerate(self.pockets):
                if size(plus(ball.r, [x, y, mpf(0)], -1)) < radius:
                    self.catch(ball, k)
            if ball.pocket < 0:
                ball.set_phase(self.R)
        for i in range(len(self.balls)):
            self.predict(i)

    # --- Between contacts ---

    def acceleration(self, ball):
        if ball.phase == 'slides':
            slip = ball.slip(self.R)
            return times(slip, -self.u_s * self.g / size(slip))
        if ball.phase == 'rolls':
            return times(ball.v, -self.u_r * self.g / size(ball.v))
        return [mpf(0)] * 3

    def spin_decay(self):
        """rad/s^2, of the spin about z."""
        return 5 * self.u_sp * self.g / (2 * self.R)

    def phase_left(self, ball):
        """Seconds until the phase ends."""
        if ball.phase == 'slides':
            return 2 * size(ball.slip(self.R)) / (7 * self.u_s * self.g)
        if ball.phase == 'rolls':
            return size(ball.v) / (self.u_r * self.g)
        if ball.phase == 'spins':
            return abs(ball.w[2]) / self.spin_decay()
        return mp.inf

    def advance(self, step):
        self.t += step
        for ball in self.balls:
            a = self.acceleration(ball)
            turn = min(abs(ball.w[2]), self.spin_decay() * step) * mp.sign(ball.w[2])
            ball.r = plus(plus(ball.r, ball.v, step), a, step**2 / 2)
            ball.v = plus(ball.v, a, step)
            if ball.phase == 'slides':
                # dw/dt = 5/(2 R) z x a: friction at the lowest point.
                gain = cross([mpf(0), mpf(0), mpf(1)], a)
                ball.w = plus(ball.w, gain, -5 / (2 * self.R) * step)
            elif ball.phase == 'rolls':
                ball.w[:2] = -ball.v[1] / self.R, ball.v[0] / self.R
            ball.w[2] -= turn

    # --- The next events ---

    def predict(self, i):
        """Set again everything that ball i takes part in."""
        self.next = {key: e for key, e in self.next.items() if i not in key[1]}
        ball = self.balls[i]
        if ball.pocket >= 0:
            return
        left = self.phase_left(ball)
        if not mp.isinf(left):
            self.keep('phase', (i,), left)
        if ball.phase in ('slides', 'rolls'):
            r, v, a = ball.r, ball.v, self.acceleration(ball)
            for k, segment in enumerate(self.segments):
                self.keep('cushion', (i,), self.segment_after(r, v, a, segment, left), k)
            for k, (x, y, radius) in enumerate(self.noses):
                apart = plus(r, [x, y, mpf(0)], -1)
                after = self.circle_after(apart, v, a, self.R + radius, left)
                self.keep('cushion', (i,), after, len(self.segments) + k)
            for k, (x, y, radius) in enumerate(self.pockets):
                apart = plus(r, [x, y, mpf(0)], -1)
                self.keep('pocketed', (i,), self.circle_after(apart, v, a, radius, left), k)
        for j, other in enumerate(self.balls):
            if j == i or other.pocket >= 0:
                continue
            if not {ball.phase, other.phase} & {'slides', 'rolls'}:
                continue
            horizon = min(
                self.phase_left(each) for each in (ball, other) if each.phase in ('slides', 'rolls')
            )
            apart, v = plus(ball.r, other.r, -1), plus(ball.v, other.v, -1)
            a = plus(self.acceleration(ball), self.acceleration(other), -1)
            after = self.circle_after(apart, v, a, 2 * self.R, horizon)
            self.keep('ball', (min(i, j), max(i, j)), after)

    def keep(self, kind, balls, after, other=None):
        if after is not None:
            number = balls[1] if kind == 'ball' else other
            self.next[(kind, balls, other)] = Event(self.t + after, kind, balls[0], number)

    def segment_after(self, r, v, a, segment, horizon):
        x0, y0, x1, y1, *normal = segment
        n, start = [*normal, mpf(0)], [x0, y0, mpf(0)]
        way = [x1 - x0, y1 - y0, mpf(0)]
        gap = [dot(plus(r, start, -1), n) - self.R, dot(v, n), dot(a, n) / 2]
        for t in self.entries(gap, horizon, 'a cushion'):
            at = plus(plus(r, v, t), a, t**2 / 2)
            if 0 <= dot(plus(at, start, -1), way) <= dot(way, way):
                return t
        return None

    def circle_after(self, apart, v, a, reach, horizon):
        gap = [
            dot(apart, apart) - reach**2,
            2 * dot(apart, v),
            dot(v, v) + dot(apart, a),
            dot(v, a),
            dot(a, a) / 4,
        ]
        return next(iter(self.entries(gap, horizon, 'a circle', GRAZE)), None)

    @staticmethod
    def entries(gap, horizon, what, graze=GRAZE):
        """Times at which a gap, a polynomial, becomes negative."""
        if abs(gap[0]) < CLOSED:
            if gap[1] < 0:
                return [mpf(0)]
            rest = gap[1:]  # without the contact at t = 0
            return [
                t
                for t in roots.real_roots(rest, mpf(0), horizon)
                if roots.evaluate(roots.derivative(rest), t) < 0
            ]
        slope = roots.derivative(gap)
        found = [t for t in roots.real_roots(gap, mpf(0), horizon) if roots.evaluate(slope, t) < 0]
        first = found[0] if found else horizon
        for turn in roots.real_roots(slope, mpf(0), first):
            if abs(roots.evaluate(gap, turn)) < graze:
                raise AmbiguousShotError(f'{what} is grazed')
        return found

    # --- Events ---

    def check(self, event):
        """Nothing else may happen to the balls of an event at the same time."""
        balls = {event.ball, event.other} if event.kind == 'ball' else {event.ball}
        for (_, others, _), other in self.next.items():
            if other is not event and balls & set(others) and other.time - event.time < INSTANT:
                raise AmbiguousShotError(f'{event} and {other} at one time')

    def catch(self, ball, pocket):
        ball.r = [*self.pockets[pocket][:2], mpf(0)]
        ball.v, ball.w = [mpf(0)] * 3, [mpf(0)] * 3
        ball.phase, ball.pocket = 'rests', pocket

    def end_phase(self, ball):
        """Return the kind of the event."""
        if ball.phase == 'slides':
            ball.w[:2] = -ball.v[1] / self.R, ball.v[0] / self.R
            ball.phase = 'rolls'
            return 'roll'
        kind = 'stop' if ball.phase == 'rolls' else 'spin_end'
        ball.v, ball.w[:2] = [mpf(0)] * 3, (mpf(0), mpf(0))
        if kind == 'spin_end':
            ball.w[2] = mpf(0)
        ball.phase = 'spins' if ball.w[2] != 0 else 'rests'
        return kind

    def hit_ball(self, one, other):
        given = self.given
        i, j = self.balls.index(one), self.balls.index(other)
        e = given.get('e_cue', given['e_b']) if 0 in (i, j) else given['e_b']
        masses = given.get('masses', [1] * len(self.balls))
        apart = plus(other.r, one.r, -1)
        normal = times(apart, 1 / size(apart))
        self.check_speed(dot(plus(one.v, other.v, -1), normal))
        law, *numbers = given['friction']
        mu = naive_spin.alciatore if law == 'alciatore' else lambda _: mpf(numbers[0])
        one.v, one.w, other.v, other.w = naive_spin.collide_balls(
            one.v,
            one.w,
            other.v,
            other.w,
            normal,
            masses[i],
            masses[j],
            self.R,
            e,
            mu,
            'restitution' if given['impulse'] == 'pooltool' else 'impulse',
        )

    def hit_cushion(self, ball, number):
        given, radius = self.given, mpf(0)
        if number < len(self.segments):
            normal = times([*self.segments[number][4:], mpf(0)], -1)
        else:
            x, y, radius = self.noses[number - len(self.segments)]
            apart = plus([x, y, mpf(0)], ball.r, -1)
            normal = times(apart, 1 / size(apart))
        self.check_speed(dot(ball.v, normal))
        names = ('h', 'e_c', 'f_c', 'cushion')
        ball.v, ball.w = naive_spin.collide_cushion(
            ball.v, ball.w, normal, self.R, *(given[name] for name in names), radius
        )
        self.check_speed(-dot(ball.v, normal))

    @staticmethod
    def check_speed(speed):
        if speed < SLOW:
            raise AmbiguousShotError(f'a contact at {mp.nstr(speed, 3)} m/s')

    def happen(self, event):
        """Let an event happen; return its kind, and what it is with."""
        ball = self.balls[event.ball]
        if event.kind == 'phase':
            return self.end_phase(ball), None
        if event.kind == 'pocketed':
            self.catch(ball, event.other)
            return event.kind, event.other
        if event.kind == 'ball':
            other = self.balls[event.other]
            self.hit_ball(ball, other)
            other.set_phase(self.R)
        else:
            self.hit_cushion(ball, event.other)
        ball.set_phase(self.R)
        return event.kind, event.other


def play(
    parameters, places, strikes, segments=None, noses=(), pockets=(), most_events=2000, until=None
):
    """Play a shot to its end, or to the time `until`.

    `strikes` are rows vx, vy, wx, wy, wz, one for each ball or for the first ones. Returns finals,
    velocities, spins, duration, events (time, kind, ball, other), counts by kind, and the pocket of
    each ball or -1.
    """
    strikes = [*strikes, *[(0.0,) * 5] * (len(places) - len(strikes))]
    shot = Play(parameters, places, strikes, segments, noses, pockets)
    events = []
    while shot.next:
        event = min(shot.next.values(), key=lambda each: each.time)
        if until is not None and event.time > until:
            shot.advance(mpf(until) - shot.t)
            break
        shot.check(event)
        shot.advance(event.time - shot.t)
        kind, other = shot.happen(event)
        events.append(Event(event.time, kind, event.ball, other))
        if len(events) > most_events:
            raise AmbiguousShotError(f'more than {most_events} events')
        shot.predict(event.ball)
        if kind == 'ball':
            shot.predict(event.other)
    return Result(
        [ball.r[:2] for ball in shot.balls],
        [ball.v[:2] for ball in shot.balls],
        [ball.w for ball in shot.balls],
        shot.t,
        events,
        dict(Counter(event.kind for event in events)),
        [ball.pocket for ball in shot.balls],
    )


KINDS = {'ball': 0, 'cushion': 1, 'stop': 2, 'pocketed': 3, 'roll': 4}
"""The kinds of an engine's events; the end of spinning in place is none."""


def parameters_of(table):
    """Return the parameters of a `Table` with the motion 'ball'."""
    alciatore = table.ball_friction == 'alciatore'
    return dict(
        length=table.length,
        width=table.width,
        R=table.balls[0].radius,
        g=table.gravity,
        u_s=table.mu_slide,
        u_r=table.mu_roll,
        u_sp=table.mu_spin,
        e_b=table.e_ball_ball,
        e_cue=table.e_cue_ball,
        e_c=table.e_ball_cushion,
        f_c=table.mu_ball_cushion,
        h=table.nose_height,
        friction=('alciatore',) if alciatore else ('constant', table.mu_ball_ball),
        cushion=table.cushion_model,
        impulse={'restitution': 'pooltool', 'impulse': 'physical'}[table.friction_bound],
        masses=[ball.mass for ball in table.balls],
    )


def simulate(table, velocities, spins=None, positions=None, **options):
    """Play a shot on a `Table` with the motion 'ball' and equal radii; see `play`.

    `velocities` (2,) and `spins` (3,) are the cue ball's, or one row for each ball; `options` are
    those of `play`.
    """
    count = len(table.balls)
    places = [ball.position for ball in table.balls] if positions is None else positions
    strikes = [[0.0] * 5 for _ in range(count)]
    for given, first, last in ((velocities, 0, 2), (spins, 2, 5)):
        for strike, row in zip(strikes, [] if given is None else rows_of(given), strict=False):
            strike[first:last] = (float(part) for part in row)
    cushions = table.cushions
    segments, noses = (None, ()) if cushions is None else (cushions.segments, cushions.noses)
    pockets = () if table.pockets is None else table.pockets
    shot = parameters_of(table), places, strikes
    return play(*shot, segments, noses, pockets, **options)


def rows_of(values):
    """Return vectors, one a row; a single one is that of the first ball."""
    return [values] if np.ndim(values) == 1 else values


def engine_events(result):
    """Return the events as an engine lists them: (time, kind, ball, other), other -1 for none."""
    return [
        (
            float(event.time),
            KINDS[event.kind],
            event.ball,
            -1 if event.other is None else event.other,
        )
        for event in result.events
        if event.kind in KINDS
    ]
