"""The phases that every motion has."""

RESTS, MOVES = 0, 1
"""At rest until something touches it; in the one phase of motion that a disc has."""
