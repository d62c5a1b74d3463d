"""The error that every command tells its user in one line."""


class CommandError(Exception):
    """A command cannot do its work; the message is one line for the user."""
