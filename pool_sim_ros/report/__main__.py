"""`python -m pool_sim_ros.report`: see `command`."""

import sys

from pool_sim_ros.report.command import main

if __name__ == '__main__':
    sys.exit(main())
