"""Fixtures for tests in a browser."""

import pytest


@pytest.fixture(scope='module')
def browser():
    """Chromium, without a window."""
    import chromium

    with chromium.open_browser() as browser:
        yield browser


@pytest.fixture
def show(browser):
    """Open pages; fails where one of them had an error."""
    from browser_page import DESKTOP, Page

    contexts, pages = [], []

    def open_page(address, size=DESKTOP, **options):
        contexts.append(browser.new_context(viewport=size, **options))
        pages.append(Page(contexts[-1].new_page()))
        pages[-1].page.goto(address)
        return pages[-1]

    yield open_page
    errors = [error for page in pages for error in page.errors]
    for context in contexts:
        context.close()
    assert errors == []
