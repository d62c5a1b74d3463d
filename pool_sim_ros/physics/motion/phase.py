"""The phases of the motions. Each has RESTS; what it is not, moves."""

RESTS = 0
"""At rest until something touches it; a ball that spins in place too, whom that concerns nobody."""

MOVES = 1
"""The one phase in which a disc moves."""

SLIDES, ROLLS = 1, 2
"""The phases in which a ball with spin moves."""
