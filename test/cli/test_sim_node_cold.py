"""The command `sim_node` where nothing is compiled, or nothing that is compiled can be kept."""

import pytest
from process_harness import node_process, start_node
from ros_harness import Observer


def plays(ros):
    observer = Observer(ros).wait_for_match()
    shot = observer.ask(velocity=[-2.0, 0.1])
    observer.wait_for_phase(shot, 'done')


def test_in_plain_python(ros, monkeypatch):
    monkeypatch.setenv('NUMBA_DISABLE_JIT', '1')
    with node_process(real_time_factor=10.0) as process:
        plays(ros)
        assert 'Traceback' not in process.stderr


@pytest.mark.soak
def test_where_no_kernel_can_be_kept(ros, monkeypatch, tmp_path):
    (tmp_path / 'file').write_text('no folder')
    monkeypatch.setenv('NUMBA_CACHE_DIR', str(tmp_path / 'file'))
    with node_process(real_time_factor=10.0) as process:
        plays(ros)
        assert 'Traceback' not in process.stderr
        assert process.stderr.count('cannot keep') == 1


@pytest.mark.soak
def test_it_says_that_it_compiles_for_balls_that_spin(domain, monkeypatch, tmp_path):
    monkeypatch.setenv('NUMBA_CACHE_DIR', str(tmp_path))
    with start_node(**{'table.preset': '7ft'}) as process:
        process.wait_for('compiling')
        process.interrupt()
        assert process.wait() == 0
