"""A node that is spun in the background."""

import threading

from std_msgs.msg import String
from waiting import PATIENCE, wait_until

from pool_sim_ros.ros import spin_thread
from pool_sim_ros.ros.spin_thread import SpinThread


def listen(ros, topic):
    """Return a node that keeps what it hears and by which thread, and a publisher to it."""
    node, heard = ros.node('listener'), []
    node.create_subscription(
        String, topic, lambda m: heard.append((m.data, threading.current_thread())), 10
    )
    return node, heard, node.create_publisher(String, topic, 10)


def test_callbacks_run_in_a_thread_of_their_own_until_it_is_closed(ros):
    node, heard, publisher = listen(ros, 'words')
    thread = SpinThread(node)
    try:
        publisher.publish(String(data='first'))
        wait_until(lambda: heard, 'the first word')
    finally:
        thread.close()
    ((word, by),) = heard
    assert word == 'first' and by is not threading.current_thread() and not by.is_alive()
    publisher.publish(String(data='second'))
    ros.executor.add_node(node)  # the message came, and waited for somebody else to take it
    ros.spin_until(lambda: len(heard) == 2, 'the second word')
    assert heard[1] == ('second', threading.current_thread())


def test_closing_does_not_wait_for_a_message(ros, monkeypatch):
    monkeypatch.setattr(spin_thread, 'LONGEST_WAIT', 10 * PATIENCE)
    thread = SpinThread(ros.node('idle'))
    spinner = thread._thread
    closing = threading.Thread(target=thread.close)
    closing.start()
    closing.join(PATIENCE)
    assert not closing.is_alive() and not spinner.is_alive()


def test_it_ends_by_itself_where_ros_goes_down(ros):
    thread = SpinThread(ros.node('doomed'))
    spinner = thread._thread
    ros.context.try_shutdown()
    spinner.join(PATIENCE)
    assert not spinner.is_alive()
    thread.close()
