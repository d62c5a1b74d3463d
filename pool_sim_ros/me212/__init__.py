"""The student report, *ME 212 Billiards Project Report*: its four shots, and what it printed.

The shots say how the cue ball is struck in each. The log is Listing 1, which others write anew,
character for character, and compare with the final positions that the report printed; `deviations`
says why a run cannot end there. The report's table is in `physics`, as is its integrator.
"""

from typing import TYPE_CHECKING

from pool_sim_ros.lazy import lazy_exports

if TYPE_CHECKING:
    from pool_sim_ros.me212.log import (
        format_aim,
        format_log,
        format_position,
        format_shot,
        format_shot_head,
        inches,
        published_final_positions,
    )
    from pool_sim_ros.me212.printed import deviations, is_report_table
    from pool_sim_ros.me212.shots import (
        SHOT_NUMBERS,
        attitude_to_nearest,
        cue_velocity,
        nearest_ball,
    )
else:
    __getattr__ = lazy_exports(
        __name__,
        {
            'SHOT_NUMBERS': 'shots',
            'attitude_to_nearest': 'shots',
            'cue_velocity': 'shots',
            'deviations': 'printed',
            'format_aim': 'log',
            'format_log': 'log',
            'format_position': 'log',
            'format_shot': 'log',
            'format_shot_head': 'log',
            'inches': 'log',
            'is_report_table': 'printed',
            'nearest_ball': 'shots',
            'published_final_positions': 'log',
        },
    )

__all__ = [
    'SHOT_NUMBERS',
    'attitude_to_nearest',
    'cue_velocity',
    'deviations',
    'format_aim',
    'format_log',
    'format_position',
    'format_shot',
    'format_shot_head',
    'inches',
    'is_report_table',
    'nearest_ball',
    'published_final_positions',
]
