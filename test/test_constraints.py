"""`make` installs versions that were tested, on every Python that the package supports."""

import re
import subprocess
from distutils.core import run_setup  # setuptools has it where Python no longer does
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from packaging.version import Version

PROJECT = Path(__file__).parents[1]
MAKEFILE = (PROJECT / 'Makefile').read_text()
PYTHONS = ('3.10', '3.11', '3.12', '3.13')
FILES = sorted((PROJECT / 'constraints').glob('*.txt'))
LINUX = {'sys_platform': 'linux', 'platform_system': 'Linux', 'os_name': 'posix'}


@pytest.fixture(scope='module')
def metadata():
    """What setup.py says, from the folder where it must be read."""
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(PROJECT)
        return run_setup('setup.py', stop_after='init')


def lines_of(file):
    return [line for line in file.read_text().splitlines() if line and not line.startswith('#')]


def pins(name, python):
    """Return the version of each package on a Python, by name; fail where there are two."""
    found = {}
    place = {'python_version': python, 'python_full_version': f'{python}.9', **LINUX}
    for line in lines_of(PROJECT / 'constraints' / name):
        requirement = Requirement(line)
        if requirement.marker is None or requirement.marker.evaluate(place):
            (specifier,) = requirement.specifier
            assert specifier.operator == '=='
            key = canonicalize_name(requirement.name)
            assert key not in found, f'{key} has two versions on Python {python}'
            found[key] = Version(specifier.version)
    return found


def assert_meets(pinned, wanted, python=PYTHONS[0]):
    """Fail where a requirement has no version, or one that it does not allow."""
    for text in wanted:
        requirement = Requirement(text)
        if requirement.marker and not requirement.marker.evaluate({'python_version': python}):
            continue
        version = pinned.get(canonicalize_name(requirement.name))
        assert version is not None, text
        assert version in requirement.specifier, text


@pytest.mark.parametrize('python', PYTHONS)
def test_all_that_the_package_and_its_extras_ask_for_has_a_version(metadata, python):
    wanted = [text for extra in metadata.extras_require.values() for text in extra]
    assert len(wanted) > 20
    assert_meets(pins('all.txt', python), [*metadata.install_requires, *wanted], python)


def test_the_oldest_are_those_that_the_package_names(metadata):
    oldest = pins('oldest.txt', '3.10')
    assert_meets(oldest, [text.replace('>=', '==') for text in metadata.install_requires])
    assert_meets(oldest, re.search(r'^OLDEST_TESTS = (.*)$', MAKEFILE, re.M)[1].split())


def test_what_pooltool_asks_for_has_a_version():
    wanted = lines_of(PROJECT / 'test' / 'benchmark' / 'pooltool-requirements.txt')
    for python in PYTHONS:
        assert_meets(pins('pooltool.txt', python), wanted)


def test_every_installation_of_make_heeds_a_file_of_its_own():
    """By the environment, which pip heeds where it builds, too."""
    used = re.findall(r'\$\(call INSTALL,(\w+),', MAKEFILE)
    assert {f'{name}.txt' for name in used} == {file.name for file in FILES}
    installs = re.findall(r'^.*pip install.*$', MAKEFILE, re.M)
    definition, tool_of_make_lock = installs
    assert definition.startswith(
        'INSTALL = PIP_CONSTRAINT=$(LOCKED) PIP_BUILD_CONSTRAINT=$(LOCKED)'
    )
    assert tool_of_make_lock.endswith(' uv')


@pytest.mark.parametrize(
    ('given', 'expected'), [((), 'constraints/all.txt'), (('CONSTRAINTS=',), '')]
)
def test_make_installs_within_them_unless_told_otherwise(given, expected, tmp_path):
    """What it would do, in an environment that is not there."""
    dry = subprocess.run(
        ['make', '--dry-run', f'VENV={tmp_path}/venv', *given, 'setup'],
        cwd=PROJECT,
        capture_output=True,
        text=True,
        check=True,
    )
    assert f'PIP_CONSTRAINT={expected} PIP_BUILD_CONSTRAINT={expected} ' in dry.stdout


@pytest.mark.parametrize('file', FILES, ids=lambda file: file.name)
def test_the_files_have_names_and_versions_alone(file):
    """Neither addresses nor folders: whoever installs has registries of his own."""
    for line in lines_of(file):
        requirement = Requirement(line)
        assert requirement.url is None and not requirement.extras, line
        assert '/' not in line and '@' not in line, line
