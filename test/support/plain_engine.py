"""The engine as plain Python, which it is where numba compiles nothing.

Run as a program, with NUMBA_DISABLE_JIT=1, it plays the shots of a file and writes what came of
them to another: python plain_engine.py SHOTS.pickle PLAYED.pickle
"""

import os
import pickle
import subprocess
import sys
import warnings


def play_in_plain_python(shots, folder):
    """Return what comes of shots, each the arguments of `play_on`; files go to a folder."""
    from seam_shots import PlayedShot

    given, found = folder / 'shots.pickle', folder / 'played.pickle'
    given.write_bytes(pickle.dumps(shots))
    subprocess.run(
        [sys.executable, __file__, str(given), str(found)],
        env={**os.environ, 'NUMBA_DISABLE_JIT': '1', 'PYTHONPATH': os.pathsep.join(sys.path)},
        check=True,
        timeout=300,
    )
    return [PlayedShot(*shot) for shot in pickle.loads(found.read_bytes())]


def main(given, found):
    """Play shots."""
    import numpy as np
    from seam_shots import play_on

    # As compiled code does, which says nothing of a division by zero.
    warnings.simplefilter('ignore', RuntimeWarning)
    with open(given, 'rb') as file:
        # The types of the tables come from modules that register what they choose.
        shots = pickle.load(file)
    played = [tuple(map(np.asarray, play_on(*shot))) for shot in shots]
    with open(found, 'wb') as file:
        pickle.dump(played, file)


if __name__ == '__main__':
    main(*sys.argv[1:])
