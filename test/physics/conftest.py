"""Lets the physics tests import the plain twins and the oracle from the folder above."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
