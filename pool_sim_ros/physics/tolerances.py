"""Every tolerance and bound of the physics, each with its reason. SI units.

The kernels compile these numbers in; a change counts at once, see `kernel_sources`.
"""

# Places

OVERLAP = 1e-9
"""Overlap in m that a layout may have: a thousand times what rounding makes, and unseen."""

TOUCHING = 1e-9
"""Gap in m up to which things are in contact at the same instant: what a layout may overlap."""

PRESS_TOUCHING = 1e-6
"""The same in m for what something presses together: the least speed lifts a ball by so much."""

TOUCH_ROUNDING = 2.0**-51
"""Part of the square of the distance at contact that rounding may add to or take from it."""

CELL_MARGIN = 1e-6
"""What a cell is wider than the widest ball, as a part of it: far above rounding."""

PATH_SAG = 1e-5
"""Distance in m between a curved path and the line that is drawn for it: less than is ever seen."""

STRAIGHT = 1e-12
"""Cross product of velocity and acceleration, beside both, that is rounding: a straight path."""

# Contact times

GAP_ROUNDING = 1e-15
"""Gap in m that rounding leaves between a ball and the rail on which it lies: at some of them."""

PRESSED = 1e-12
"""Depth in m up to which a ball that is pressed to a cushion is so by rounding alone."""

SIFTED = 4
"""Moving balls from which on it is faster to look at all at once before each one."""

MAX_STEPS = 200
"""Steps towards one contact time. Convergence is quadratic; in a graze it is linear: some 50."""

ROOT_MARGIN = 1e-9
"""Relative margin within which rounding might decide whether a parabola has a root."""

# Phases of a ball with spin

SHORTEST_PHASE = 2.0**-52
"""Phases that are shorter than this part of the time, or of a second, are left out."""

SLIP_ROUNDING = 1e-14
"""Slip, as a part of the speeds that make it up, that is rounding: the ball rolls."""

LONGEST = 1e9
"""How far ahead in s a motion is looked at that nothing slows down."""

# Contacts that close slowly, or again and again

V_MIN = 1e-4
"""Contacts that close slower, in m/s, are weak: they take no part in another's instant, and may
belong to a collapse, in which balls bounce ever faster."""

V_ROUNDING = 1e-11
"""Speed in m/s at which a weak contact parts at the least, so that rounding cannot close it."""

CLOSING_ROUNDING = 1e-12
"""Speed in m/s up to which what touches does not close: rounding may be the whole of it."""

COLLAPSE_GROWTH = 4.0
"""What that speed is multiplied by at each repeat, up to V_MIN: this ends a collapse."""

MAX_REPEATS = 20
"""Repeats that are counted: after 12 that speed has reached V_MIN."""

PRESS_WINDOW = 0.1
"""Time in s within which what is pressed together meets again."""

STEADY_PRESSES = 200
"""Weak contacts, each within that time of the one before, after which something presses."""

PRESS_GROWTH = 2.0 ** (1.0 / 64.0)
"""What V_MIN is then multiplied by at each further one: twice as fast takes twice as long."""

MAX_PRESSES = STEADY_PRESSES + 64 * 4
"""How many are counted: at 16 V_MIN a ball is lifted by a micrometre."""

PRESS_MARGIN = 2.0
"""A pressed contact is weak that closes at most so many times as fast as it is to part."""

PRESSED_SPEED = PRESS_MARGIN * 16.0 * V_MIN
"""Speed in m/s up to which what is pressed may part, and still counts as pressed."""

SETTLE_EVERY = 8
"""One in so many pressed contacts parts at V_ROUNDING: two balls may lie still by now."""

REPEAT_WINDOW = 1e-3
"""Time in s within which a weak contact repeats an earlier one."""

LEAST_PARTING = 1e-3
"""The same as V_MIN for balls that spin, m/s: what the cloth presses on is ended by this."""

STEADY_HELD = 700
"""Weak contacts of a ball that spins, each within PRESS_WINDOW of the one before, after which it
is held there for long: 0.7 s, pressed by a cloth with friction 0.2. Two balls that are held at a
cushion have up to four events for each: a shot then ends within 5000."""

