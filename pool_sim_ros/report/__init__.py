"""The command `report`: it writes the outputs of the student's report anew.

`command` is where it begins. `played` plays the four shots. `outputs` writes the pictures and the
films, `page` writes ``report.html``, and `positions` writes the CSV file; `comparison` computes
what the page says about the print. Nothing else in the package needs this folder, so it exports
nothing.
"""

from pool_sim_ros.interrupts import quiet_interrupts

quiet_interrupts()
