"""The table in a browser: a client of the node's topics that serves a page.

bridge      ROS: topics and services of the simulator, in a thread of its own
poses       the latest ball poses, fetched 100 times a second
view        between the two: what the pages are shown, and what they may ask for
server      HTTP and websockets
pages       the pages that are open
commands    what a page may say
frames      ball poses, from the wire to the page, without objects in between
prediction  where the balls would go
static/     the page itself
"""
