"""The table in a browser: a client of the node's topics that serves a page.

It imports `ros`, `oracle`, `simulator`, `me212`, `physics` and `console`, and no room imports it:
it is a process of its own, and starts with `python -m pool_sim_ros.web_view`.

command     how it starts and ends
bridge      ROS: topics and services of the simulator, in a thread of its own
poses       the latest ball poses, fetched 100 times a second
view        between bridge and pages: what they are shown, and what they may ask for
server      HTTP and websockets
pages       the pages that are open
commands    what a page may say
frames      ball poses, from the bytes of ROS to those of the page
prediction  where the balls would go
helping     the shots most likely to do what somebody wants
motion      a shot as fields for JSON
strikes     the latest strike, computed anew
exact       the exact result of a shot of the report
static/     the page itself
"""

from pool_sim_ros.interrupts import quiet_interrupts

quiet_interrupts()