HELD_GROWTH = 2.0 ** (1.0 / 128.0)
"""What LEAST_PARTING is then multiplied by at each further one: time grows as fast."""

MOST_HELD = STEADY_HELD + 128 * 10
"""How many are counted: a ball then parts at 1 m/s, after minutes of spinning on the spot."""

ROUND = 1e-6
"""Time in s within which a contact belongs to the same rattle as the one before."""

MAX_ROUNDS = 200
"""Contacts of one ball in a rattle after which it parts from what it touches at V_MIN."""

LAST_ROUND = 250
"""The same, after which all that touches moves as one: it is wedged and cannot part."""

# Orientations

TURN_ERROR = 1e-10
"""Error in rad that one stretch of motion may add to how a ball is turned; a shot has hundreds."""

UNIT_QUATERNION = 1e-6
"""By how much the length of a unit quaternion may be off that is given."""

SMALL_TURN = 1e-4
"""Angle in rad below which a sine is its series: the next term is below rounding."""

MAX_TURN_STEPS = 1_000_000
"""Steps in which one stretch is integrated."""

# Impulses

NO_SLIP = 1e-10
"""Slip, as a part of the change of normal speed, that is the rounding of a head-on contact."""

MAX_ITERATIONS = 20_000
"""Iterations for the impulses of one instant; a rack of 15 needs some hundred."""

EASY_MASS_RATIO = 30.0
"""Ratio of the masses of an instant up to which these iterations are tried first."""

EASY_ITERATIONS = 2_000
"""Iterations after which they are given up where there is another way."""

PROXIMITY = 1e-6
"""What a proximal step adds to each diagonal element, as a part of it."""

MAX_PROXIMAL_STEPS = 200
"""Proximal steps; a few where contacts do not outnumber the freedoms."""

SOLVABLE = 1e-4
"""Change in the last of these steps, beside the impulses, up to which they are near an end; where
there is none they grow by as much each time: by one part in as many as there are steps."""

MAX_PIVOTS = 500
"""Contacts that may begin to push while a few are found that do: about as many as there are."""

IMPULSE_PRECISION = 1e-14
"""Change of the separation speeds, beside the speeds, at which the impulses are found."""

MAX_SPEED = 1e6
"""Speed of a ball at the start along each axis, m/s: far beyond any shot, and nothing overflows."""

MAX_SPIN = 1e9
"""Spin of a ball at the start about each axis, rad/s: as far beyond any shot."""

ROUNDING_OF_OFFSET = 1e-12
"""Part of the radius by which the tip of a cue may be farther out than it should: rounding."""

# Cushions with an edge

UNIT_LENGTH = 1e-12
"""What a unit normal may differ from length 1, and from a right angle to its cushion."""

ROOT_PRECISION = 4e-16
"""Change of an angle in rad at which the end of sticking is found: about its rounding."""

NO_CLOSING = 1e-30
"""Speed in m/s at which nothing meets a cushion: beside any spin no ratio overflows."""

CUSHION_STEPS = 200
"""Steps of the coarser of two integrations along the push of a cushion (Mathavan's model)."""

# What a table may have

MAX_FRICTION = 1e3
"""Coefficient of friction, far beyond any cloth: within it no calculation here overflows."""

MIN_DECELERATION = 1e-9
"""m/s^2 by which a cloth slows the balls where it slows them at all: so they stop some day."""

# Shots that do not end

RUNAWAY_GAIN = 100.0
"""A shot runs away when one ball has this many times the energy that all had at the start."""

RUNAWAY_SPEED = 1e-2
"""Speed in m/s as which slower ones count for that: weak contacts may add a little energy."""

MOST_EVENTS = 100_000
"""Events that a shot may have on any table."""

MOST_EVENTS_A_BALL = 1_000
"""Events that a shot may have for each ball, where that is more."""

# The report's integrator

MAX_SEPARATIONS = 2_000
"""Times that balls which overlap are moved apart; a rack of 15 needs some hundred."""

LOOK_MARGIN = 1e-6
"""Part by which the look at a pair comes earlier than the two could touch: far above rounding."""

FARTHEST_LOOK = 1_000_000_000
"""Slices after which a pair is looked at again at the latest."""

COUNTABLE_SLICES = 1e15
"""Slices that a float still counts one by one."""
