"""`python -m pool_sim_ros.web_view`."""

import sys

from pool_sim_ros.web_view.command import main

sys.exit(main())
