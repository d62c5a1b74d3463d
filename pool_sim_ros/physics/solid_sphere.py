"""What the moment of inertia of a solid sphere, I = 2/5 m R^2, makes of pushes and slips."""

INERTIA = 2.0 / 5.0
"""I / (m R^2)."""

SPIN_PER_PUSH = 5.0 / 2.0
"""m R^2 / I: a push of 1 m/s across its surface changes R w by so much, m/s."""

NO_SLIP_SHARE = 2.0 / 7.0
"""1 / (1 + m R^2 / I): the part of a slip that, as a push, stops the slip."""
