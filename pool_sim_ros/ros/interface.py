"""Every topic and service of the node, declared once; node, clients and tests read it here."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseArray, Twist
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Float64MultiArray, String
from std_srvs.srv import SetBool, Trigger
from visualization_msgs.msg import MarkerArray

from pool_sim_ros.ros.names import NODE_NAME as NODE_NAME

BURST = 1000
"""Depth of the queues that must not lose a burst of commands or answers."""

KEPT_FRAMES = 1000
"""Frames that the node keeps for readers that fall behind: 0.55 s at 30 times real time. For a
process that does not run, Fast DDS queues 512 messages in shared memory: 256 frames, poses and
velocities, 0.14 s at that speed. It drops what follows, and sends again only what is still kept."""


@dataclass(frozen=True)
class Endpoint:
    """A topic or a service.

    Attributes
    ----------
    name : str
        Below the node's own name; absolute with a leading slash.
    type : type
        Message or service type.
    doc : str
        What it carries, or does.
    """

    name: str
    type: Any
    doc: str

    @property
    def private(self) -> str:
        """The name that the node itself uses."""
        return self.name if self.name.startswith('/') else f'~/{self.name}'

    def of(self, node: str) -> str:
        """Return the name that others use for a node of this name."""
        return self.name if self.name.startswith('/') else f'{node}/{self.name}'


@dataclass(frozen=True)
class Topic(Endpoint):
    """A topic.

    Attributes
    ----------
    qos : QoSProfile
        For its readers, and for its publisher but for the depth.
    kept : int or None
        Depth of its publisher's queue, in messages; None: that of `qos`.
    """

    qos: QoSProfile
    kept: int | None = None

    @property
    def publisher_qos(self) -> QoSProfile:
        """The QoS of its publisher."""
        if self.kept is None:
            return self.qos
        return QoSProfile(
            depth=self.kept,
            reliability=self.qos.reliability,
            durability=self.qos.durability,
        )


@dataclass(frozen=True)
class Service(Endpoint):
    """A service."""


def _qos(depth: int, latched: bool = False) -> QoSProfile:
    return QoSProfile(
        depth=depth,
        reliability=ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )


CUE_VELOCITY = Topic(
    'cue_velocity',
    Twist,
    'strike the cue ball: linear.x and linear.y, m/s, and where balls spin angular, rad/s; it has '
    'no id, so that a client cannot know whether one was lost, nor send it again: use shot/request '
    'where that matters',
    _qos(BURST),
)
SHOT_REQUEST = Topic(
    'shot/request',
    String,
    '1 to 4, or JSON {"id": "...", "shot": 3} or {"id": "...", "velocity": [-4.0, 0.0]}; where '
    'balls spin also "spin": [0.0, 50.0, 0.0] beside velocity, rad/s, or instead of velocity '
    '"cue": {"speed": 2.0, "azimuth": 180.0, "elevation": 0.0, "side": 0.2, "above": -0.3}, m/s, '
    'degrees and radii; {"id": "...", "place": {"9": [0.5, 0.4]}} puts single balls elsewhere '
    'while all rest, m; one with an id may be sent again and again until it is answered: it is '
    'played once',
    _qos(BURST),
)
SHOT_RESPONSE = Topic(
    'shot/response', String, 'JSON: see shot_request.Response', _qos(BURST, latched=True)
)
SET_BALL_POSES = Topic(
    'set_ball_poses',
    PoseArray,
    'put all balls elsewhere while they rest: position.x and y of each, m, cue ball first; z and '
    'orientation are ignored; header.frame_id is empty or the parameter frame_id',
    _qos(10),
)
BALL_POSES = Topic(
    'ball_poses',
    PoseArray,
    'each tick: every ball, cue ball first, and how it is turned where balls spin; a ball in a '
    "pocket is at the pocket's centre, one radius below the cloth",
    _qos(10),
    KEPT_FRAMES,
)
BALL_VELOCITIES = Topic(
    'ball_velocities',
    Float64MultiArray,
    'with each frame: (n, 2), m/s; where balls spin (n, 5), with their spins, rad/s',
    _qos(10),
    KEPT_FRAMES,
)
COLLISIONS = Topic(
    'collisions',
    Float64MultiArray,
    'before the frame that contains them: rows of simulator.COLLISION_COLUMNS. seq counts from '
    '0 and is never reset; t is sim time, s; kind 0 is ball a on ball b, kind 1 is ball a on '
    'cushion b (0: x = 0, 1: x = length, 2: y = 0, 3: y = width; where there are pockets the row '
    'of table.cushion_segments, then of table.cushion_noses), kind 3 is ball a caught in pocket b; '
    'x, y the point of contact, or the centre of the ball that is caught, m; nx, ny the unit '
    "vector from a to b, into the cushion or to the pocket's centre; speed of closing, or of the "
    'ball that is caught, m/s',
    _qos(BURST),
)
STATE = Topic(
    'state',
    String,
    'JSON: paused, moving, computing, tick, sim_time, real_time_factor, pocketed (labels, in the '
    'order in which they fell); on change and at 1 Hz',
    _qos(1, latched=True),
)
TABLE = Topic('table', String, 'JSON: the fields of physics.Table', _qos(1, latched=True))
MARKERS = Topic(
    'markers',
    MarkerArray,
    'the table, the balls, their labels and trails; a message that begins with DELETEALL holds all',
    _qos(10, latched=True),
)
CLOCK = Topic('/clock', Clock, 'sim time, only with the parameter publish_clock', _qos(1))
DIAGNOSTICS = Topic(
    '/diagnostics', DiagnosticArray, '1 Hz: speed, lateness, rejections, energy check', _qos(10)
)

RESET = Service('reset', Trigger, 'put the balls back on the start layout')
SET_PAUSED = Service('set_paused', SetBool, 'pause or resume')
STEP = Service('step', Trigger, 'while paused: advance step_ticks ticks')
