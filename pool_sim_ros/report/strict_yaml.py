"""YAML that anybody may have written, as ROS reads it: no aliases, and each key once."""

from __future__ import annotations

import re
from typing import Any

DEEPEST = 50
"""Levels within one another; a parameter file has four."""


def read_yaml(text: str) -> Any:
    """Return the value of a text, in time that grows with its length.

    Raises
    ------
    ValueError
        Where it is no YAML, has an alias or a key twice, or is nested too deeply; says where, in
        one line.
    """
    import yaml

    loader = _loader()
    try:
        _check(text, loader)
        return yaml.load(text, Loader=loader)
    except yaml.YAMLError as error:
        raise ValueError(_in_one_line(error)) from None
    except ValueError as error:
        raise ValueError(str(error).partition('\n')[0]) from None
    except Exception as error:  # whatever the constructors make of a value that is none
        raise ValueError(f'a value makes no sense: {type(error).__name__}') from None


def _check(text: str, loader: Any) -> None:
    """Raise ValueError where an alias or the depth could take time without end."""
    import yaml

    found = yaml.reader.Reader.NON_PRINTABLE.search(text)
    if found is not None:
        line = text.count('\n', 0, found.start()) + 1
        raise ValueError(f'special characters are not allowed, line {line}')
    depth = 0
    for event in yaml.parse(text, Loader=loader):
        line = event.start_mark.line + 1
        if isinstance(event, yaml.AliasEvent):
            raise ValueError(f'aliases are not allowed, line {line}')
        depth += isinstance(event, yaml.CollectionStartEvent)
        depth -= isinstance(event, yaml.CollectionEndEvent)
        if depth > DEEPEST:
            raise ValueError(f'it is nested too deeply, line {line}')


def _loader() -> Any:
    """Return a YAML loader that reads 1e-6 as a number, as ROS does and YAML 1.1 does not."""
    import yaml

    class Loader(getattr(yaml, 'CSafeLoader', yaml.SafeLoader)):  # type: ignore[misc]
        """What YAML's own safe loader makes of it, but for what stands twice."""

        def construct_mapping(self, node: Any, deep: bool = False) -> Any:
            """Return the mapping, or raise where a key stands there twice."""
            seen: set[str] = set()
            for key in (key for key, _ in node.value if isinstance(key, yaml.ScalarNode)):
                if key.value in seen:
                    words = f'{key.value[:40]!r} is given twice'
                    raise yaml.constructor.ConstructorError(None, None, words, key.start_mark)
                seen.add(key.value)
            return super().construct_mapping(node, deep)

    number = re.compile(r'[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+$')
    Loader.add_implicit_resolver('tag:yaml.org,2002:float', number, list('-+.0123456789'))
    return Loader


def _in_one_line(error: Exception) -> str:
    problem = getattr(error, 'problem', None) or str(error).splitlines()[0]
    mark = getattr(error, 'problem_mark', None)
    return f'{problem}, line {mark.line + 1}' if mark else problem
