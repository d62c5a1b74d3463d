"""Tables on which balls spin."""

from tables import table_of

SPINNING = dict(
    motion='ball',
    mu_slide=0.2,
    mu_roll=0.01,
    mu_spin=0.0127,
    nose_height=0.0625,
    ball_friction='coulomb',
)
"""What makes a table of balls with a radius of 0.05 m one on which they spin."""


def spin_table(positions, **fields):
    """Return a table with equal balls that slide, roll and spin."""
    return table_of(positions, **{**SPINNING, **fields})
