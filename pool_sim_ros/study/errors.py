"""The error of a sweep that cannot go on."""


class SweepError(RuntimeError):
    """A sweep ended before its last shot; the message is one line, and what is written stays."""
