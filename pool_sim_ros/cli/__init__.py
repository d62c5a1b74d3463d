"""The commands that need no room of their own, each a module: the node, its clients, demo and play.

They import `ros`, `simulator`, `me212` and `console`, and nothing imports them. `web_view` and
`report` have their command in their own room, as `command`; what is here starts those as processes.
"""
