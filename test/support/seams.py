"""What the physics lets a type choose."""

import inspect


def chosen_functions(module):
    """Return the functions that a room declares with `chosen_by`, by name.

    They stand in its module `seam`, or in the module itself.
    """
    declares = getattr(module, 'seam', module)
    return {
        name: function
        for name, function in inspect.getmembers(declares, inspect.isfunction)
        if hasattr(function, 'implementations')
        and function.__module__ == declares.__name__
        and not name.startswith('_')
    }
