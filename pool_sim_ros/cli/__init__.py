"""The commands that have no room of their own: each module is one.

They import `ros`, `simulator`, `me212` and `console`, and no room imports them. `web_view` and
`report` hold their own command; `play` starts the page as a process.
"""

from pool_sim_ros.interrupts import quiet_interrupts

quiet_interrupts()
