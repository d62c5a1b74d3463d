"""Nodes of one full name: they share their topics, and what one is sent reaches both."""

# Some methods of rclpy's Node have no types.
# mypy: allow-untyped-calls

from __future__ import annotations

from rclpy.node import Node


def count_nodes(node: Node, name: str) -> int:
    """Return how many nodes have a full name, as far as `node` knows."""
    nodes = node.get_node_names_and_namespaces()
    return sum(f'{namespace.rstrip("/")}/{each}' == name for each, namespace in nodes)


class Namesakes:
    """Warns in the log of a node, once, of others with its name; again once they had gone.

    Parameters
    ----------
    node : Node
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._warned = False

    def check(self) -> None:
        """Look for others now."""
        name = self._node.get_fully_qualified_name()
        count = count_nodes(self._node, name)
        if count > 1 and not self._warned:
            self._node.get_logger().warn(
                f'{count} nodes are named {name}: each takes every command, and their frames and '
                'answers mix; give each a name of its own, as in -r __node:=left'
            )
        self._warned = count > 1
