"""docs/contributing.md has a map of the package and a walk through it; both name what there is."""

import re
from pathlib import Path

PROJECT = Path(__file__).parents[1]
PACKAGE = PROJECT / 'pool_sim_ros'
TEXT = (PROJECT / 'docs' / 'contributing.md').read_text()
COMPILED = {'.pyc', '.nbi', '.nbc'}


def files_on_the_map():
    """Return the files that the tables name, relative to the package, in order."""
    files = []
    room = re.compile(r'^### `pool_sim_ros/(.*?)`\n(.*?)(?=^##|\Z)', re.M | re.S)
    for heading, body in room.findall(TEXT):
        files += [heading + name for name in re.findall(r'^\| `(.+?)` \| .', body, re.M)]
    return files


def steps():
    """Return the numbered steps of the walk: (number, file, name)."""
    (walk,) = re.findall(r'^## From a topic to a frame\n(.*?)^## ', TEXT, re.M | re.S)
    return re.findall(r'^(\d+)\. `(.+?)`, `(\w+)`: ', walk, re.M)


def test_the_map_names_every_file_of_the_package_once_and_none_that_is_not_there():
    there = {
        str(path.relative_to(PACKAGE))
        for path in PACKAGE.rglob('*')
        if path.is_file() and path.suffix not in COMPILED
    }
    assert sorted(files_on_the_map()) == sorted(there)


def test_the_walk_has_at_most_ten_steps_and_each_exists():
    assert [int(number) for number, *_ in steps()] == list(range(1, len(steps()) + 1))
    assert 5 <= len(steps()) <= 10
    for _, file, name in steps():
        source = (PACKAGE / file).read_text()
        assert re.search(rf'^( *def {name}\(|{name} = )', source, re.M), f'{file}: {name}'


def test_files_and_make_targets_in_the_text_exist():
    _, _, text = TEXT.partition('## From a topic to a frame')
    for path in re.findall(r'`((?:[\w.]+/)+[\w.]+\.\w+)`', text):
        assert any((folder / path).is_file() for folder in (PROJECT, PACKAGE)), path
    makefile = (PROJECT / 'Makefile').read_text()
    for target in re.findall(r'`make (\w+)`', TEXT):
        assert re.search(rf'^{target}:', makefile, re.M), target
