"""When which markers are sent."""

from ros_harness import Observer

from pool_sim_ros.physics import report_table
from pool_sim_ros.ros import interface

TABLE = report_table()


def place(marker):
    position = marker.pose.position
    return position.x, position.y


def test_over_the_topic_the_table_comes_once_and_what_moves_as_it_moves(ros):
    ros.sim_node(real_time_factor=0.0)
    observer = Observer(ros).wait_for_match()
    heard = []
    topic = interface.MARKERS
    observer.node.create_subscription(
        topic.type, topic.of(interface.NODE_NAME), heard.append, topic.qos
    )

    def tables():
        return sum(marker.ns == 'table' for array in heard for marker in array.markers)

    def balls_shown():
        return {m.id: place(m) for array in heard for m in array.markers if m.ns == 'balls'}

    ros.spin_until(lambda: tables() and len(balls_shown()) == len(TABLE.balls), 'the table')
    quiet = len(heard)
    last = len(observer.stamps)
    ros.spin_until(lambda: len(observer.stamps) > last + 10, 'frames at rest')
    assert len(heard) <= quiet + 2  # those of the viewers that came meanwhile
    done = observer.wait_for_phase(observer.ask(velocity=[-3.0, 0.4]), 'done')
    ends = [tuple(place) for place in done['final_positions'].values()]
    ros.spin_until(lambda: list(dict(sorted(balls_shown().items())).values()) == ends, 'the end')
    assert tables() == 1
    late = []
    observer.node.create_subscription(
        topic.type, topic.of(interface.NODE_NAME), late.append, topic.qos
    )
    ros.spin_until(
        lambda: (
            {'table', 'cushions', 'balls', 'labels'}
            <= {m.ns for array in late for m in array.markers}
        ),
        'what a late viewer is shown',
    )
