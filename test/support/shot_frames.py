"""The frames of one shot, without threads and without waiting."""

from pool_sim_ros.physics import simulate
from pool_sim_ros.simulator.layout import start_layout
from pool_sim_ros.simulator.playback import Playback


def shot_frames(table, velocity, rate=60):
    """Return the frames from the strike until all balls rest, at `rate` a second."""
    playback = Playback(start_layout(table), rate)
    playback.strike()
    playback.computed(simulate(table, velocity))
    frames = [playback.next_frame()]
    while not frames[-1].finished:
        frames.append(playback.next_frame())
    return frames
