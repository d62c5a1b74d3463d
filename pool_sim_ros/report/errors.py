"""What can go wrong while the report is made, and is not the program's fault."""


class ReportError(Exception):
    """The report cannot be made; the message says why, in one line."""
