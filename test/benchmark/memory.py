"""Tell how much memory playing takes beyond its results, in bytes.

    python memory.py balls 4000      one shot with so many balls
    python memory.py shots 1000000   so many shots on the report's table

Run in a process of its own, since a process never gives back the most that it once had.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from benchmark.workloads import dense_table, dense_velocities, random_velocities  # noqa: E402

from pool_sim_ros.physics import report_table, simulate_many  # noqa: E402

STATUS = Path('/proc/self/status')
PEAK_RESET = Path('/proc/self/clear_refs')


def main() -> None:
    what, count = sys.argv[1], int(sys.argv[2])
    options = {}
    if what == 'shots':
        table, velocities = report_table(), random_velocities(count)
    else:
        table, velocities = dense_table(count, decelerating=True), dense_velocities(count, 1)
        options['until'] = 0.05
    simulate_many(report_table(), random_velocities(1), **options)  # loads the kernels
    PEAK_RESET.write_text('5')
    before = memory('VmRSS')
    results = simulate_many(table, velocities, **options)
    own = results.finals, results.durations, results.event_counts, results.first_hit, results.failed
    print(memory('VmHWM') - before - sum(array.nbytes for array in own))


def memory(name: str) -> int:
    """Return one of the sizes of this process that the kernel keeps, in bytes."""
    for line in STATUS.read_text().splitlines():
        if line.startswith(name):
            return 1024 * int(line.split()[1])
    raise LookupError(f'{STATUS} has no {name}')


if __name__ == '__main__':
    main()
