"""The parameter files that the package ships."""

from pathlib import Path

import yaml

CONFIG = Path(__file__).resolve().parents[2] / 'config'


def from_file(path):
    """Read a parameter file the plain way: nested names joined by dots."""
    values = {}
    for name, value in yaml.safe_load(path.read_text())['/**']['ros__parameters'].items():
        if isinstance(value, dict):
            values.update({f'{name}.{key}': inner for key, inner in value.items()})
        else:
            values[name] = value
    return values
