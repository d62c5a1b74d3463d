"""`python -m pool_sim_ros.study`: see `command`."""

import sys

from pool_sim_ros.study.command import main

if __name__ == '__main__':
    sys.exit(main())
