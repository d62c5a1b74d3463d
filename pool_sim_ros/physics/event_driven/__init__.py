"""The exact integrator: every contact at its own time, however small.

`engine` is the loop. `prediction` finds what each ball does next with `contact_time`, `cell_grid`
and `few_balls`, and `event_queue` tells which ball is next; `resolve` does what is due with
`contact_group`, `simultaneous` and `inelastic_collapse`. `batch` plays one shot, or many.
"""

from pool_sim_ros.physics.event_driven.batch import play_parts, work_area
from pool_sim_ros.physics.event_driven.state import copied

__all__ = ['copied', 'play_parts', 'work_area']
