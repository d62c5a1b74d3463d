"""One number for all that a session sends on a topic."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator

import numpy as np

from pool_sim_ros.ros.cdr import PosesWriter, RowsWriter
from pool_sim_ros.simulator import COLLISION_COLUMNS, Frame, Settings, velocity_columns


def digests(settings: Settings, frames: Iterator[Frame]) -> dict[str, str]:
    """Return the SHA-256 of all messages that show these frames, for each topic."""
    poses = PosesWriter(settings.frame_id, settings.table.radii.tolist())
    velocities = RowsWriter('ball', velocity_columns(settings.table.motion))
    collisions = RowsWriter('collision', COLLISION_COLUMNS)
    sums = {name: hashlib.sha256() for name in ('ball_poses', 'ball_velocities', 'collisions')}
    for frame in frames:
        turned = None if frame.orientations is None else frame.orientations[np.newaxis]
        shown = poses.write([frame.stamp], frame.positions[np.newaxis], turned, [frame.pocketed])
        sums['ball_poses'].update(*shown)
        sums['ball_velocities'].update(*velocities.write(frame.velocities[np.newaxis]))
        if len(frame.collisions):
            sums['collisions'].update(*collisions.write(frame.collisions[np.newaxis]))
    return {name: digest.hexdigest() for name, digest in sums.items()}
