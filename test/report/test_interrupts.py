import os
import signal

import pytest

from pool_sim_ros.report.interrupts import SIGNALS, Interrupts


@pytest.mark.parametrize('number', SIGNALS)
def test_an_interrupt_waits_for_the_next_check(number):
    before = signal.getsignal(number)
    done = []
    with pytest.raises(KeyboardInterrupt), Interrupts() as interrupts:
        interrupts.check()
        os.kill(os.getpid(), number)
        done.append('the step that was under way')
        interrupts.check()
        done.append('the next step')
    assert done == ['the step that was under way']
    assert signal.getsignal(number) is before


def test_without_an_interrupt_nothing_happens():
    before = [signal.getsignal(number) for number in SIGNALS]
    with Interrupts() as interrupts:
        interrupts.check()
        assert [signal.getsignal(number) for number in SIGNALS] != before
    assert [signal.getsignal(number) for number in SIGNALS] == before
