"""The topics of the oracle are those of the design, with queues that lose no burst."""

from rclpy.qos import DurabilityPolicy, HistoryPolicy, ReliabilityPolicy

from pool_sim_ros.ros import oracle_interface
from pool_sim_ros.ros.what_if_rows import MOST_CANDIDATES

EXPECTED = {
    'what_if/request': ('PointCloud2', None, None),
    'what_if/response': ('PointCloud2', None, 200),
    'what_if/rejected': ('String', 1000, 1000),
    'plan/request': ('String', 1000, 1000),
    'plan/response': ('String', 1000, 1000),
    'markers': ('MarkerArray', 1, 1),
}
"""Name -> type, and depths for readers and for the publisher, None where all is kept."""


def test_names_types_and_queues():
    assert {topic.name for topic in oracle_interface.TOPICS} == set(EXPECTED)
    for topic in oracle_interface.TOPICS:
        kind, depth, kept = EXPECTED[topic.name]
        assert topic.type.__name__ == kind and topic.doc
        latched = topic.qos.durability is DurabilityPolicy.TRANSIENT_LOCAL
        assert latched == (topic.name == 'markers')
        for qos, size in ((topic.qos, depth), (topic.publisher_qos, kept)):
            assert qos.reliability is ReliabilityPolicy.RELIABLE
            everything = HistoryPolicy.KEEP_ALL if size is None else HistoryPolicy.KEEP_LAST
            assert qos.history is everything
            assert size is None or qos.depth == size
        assert topic.of('/left') == f'/left/{topic.name}' and topic.private == f'~/{topic.name}'


def test_the_limit_that_is_told_is_the_limit():
    assert f'at most {MOST_CANDIDATES:,}' in oracle_interface.WHAT_IF_REQUEST.doc
