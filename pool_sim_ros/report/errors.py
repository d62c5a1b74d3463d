"""The error that the command reports in one line: nothing is wrong with the program itself."""


class ReportError(Exception):
    """The report cannot be made; the message says why, in one line."""
