import threading
import weakref

from waiting import PATIENCE, wait_until

from pool_sim_ros.simulator.worker import Worker


def nothing():
    pass


def test_tasks_run_on_a_thread_of_that_name_after_the_first_one():
    done = []
    worker = Worker('sums', lambda: done.append(('first', threading.current_thread().name)))
    for number in range(100):
        worker.submit(lambda n=number: done.append((n, threading.current_thread().name)))
        wait_until(lambda n=number: len(done) == n + 2, 'the task')
    assert done == [('first', 'sums'), *((number, 'sums') for number in range(100))]
    assert worker.stop(PATIENCE)


def test_submitting_does_not_wait():
    go_on, ended = threading.Event(), []
    worker = Worker('slow', nothing)
    worker.submit(lambda: (go_on.wait(PATIENCE), ended.append(1)))
    assert ended == []
    go_on.set()
    wait_until(lambda: ended, 'the task')
    assert worker.stop(PATIENCE)


def test_only_the_latest_task_is_kept_and_the_first_one_is_never_overtaken():
    go_on, done = threading.Event(), []
    worker = Worker('busy', lambda: (go_on.wait(PATIENCE), done.append('first')))

    class Shot:
        def __init__(self, number):
            self.number = number

        def play(self):
            done.append(self.number)

    overtaken = []
    for number in range(1000):
        shot = Shot(number)
        overtaken.append(weakref.ref(shot))
        worker.submit(shot.play)
    del shot
    assert sum(shot() is not None for shot in overtaken) == 1
    go_on.set()
    wait_until(lambda: len(done) == 2, 'the latest')
    assert worker.stop(PATIENCE)
    assert done == ['first', 999]


def test_stop_starts_no_further_task_and_says_whether_the_running_one_ended():
    worker = Worker('stopped', nothing)
    running, go_on, ended = threading.Event(), threading.Event(), []

    def task():
        running.set()
        go_on.wait(PATIENCE)
        ended.append('first')

    worker.submit(task)
    assert running.wait(PATIENCE)
    worker.submit(lambda: ended.append('second'))
    assert worker.stop(0.0) is False
    go_on.set()
    assert worker.stop(PATIENCE) is True
    assert ended == ['first']


def test_a_running_task_does_not_keep_the_process_from_ending():
    before = set(threading.enumerate())
    worker = Worker('daemon', nothing)
    [thread] = [t for t in threading.enumerate() if t not in before and t.name == 'daemon']
    assert thread.daemon
    assert worker.stop(PATIENCE)
