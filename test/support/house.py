"""The files of the package: its rooms, its modules, and what they import. None of it runs."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

PACKAGE = 'pool_sim_ros'


@dataclass(frozen=True)
class Import:
    """A line that imports: a module, and what it takes from it (None: the module itself)."""

    line: int
    module: str
    name: str | None


@dataclass(frozen=True)
class Module:
    """A file of the package.

    Attributes
    ----------
    name : str
        As Python imports it; that of a room for its `__init__`.
    path : Path
    is_room : bool
        Whether the file is the `__init__` of a folder.
    """

    name: str
    path: Path
    is_room: bool

    @cached_property
    def tree(self) -> ast.Module:
        return ast.parse(self.path.read_text())

    @property
    def stem(self) -> str:
        return self.path.stem

    @property
    def imports(self) -> Iterator[Import]:
        """All of them: inside functions and below TYPE_CHECKING too."""
        for node in ast.walk(self.tree):
            if isinstance(node, ast.Import):
                yield from (Import(node.lineno, alias.name, None) for alias in node.names)
            elif isinstance(node, ast.ImportFrom):
                module = self._absolute(node.module, node.level)
                yield from (Import(node.lineno, module, alias.name) for alias in node.names)

    @property
    def lazy_modules(self) -> Iterator[Import]:
        """The modules that a room loads through `lazy_exports` when a name is asked for."""
        for node in ast.walk(self.tree):
            if isinstance(node, ast.Call) and getattr(node.func, 'id', '') == 'lazy_exports':
                for module in node.args[1].values:
                    yield Import(module.lineno, f'{self.name}.{module.value}', None)

    @property
    def exports(self) -> tuple[str, ...]:
        """What stands in `__all__`."""
        for node in self.tree.body:
            if isinstance(node, ast.Assign) and getattr(node.targets[0], 'id', '') == '__all__':
                return tuple(ast.literal_eval(node.value))
        return ()

    def _absolute(self, module: str | None, level: int) -> str:
        if not level:
            return module or ''
        base = self.name.split('.')
        base = base[: len(base) - level + self.is_room]
        return '.'.join([*base, *([module] if module else [])])


class House:
    """All modules of the package below a folder."""

    def __init__(self, root: Path):
        self.root = root
        self.modules = {}
        for path in sorted((root / PACKAGE).rglob('*.py')):
            parts = path.relative_to(root).with_suffix('').parts
            is_room = parts[-1] == '__init__'
            name = '.'.join(parts[:-1] if is_room else parts)
            self.modules[name] = Module(name, path, is_room)

    @property
    def rooms(self) -> list[Module]:
        """The `__init__` of every folder."""
        return [module for module in self.modules.values() if module.is_room]

    def reaches_past(self, module: Module) -> list[str]:
        """Return a line for each import that goes past the `__init__` of a room it is not in."""
        found = {}
        for imported in [*module.imports, *module.lazy_modules]:
            where = f'{module.name}:{imported.line} imports {imported.module}'
            room = self._closed_room(module, imported.module)
            if room:
                found[f'{where}, inside {room}'] = True
            elif self._is_hidden(module, imported):
                found[f'{where}.{imported.name}, which __all__ does not name'] = True
        return list(found)

    def _closed_room(self, module: Module, target: str) -> str | None:
        """Return the outermost room around `target` that `module` is not in."""
        parts = target.split('.')
        around = ['.'.join(parts[:count]) for count in range(2, len(parts))]
        rooms = [name for name in around if name in self.modules]
        return next((room for room in rooms if not _is_in(module.name, room)), None)

    def _is_hidden(self, module: Module, imported: Import) -> bool:
        room = self.modules.get(imported.module)
        if not imported.name or room is None or not room.is_room or room.name == PACKAGE:
            return False
        return not _is_in(module.name, room.name) and imported.name not in room.exports


def _is_in(module: str, room: str) -> bool:
    return f'{module}.'.startswith(f'{room}.')
