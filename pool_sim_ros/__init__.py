"""A pool table for ROS 2: an exact billiards engine, and the node that plays it."""

__version__ = '0.1.0'
