"""The scripts and notebooks in examples/ run as their users run them, on small settings."""

import os
import re
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

PROJECT = Path(__file__).parents[1]
EXAMPLES = PROJECT / 'examples'
NOTEBOOKS = sorted(EXAMPLES.glob('*.ipynb'))
ENVIRONMENT = os.environ | {'PYTHONPATH': str(PROJECT), 'MPLBACKEND': 'Agg'}


def run(name, *arguments, folder, timeout=120):
    """Return what an example prints, run in a folder of its own."""
    done = subprocess.run(
        [sys.executable, EXAMPLES / name, *arguments],
        cwd=folder,
        env=ENVIRONMENT,
        capture_output=True,
        text=True,
        timeout=timeout,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_every_script_is_run_by_a_test():
    tests = '\n'.join(path.read_text() for path in (PROJECT / 'test').rglob('test_*.py'))
    scripts = {path.name for path in EXAMPLES.glob('*.py')}
    assert len(scripts) >= 5 and len(NOTEBOOKS) >= 2
    assert not {name for name in scripts if f"'{name}'" not in tests}


def test_the_report_in_ten_lines_ends_where_it_printed(tmp_path):
    off = re.findall(r'At most (\S+) in', run('report_in_ten_lines.py', folder=tmp_path))
    assert len(off) == 4 and all(float(inches) <= 0.0051 for inches in off)
    lines = (EXAMPLES / 'report_in_ten_lines.py').read_text().partition('physics import')[2]
    assert sum(bool(line) for line in lines.splitlines()[1:]) <= 10


def test_the_map_of_a_shot_is_drawn(tmp_path):
    pytest.importorskip('matplotlib')
    said = run('map_of_a_shot.py', '--side', '20', '--out', 'map.png', folder=tmp_path)
    assert said.startswith('400 shots in ') and 'Ball 9 goes farthest' in said
    assert (tmp_path / 'map.png').read_bytes().startswith(b'\x89PNG')


def test_a_plan_under_noise_has_chances_and_a_budget(tmp_path):
    said = run('plan_under_noise.py', '--shots', '2000', folder=tmp_path)
    chance = float(re.search(r'^ 1 .* ([\d.]+) % +[\d.]+ to', said, re.M)[1])
    assert 0.0 < chance <= 100.0
    errors = re.findall(r'^(\w+) +\(', said, re.M)
    assert errors == ['speed', 'azimuth', 'elevation', 'side', 'above', 'camera']


def test_training_writes_its_curve(tmp_path):
    pytest.importorskip('gymnasium')
    said = run('train_place.py', '--generations', '1', '--curve', 'curve.png', folder=tmp_path)
    assert said.startswith('generation 1: a shot earns ')
    assert (tmp_path / 'curve.png').read_bytes().startswith(b'\x89PNG')


@pytest.mark.parametrize('notebook', NOTEBOOKS, ids=lambda path: path.name)
def test_a_notebook_runs(notebook, tmp_path, monkeypatch):
    pytest.importorskip('ipykernel')
    for name in ('matplotlib', 'pandas'):
        pytest.importorskip(name)
    monkeypatch.setenv('PYTHONPATH', str(PROJECT))
    monkeypatch.setenv('SHOTS', '3000')
    monkeypatch.setenv('IPYTHONDIR', str(tmp_path))
    monkeypatch.delenv('MPLBACKEND', raising=False)
    book = nbformat.read(notebook, as_version=4)
    client = NotebookClient(book, timeout=300, resources={'metadata': {'path': str(tmp_path)}})
    client.execute()
    outputs = [output for cell in book.cells for output in cell.get('outputs', ())]
    kinds = {kind for output in outputs for kind in output.get('data', ())}
    assert 'image/png' in kinds


@pytest.mark.parametrize('notebook', NOTEBOOKS, ids=lambda path: path.name)
def test_a_notebook_is_kept_without_what_it_printed(notebook):
    for cell in nbformat.read(notebook, as_version=4).cells:
        assert cell.cell_type == 'markdown' or (not cell.outputs and cell.execution_count is None)
