"""Plain twins of what is asked of a layout, of a list of events and of a trajectory."""

import math


def overlap(table, positions):
    """Return the deepest overlap in m of any two balls or of a ball and a cushion; NaN is inf."""
    worst = -math.inf
    for i, (x, y) in enumerate(positions):
        if not (math.isfinite(x) and math.isfinite(y)):
            return math.inf
        radius = table.balls[i].radius
        worst = max(worst, radius - x, radius - y)
        worst = max(worst, x + radius - table.length, y + radius - table.width)
        for k in range(i):
            distance = math.hypot(x - positions[k][0], y - positions[k][1])
            worst = max(worst, radius + table.balls[k].radius - distance)
    return worst


def first_hit(events, cue_ball):
    """Return the other ball of the first event of two balls that has the cue ball; -1: none."""
    for event in events:
        if event['kind'] == 0 and cue_ball in (event['a'], event['b']):
            return int(event['a'] + event['b'] - cue_ball)
    return -1


def on_segments(segments, ball, t):
    """Position and velocity of a ball at `t`: x + v t + a t^2 / 2 on its last segment by then."""
    own = [segment for segment in segments if segment[0] == ball and segment[1] <= t]
    _, since, x, y, vx, vy, ax, ay = own[-1]
    s = t - since
    position = x + vx * s + 0.5 * ax * s * s, y + vy * s + 0.5 * ay * s * s
    return position, (vx + ax * s, vy + ay * s)
