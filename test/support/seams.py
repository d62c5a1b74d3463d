"""What the physics lets a type choose."""

import inspect


def chosen_functions(module):
    """Return the functions that a module declares with `chosen_by`, by name."""
    return {
        name: function
        for name, function in inspect.getmembers(module, inspect.isfunction)
        if hasattr(function, 'implementations')
        and function.__module__ == module.__name__
        and not name.startswith('_')
    }
