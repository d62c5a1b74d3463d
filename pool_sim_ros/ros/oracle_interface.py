"""Every topic of the oracle, declared once; node, clients and tests read it here."""

from __future__ import annotations

from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import PointCloud2
from std_msgs.msg import String
from visualization_msgs.msg import MarkerArray

from pool_sim_ros.ros.interface import BURST, Topic
from pool_sim_ros.ros.names import ORACLE_NAME as ORACLE_NAME

KEPT_ANSWERS = 200
"""Of a reader that falls behind; one of 10,000 candidates has 2.6 MB where there are 11 balls."""


def _qos(depth: int | None = None, latched: bool = False) -> QoSProfile:
    return QoSProfile(
        depth=depth or 0,
        history=HistoryPolicy.KEEP_LAST if depth else HistoryPolicy.KEEP_ALL,
        reliability=ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )


WHAT_IF_REQUEST = Topic(
    'what_if/request',
    PointCloud2,
    'one point a candidate, at most 50,000: FLOAT64 fields vx, vy, m/s, and where balls spin wx, '
    "wy, wz, rad/s; height 1, little-endian, frame_id 'table'; header.stamp is a random number of "
    'the client, and comes back',
    _qos(),
)
WHAT_IF_RESPONSE = Topic(
    'what_if/response',
    PointCloud2,
    'the same stamp, one point a candidate: x, y, z FLOAT32, where the cue ball ends, m, its '
    'radius above the cloth, or below where a pocket caught it; duration, s, x_LABEL and y_LABEL, '
    'm, FLOAT64; events, first_hit and pocketed_LABEL INT32; without points where it was rejected',
    _qos(),
    KEPT_ANSWERS,
)
WHAT_IF_REJECTED = Topic(
    'what_if/rejected',
    String,
    'JSON: {"stamp": [sec, nanosec], "code": "...", "reason": "..."}',
    _qos(BURST),
)
PLAN_REQUEST = Topic(
    'plan/request',
    String,
    'JSON {"id": "...", "goal": {...}, "noise": "fastfiz"}, and what else find_shots takes: shots, '
    'seconds, seed, count, speeds, offset; {"id": "...", "cancel": true} ends it; one with an id '
    'may be sent again and again: it is carried out once',
    _qos(BURST),
)
PLAN_RESPONSE = Topic(
    'plan/response',
    String,
    'JSON: accepted or rejected, progress, then done or cancelled; done has the ranked shots',
    _qos(BURST),
)
PLAN_MARKERS = Topic(
    'markers',
    MarkerArray,
    'the best shots of the latest plan: paths, where the balls end, and chances; none once the '
    'balls move',
    _qos(1, latched=True),
)
TOPICS = (
    WHAT_IF_REQUEST,
    WHAT_IF_RESPONSE,
    WHAT_IF_REJECTED,
    PLAN_REQUEST,
    PLAN_RESPONSE,
    PLAN_MARKERS,
)
