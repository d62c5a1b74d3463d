"""The report's integrator: its Listings 2 and 3, operation for operation.

In each slice all balls move, then each meets its cushions, then each pair is looked at, in the
order of the listing. Left out is only what cannot change a bit of the result: moving a ball
that rests, and looking at a pair that is too far apart to touch within the next slices.

`play` has the loop over the slices, `listing` what happens in one, `slices` its state.
"""

from pool_sim_ros.physics.time_slice.play import play, play_parts

__all__ = ['play', 'play_parts']
