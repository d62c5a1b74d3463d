"""The exact integrator: every contact at its own time, however small.

`engine` is the loop. `prediction` finds what each ball does next with `contact_time`, `cell_grid`
and `few_balls`, and `event_queue` tells which ball is next; `resolve` does what is due with
`contact_group`, `simultaneous` and `inelastic_collapse`. `batch` plays one shot, or many, in one
call into compiled code, `work_area` keeps what it needs, `parts` is what each thread does.
"""

from pool_sim_ros.physics.event_driven.parts import play_parts
from pool_sim_ros.physics.event_driven.state import copied
from pool_sim_ros.physics.event_driven.work_area import work_area

__all__ = ['copied', 'play_parts', 'work_area']
