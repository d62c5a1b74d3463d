"""The code in README, docs and docstrings runs. No ROS: test_docs.py runs what needs it."""

import ast
import doctest
import importlib
import re
from pathlib import Path

import pytest
from house import House

PROJECT = Path(__file__).parents[1]
PAGES = [PROJECT / 'README.md', *sorted((PROJECT / 'docs').glob('*.md'))]
ROS = re.compile(r'^ *(from|import) +(rclpy|pool_sim_ros\.ros)\b', re.MULTILINE)
"""A block that imports one of these needs a simulator and is left out here."""

EXTRAS = {'dask', 'distributed', 'gymnasium', 'matplotlib', 'pandas', 'tqdm', 'xarray', 'zarr'}
"""Packages without which a block is skipped."""


def blocks():
    """Return the Python blocks of each page, with their lines in the file."""
    found_blocks = []
    for page in PAGES:
        text = page.read_text()
        for found in re.finditer(r'^```python\n(.*?)^```', text, re.MULTILINE | re.DOTALL):
            if not ROS.search(found[1]):
                line = text.count('\n', 0, found.start(1))
                name = f'{page.relative_to(PROJECT)}:{line + 1}'
                found_blocks.append(pytest.param('\n' * line + found[1], name, id=name))
    return found_blocks


def docstrings():
    """Return the docstrings of the package that show a session with the interpreter."""
    examples = []
    for module in House(PROJECT).modules.values():
        for node in ast.walk(module.tree):
            if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef):
                text = ast.get_docstring(node) or ''
                if '>>> ' in text:
                    name = f'{module.name}.{node.name}' if hasattr(node, 'name') else module.name
                    examples.append(pytest.param(module.name, text, name, id=name))
    return examples


@pytest.mark.parametrize(('code', 'name'), blocks())
def test_a_python_block_runs(code, name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # what an example writes
    monkeypatch.setenv('MPLBACKEND', 'Agg')
    try:
        exec(compile(code, PROJECT / name.partition(':')[0], 'exec'), {})
    except ModuleNotFoundError as error:
        if error.name not in EXTRAS:
            raise
        pytest.skip(f'{error.name} is not installed here')


@pytest.mark.parametrize(('module', 'text', 'name'), docstrings())
def test_an_example_in_a_docstring_prints_what_it_shows(module, text, name):
    names = dict(vars(importlib.import_module(module)))
    test = doctest.DocTestParser().get_doctest(text, names, name, None, 0)
    report = []
    failures = doctest.DocTestRunner(verbose=False).run(test, out=report.append).failed
    assert not failures, ''.join(report)


def test_readme_and_the_physics_have_examples():
    """So that a pattern that finds nothing does not pass for a success."""
    assert any('README.md' in block.id for block in blocks())
    assert any(example.id == 'pool_sim_ros.physics' for example in docstrings())
