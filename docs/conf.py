"""How Sphinx makes a site of these pages: `make docs`. Warnings are errors."""

import inspect
import sys
from importlib import import_module

from docutils import nodes
from numpydoc import xref
from sphinx.application import Sphinx
from sphinx.pycode import ModuleAnalyzer
from sphinx.util.docutils import SphinxDirective

import pool_sim_ros

project = 'pool_sim_ros'
author = project_copyright = 'pool_sim_ros maintainers'
release = version = pool_sim_ros.__version__

extensions = ['myst_parser', 'numpydoc', 'sphinx.ext.autodoc', 'sphinx.ext.autosummary']

html_theme = 'furo'
html_title = project
html_show_sourcelink = False
html_copy_source = False

nitpicky = True
default_role = 'literal'  # single backticks in docstrings
myst_heading_anchors = 4

autodoc_member_order = 'bysource'
autodoc_typehints = 'none'  # numpydoc's sections have the types, with their shapes
autodoc_default_options = {'members': True}
autosummary_generate = False
numpydoc_show_class_members = False
numpydoc_xref_param_type = True
numpydoc_xref_ignore = 'all'  # but for our own names, which get links
xref.DEFAULT_LINKS.clear()  # those of Python and numpy would need the network
numpydoc_xref_aliases = {
    name: f'pool_sim_ros.{room}.{name}'
    for room in ('physics', 'oracle', 'study', 'ros')
    for name in import_module(f'pool_sim_ros.{room}').__all__
}


class Names(SphinxDirective):
    """A table of names of a room, one line each, and then all that their docstrings say."""

    required_arguments = 1  # the room
    has_content = True

    def run(self) -> list[nodes.Node]:
        room, names = self.arguments[0], [name for line in self.content for name in line.split()]
        lines = [f'.. currentmodule:: {room}', '', '.. autosummary::', '']
        lines += [f'   {name}' for name in names]
        for name in names:
            kind = kind_of(getattr(import_module(room), name))
            lines += ['', f'.. auto{kind}:: {room}.{name}']
        return self.parse_text_to_nodes('\n'.join(lines))


def kind_of(thing: object) -> str:
    """Return what autodoc calls such a thing."""
    if inspect.isclass(thing):
        return 'exception' if issubclass(thing, Exception) else 'class'
    return 'module' if inspect.ismodule(thing) else 'function' if callable(thing) else 'data'


def to_the_front_page(app: Sphinx, page: str, source: list[str]) -> None:
    """Lead links to README, which is the front page here, to that."""
    source[0] = source[0].replace('](../README.md', '](index.md')


def docstring_of_constant(
    app: Sphinx, what: str, name: str, thing: object, options: object, lines: list[str]
) -> None:
    """Take the docstring of a constant from the module that defines it, not from its type."""
    if what != 'data':
        return
    room, _, constant = name.rpartition('.')
    modules = [module for module in sys.modules if module.startswith(f'{room}.')]
    for found in (ModuleAnalyzer.for_module(module).find_attr_docs() for module in modules):
        lines[:] = found.get(('', constant), lines)


def setup(app: Sphinx) -> None:
    """Register all this; Sphinx calls it."""
    app.connect('source-read', to_the_front_page)
    app.add_directive('names', Names)
    app.connect('autodoc-process-docstring', docstring_of_constant, priority=100)
