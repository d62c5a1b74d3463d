import threading

from waiting import PATIENCE, wait_until

from pool_sim_ros.simulator.worker import Worker


def test_tasks_run_one_after_another_in_their_order_on_a_thread_of_that_name():
    done = []
    worker = Worker('sums')
    for number in range(100):
        worker.submit(lambda n=number: done.append((n, threading.current_thread().name)))
    wait_until(lambda: len(done) == 100, 'the tasks')
    assert done == [(number, 'sums') for number in range(100)]
    assert worker.stop(PATIENCE)


def test_submitting_does_not_wait():
    worker, go_on = Worker('slow'), threading.Event()
    ended = []
    worker.submit(lambda: (go_on.wait(PATIENCE), ended.append(1)))
    assert ended == []
    go_on.set()
    wait_until(lambda: ended, 'the task')
    assert worker.stop(PATIENCE)


def test_stop_starts_no_further_task_and_says_whether_the_running_one_ended():
    worker = Worker('stopped')
    running, go_on, ended = threading.Event(), threading.Event(), []

    def task():
        running.set()
        go_on.wait(PATIENCE)
        ended.append('first')

    worker.submit(task)
    worker.submit(lambda: ended.append('second'))
    assert running.wait(PATIENCE)
    assert worker.stop(0.0) is False
    go_on.set()
    assert worker.stop(PATIENCE) is True
    assert ended == ['first']


def test_a_running_task_does_not_keep_the_process_from_ending():
    before = set(threading.enumerate())
    worker = Worker('daemon')
    [thread] = [t for t in threading.enumerate() if t not in before and t.name == 'daemon']
    assert thread.daemon
    assert worker.stop(PATIENCE)
