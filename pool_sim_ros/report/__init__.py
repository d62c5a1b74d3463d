"""The report's own shots and outputs."""
