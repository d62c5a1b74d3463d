"""Units of the report in SI."""

INCH = 0.0254
"""One inch in metres."""
