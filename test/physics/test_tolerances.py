"""All tolerances stand in one place, each with its reason; no kernel has numbers of its own."""

import ast
from importlib import import_module
from importlib.resources import files
from pathlib import Path

import pytest

from pool_sim_ros.physics import tolerances

PHYSICS = Path(str(files('pool_sim_ros.physics')))
MODULES = sorted(path.relative_to(PHYSICS).as_posix() for path in PHYSICS.rglob('*.py'))

PLAIN = {0, 0.5, 1, 2, 4}
"""Numbers that formulas have: a half of a t^2, a square's 2, four times."""

INDICES = set(range(6))
"""Of cushions, and of rows: that of a segment has six numbers."""


def parsed(module):
    return ast.parse((PHYSICS / module).read_text())


def is_compiled(function, registered):
    decorators = {ast.unparse(decorator).partition('(')[0] for decorator in function.decorator_list}
    return bool(decorators & {'kernel', 'inlined', 'njit', 'jit'}) or function.name in registered


def registered_names():
    """Yield the names of all implementations that a type chooses."""
    for module in MODULES:
        name = 'pool_sim_ros.physics.' + module.removesuffix('.py').replace('/', '.')
        for value in vars(import_module(name.removesuffix('.__init__'))).values():
            for function in getattr(value, 'implementations', {}).values():
                yield function.__name__


ALL_REGISTERED = set(registered_names())


def kernels_of(module):
    return [
        node
        for node in ast.walk(parsed(module))
        if isinstance(node, ast.FunctionDef) and is_compiled(node, ALL_REGISTERED)
    ]


def numbers_in(function):
    for statement in function.body:
        for node in ast.walk(statement):
            plain = isinstance(node, ast.Constant) and not isinstance(node.value, (str, bool))
            if plain and isinstance(node.value, (int, float, complex)):
                yield node.lineno, node.value


def constants():
    """Return the statements of the tolerances as (name, value, what follows)."""
    body = ast.parse(Path(tolerances.__file__).read_text()).body
    for node, following in zip(body, [*body[1:], None], strict=True):
        if isinstance(node, ast.Assign):
            yield node.targets[0].id, node.value, following


def test_every_tolerance_has_its_reason():
    found = list(constants())
    assert len(found) > 20
    for name, _, following in found:
        assert name.isupper()
        said = isinstance(following, ast.Expr) and isinstance(following.value, ast.Constant)
        assert said and isinstance(following.value.value, str), f'{name} has no docstring'
        assert len(following.value.value) > 20, name


def test_every_tolerance_is_a_positive_number():
    for name, _, _ in constants():
        assert getattr(tolerances, name) > 0, name


def test_every_tolerance_is_used():
    text = '\n'.join((PHYSICS / m).read_text() for m in MODULES if m != 'tolerances.py')
    words = set(''.join(c if c.isidentifier() or c.isdigit() else ' ' for c in text).split())
    assert [name for name, _, _ in constants() if name not in words] == []


def test_tolerances_fit_each_other():
    t = tolerances
    assert t.TOUCHING >= t.OVERLAP, 'what a layout may overlap is in contact'
    assert t.V_ROUNDING < t.V_MIN
    assert t.V_ROUNDING * t.COLLAPSE_GROWTH**t.MAX_REPEATS >= t.V_MIN
    assert t.MAX_ROUNDS < t.LAST_ROUND
    assert t.ROUND < t.REPEAT_WINDOW
    assert t.MOST_EVENTS_A_BALL < t.MOST_EVENTS


def test_the_look_at_kernels_sees_them():
    assert {'run', 'strike', 'finish'} <= {k.name for k in kernels_of('event_driven/engine.py')}
    assert {'position_at', 'set_off'} <= {k.name for k in kernels_of('motion/disc.py')}
    assert {'position_at', 'set_off'} <= {k.name for k in kernels_of('motion/ball.py')}
    assert 'is_outside' in {k.name for k in kernels_of('boundary/rectangle.py')}
    function = ast.parse('def f(x):\n    "1e-9"\n    return x + 1e-9 if True else -20').body[0]
    assert [value for _, value in numbers_in(function)] == [1e-9, 20]


@pytest.mark.parametrize('module', MODULES)
def test_no_kernel_has_a_number_of_its_own(module):
    faults = [
        f'{module}:{line}: {value} in {function.name}'
        for function in kernels_of(module)
        for line, value in numbers_in(function)
        if value not in PLAIN and not (type(value) is int and value in INDICES)
    ]
    assert faults == []
