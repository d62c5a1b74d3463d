"""The report's four shots and its log, by its own integrator: what *ME 212* printed.

    python examples/report_in_ten_lines.py

The log has two decimals, so 0.005 in is as near as it can be.
"""

from pool_sim_ros.me212 import SHOT_NUMBERS, cue_velocity, format_shot, published_final_positions
from pool_sim_ros.physics import INCH, report_table, simulate

table, printed = report_table(), published_final_positions()
for number in SHOT_NUMBERS:
    velocity = cue_velocity(number, table)
    shot = simulate(table, velocity, integrator='time_slice')
    ends = dict(zip(table.labels, shot.final_positions, strict=True))
    print(format_shot(number, velocity, ends.items()))
    off = max(abs(ends[b] / INCH - places).max() for b, places in printed[number].items())
    print(f'At most {off:.3f} in from what the report printed.\n')
