"""Writing recorded messages to an MCAP file."""

from __future__ import annotations

import errno
import os
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Final

from rclpy.qos import DurabilityPolicy
from rosbags.interfaces import (
    Qos,
    QosDurability,
    QosHistory,
    QosLiveliness,
    QosReliability,
    QosTime,
)
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from pool_sim_ros.ros import interface
from pool_sim_ros.ros.sim_stamps import Recorded

_BAG_VERSION: Final = 9  # of ROS 2 Jazzy
_FOREVER = QosTime(2147483647, 4294967295)


def write_bag(file: Path, messages: Iterable[Recorded], *, replace: bool = True) -> None:
    """Write messages to a single MCAP file: all of them, or none.

    The file holds the definitions of the message types and the QoS of the topics, so that a player
    latches what was latched.

    Parameters
    ----------
    file : Path
    messages : iterable of Recorded
    replace : bool, optional
        Whether an existing file is replaced.

    Raises
    ------
    FileExistsError
        If there is one, and it is not to be replaced.
    """
    with tempfile.TemporaryDirectory(prefix='.record_', dir=file.parent) as folder:
        bag = Path(folder, 'bag')
        with Writer(bag, version=_BAG_VERSION, storage_plugin=StoragePlugin.MCAP) as writer:
            _write(writer, messages)
        (written,) = bag.glob('*.mcap')
        if not replace and file.exists():
            raise FileExistsError(errno.EEXIST, os.strerror(errno.EEXIST), str(file))
        os.replace(written, file)


def _write(writer: Writer, messages: Iterable[Recorded]) -> None:
    types = get_typestore(Stores.ROS2_JAZZY)
    connections = {}
    for message in messages:
        if message.name not in connections:
            connections[message.name] = writer.add_connection(
                message.name,
                _type_name(message.topic.type),
                typestore=types,
                offered_qos_profiles=[_qos(message.topic)],
            )
        writer.write(connections[message.name], message.time, message.data)


def _type_name(type_: type) -> str:
    package, kind, _ = type_.__module__.split('.')
    return f'{package}/{kind}/{type_.__name__}'


def _qos(topic: interface.Topic) -> Qos:
    latched = topic.qos.durability is DurabilityPolicy.TRANSIENT_LOCAL
    return Qos(
        QosHistory.KEEP_LAST,
        topic.qos.depth,
        QosReliability.RELIABLE,
        QosDurability.TRANSIENT_LOCAL if latched else QosDurability.VOLATILE,
        _FOREVER,
        _FOREVER,
        QosLiveliness.AUTOMATIC,
        _FOREVER,
        False,
    )
