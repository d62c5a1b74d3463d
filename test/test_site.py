"""`make docs` builds without a warning, and every link of the site leads to a page and a place."""

import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag

import pytest

pytest.importorskip('sphinx')
pytest.importorskip('furo')
pytest.importorskip('myst_parser')
pytest.importorskip('numpydoc')

PROJECT = Path(__file__).parents[1]
MAKEFILE = (PROJECT / 'Makefile').read_text()
PAGES = {
    *('index', 'tour', 'physics', 'oracle', 'studies', 'gallery', 'benchmarks', 'pooltool'),
    *('security', 'contributing', 'changelog', 'api/physics', 'api/oracle', 'api/study', 'api/ros'),
    'api/me212',
}


def sphinx(source, folder):
    """Build a site, as `make docs` does, and return what Sphinx says."""
    command = re.search(r'^\t\$\(PY\) -m sphinx (.*) -d \S+ docs \S+$', MAKEFILE, re.M)[1]
    return subprocess.run(
        [sys.executable, '-m', 'sphinx', *command.split()]
        + ['-d', folder / 'doctrees', source, folder / 'site'],
        cwd=PROJECT,
        capture_output=True,
        text=True,
        timeout=600,
    )


@pytest.fixture(scope='module')
def site(tmp_path_factory):
    folder = tmp_path_factory.mktemp('docs')
    done = sphinx(PROJECT / 'docs', folder)
    assert (done.returncode, done.stdout, done.stderr) == (0, '', '')
    return folder / 'site'


class Page(HTMLParser):
    """The places, the links and the sources of a page."""

    def __init__(self, path):
        super().__init__()
        self.ids, self.links, self.sources = set(), [], []
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.ids.add(given.get('id'))
        if tag == 'a' and given.get('href'):
            self.links.append(given['href'])
        elif given.get('src') or (tag == 'link' and given.get('rel') == 'stylesheet'):
            self.sources.append(given.get('src') or given['href'])


@pytest.fixture(scope='module')
def pages(site):
    return {path.relative_to(site).as_posix(): Page(path) for path in site.rglob('*.html')}


def test_the_site_has_every_page(pages):
    assert {f'{page}.html' for page in PAGES} <= set(pages)
    written = {path.stem for path in (PROJECT / 'docs').glob('*.md')}
    assert written <= PAGES, 'a page of docs/ is missing above, and perhaps in docs/index.md'


def test_every_link_leads_to_a_page_and_a_place(site, pages):
    broken = []
    for name, page in pages.items():
        for link in page.links:
            path, place = urldefrag(unquote(link))
            if '://' in path or path.startswith('mailto:'):
                continue
            target = ((site / name).parent / path).resolve() if path else (site / name).resolve()
            if not target.is_file():
                broken.append(f'{name}: {link}')
            elif place and target.suffix == '.html':
                if place not in pages[target.relative_to(site.resolve()).as_posix()].ids:
                    broken.append(f'{name}: {link}')
    assert not broken, '\n'.join(broken)


def test_a_page_needs_nothing_from_elsewhere(site, pages):
    for name, page in pages.items():
        for source in page.sources:
            path = urldefrag(source.partition('?')[0])[0]
            assert '://' not in path and ((site / name).parent / path).is_file(), (name, source)


def test_the_api_has_the_docstrings(pages, site):
    api = pages['api/physics.html']
    assert {'pool_sim_ros.physics.simulate', 'pool_sim_ros.physics.Trajectory.path'} <= api.ids
    assert 'pool_sim_ros.ros.SimNode' in pages['api/ros.html'].ids
    text = (site / 'api' / 'physics.html').read_text()
    assert 'One inch in metres.' in text and 'Built-in immutable sequence' not in text


@pytest.mark.parametrize(
    'text',
    [
        '# Page\n\n[gone](nowhere.md)\n',
        '# Page\n\n[gone](#nowhere)\n',
        '# Page\n\n![gone](images/nowhere.png)\n',
        '# Page\n\n```{eval-rst}\n.. autofunction:: pool_sim_ros.physics.nowhere\n```\n',
        '# Page\n\n### Too deep\n',
    ],
    ids=['page', 'place', 'picture', 'name', 'heading'],
)
@pytest.mark.soak
def test_what_is_wrong_in_a_page_fails_the_build(text, tmp_path):
    source = tmp_path / 'docs'
    source.mkdir()
    (source / 'conf.py').write_text((PROJECT / 'docs' / 'conf.py').read_text())
    (source / 'index.md').write_text(text)
    assert sphinx(source, tmp_path).returncode != 0


def test_git_ignores_what_is_built():
    (folder,) = re.findall(r'^\t\$\(PY\) -m sphinx .* docs (\S+)$', MAKEFILE, re.M)
    assert f'/{folder.partition("/")[0]}/' in (PROJECT / '.gitignore').read_text().split()


@pytest.mark.soak
@pytest.mark.parametrize('width', [1280, 390])
def test_no_page_is_wider_than_the_window(pages, site, width):
    from chromium import open_browser  # which skips where there is none

    with open_browser() as browser:
        page = browser.new_page(viewport={'width': width, 'height': 900})
        for name in pages:
            page.goto(f'file://{site / name}')
            assert page.evaluate('document.documentElement.scrollWidth') <= width, name
