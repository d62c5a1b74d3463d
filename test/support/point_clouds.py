"""Point clouds as users of ROS make them."""

from sensor_msgs.msg import PointCloud2, PointField

from pool_sim_ros.ros.point_cloud import DATATYPES


def message_of(rows, stamp=(1, 2), frame_id='table', **changes):
    """Return a cloud as a user of ROS makes it."""
    message = PointCloud2(height=1, width=len(rows), is_dense=True)
    message.header.stamp.sec, message.header.stamp.nanosec = stamp
    message.header.frame_id = frame_id
    numbers = {kind: number for number, kind in DATATYPES.items()}
    message.fields = [
        PointField(name=name, offset=offset, datatype=numbers[kind.str[1:]], count=1)
        for name, (kind, offset) in rows.dtype.fields.items()
    ]
    message.point_step = rows.dtype.itemsize
    message.row_step = message.point_step * len(rows)
    message.data.frombytes(rows.tobytes())
    for name, value in changes.items():
        setattr(message, name, value)
    return message
