"""A node under fire: after seconds in every run, after ten minutes with `-m soak`.

    python -m pytest -m soak test/ros/test_fuzzed_for_long.py --fuzz-seconds 600 --fuzz-seed 1

Everything in `support/fuzzing.py` is done to one node, at random and as fast as it answers. It must
not end, must answer each call of a service and honest requests, must not grow, and plays as printed
afterwards.
"""

import time

import pytest
from fuzzing import SERVICES, Fuzzer, garbage_sender
from process_harness import node_process
from rclpy.parameter import Parameter
from survival import FAST, Listener, is_served, plays_as_printed, resident

from pool_sim_ros.physics import report_table
from pool_sim_ros.ros import interface
from pool_sim_ros.simulator import Change, parameters_of

SHORT = 5.0  # s
CHECK_PERIOD = 2.0  # s
MOST_GROWTH = 500 * 2**20
"""Bytes that a node may grow by: a shot of 100,000 events and some commands of 8 MB have room."""


def put_back(observer):
    """Give every parameter that may change its value at the start."""
    values = {
        name: s.default for name, s in parameters_of('disc').items() if s.change is not Change.NEVER
    }
    values |= FAST
    parameters = [Parameter(name, value=value).to_parameter_msg() for name, value in values.items()]
    service = interface.Service('set_parameters', SERVICES['set_parameters'], '')
    results = observer.call(service, parameters=parameters).results
    assert all(result.successful for result in results), results


def fuzz(ros, seconds, seed, garbage):
    """Fuzz a node for so long; return a line that says what was done and how it took it."""
    slowest, most, rounds, senders = 0.0, 0, 0, 0
    sender = None
    with node_process(**FAST) as process:
        observer = Listener(ros).wait_for_match()
        fuzzer = Fuzzer(ros, seed, report_table().positions).wait_for_match()
        start, begin = time.monotonic(), resident(process)
        while (elapsed := time.monotonic() - start) < seconds:
            if garbage and (sender is None or sender.poll() is not None):
                assert sender is None or sender.returncode == 0
                senders += 1
                sender = garbage_sender(seed + senders)
            while time.monotonic() - start < min(elapsed + CHECK_PERIOD, seconds):
                fuzzer.act()
                ros.executor.spin_once(0.0)
            asked = time.monotonic()
            is_served(observer)
            slowest, rounds = max(slowest, time.monotonic() - asked), rounds + 1
            fuzzer.all_answer()
            for response in observer.responses:
                fuzzer.heard(response)
            observer.forget()
            most = max(most, resident(process) - begin)
            assert most < MOST_GROWTH, f'grew by {most / 2**20:.0f} MiB'
        if sender is not None:
            ros.spin_until(lambda: sender.poll() is not None, 'the end of the garbage')
        fuzzer.finish(observer)
        fuzzer.close()
        put_back(observer)
        plays_as_printed(Listener(ros).wait_for_match())
        lines = process.stderr.count('\n')
        assert garbage or not fuzzer.lost, f'{fuzzer.lost} calls were not answered'
    return (
        f'{seconds:g} s, seed {seed}: {sum(fuzzer.done.values())} actions {dict(fuzzer.done)}, '
        f'{fuzzer.lost} calls lost, {senders} senders of garbage; {rounds} checks, the slowest '
        f'answer to a request after {slowest:.2f} s; '
        f'at most {most / 2**20:.0f} MiB more than at the start; {lines} lines of log; it plays on'
    )


@pytest.mark.parametrize('seed', [1])
def test_a_node_outlasts_seconds_of_everything(ros, seed):
    fuzz(ros, SHORT, seed, garbage=False)


@pytest.mark.soak
def test_soak_a_node_outlasts_minutes_of_everything(ros, request, capsys):
    seconds = request.config.getoption('--fuzz-seconds')
    report = fuzz(ros, seconds, request.config.getoption('--fuzz-seed'), garbage=True)
    with capsys.disabled():
        print(f'\n{report}')
