"""The physics is plain Python: it pulls in neither ROS nor anything that draws."""

import subprocess
import sys


def test_physics_imports_no_ros_and_nothing_that_draws():
    listing = subprocess.run(
        [sys.executable, '-c', 'import pool_sim_ros.physics, sys; print(*sys.modules)'],
        capture_output=True,
        text=True,
        check=True,
        timeout=120,
    )
    loaded = {name.partition('.')[0] for name in listing.stdout.split()}
    assert 'numba' in loaded
    unwanted = {'rclpy', 'rpyutils', 'ament_index_python', 'matplotlib', 'scipy', 'tqdm'}
    assert not loaded & (unwanted | {'std_msgs', 'geometry_msgs', 'rosidl_parser'})
