"""The browser for tests of pages: Chromium without a window. Who imports this skips without it."""

import contextlib
import shutil

import pytest

CHROMIUM = next(filter(None, map(shutil.which, ('chromium', 'chromium-browser'))), None)
if CHROMIUM is None:
    pytest.skip('Chromium is missing: apt install chromium', allow_module_level=True)
sync_api = pytest.importorskip('playwright.sync_api', reason='pip install playwright')

SWITCHES = [
    '--no-sandbox',
    '--disable-gpu',
    '--disable-quic',
    '--no-first-run',
    '--disable-background-networking',
    '--disable-component-update',
    '--disable-sync',
]


@contextlib.contextmanager
def open_browser():
    """Start the browser, and end it."""
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=SWITCHES)
        yield browser
        browser.close()


def inject_scripts(page):
    """Try to run scripts in a page as whoever got HTML into it would; return those that ran.

    Parameters
    ----------
    page : playwright's Page
    """
    return page.evaluate(
        """async () => {
          window.ran = [];
          const html = (code) => {
            const host = document.createElement('div');
            host.innerHTML = code;
            document.body.append(host);
          };
          html('<img src="data:image/png;base64,x" onerror="ran.push(\\'handler\\')">');
          html('<svg onload="ran.push(\\'svg\\')"></svg>');
          html('<iframe srcdoc="<script>parent.ran.push(1)</script>"></iframe>');
          html('<a id="link" href="javascript:ran.push(\\'link\\')">x</a>');
          document.getElementById('link').click();
          for (const source of ['', 'data:text/javascript,ran.push("data")']) {
            const script = document.createElement('script');
            if (source) script.src = source;
            else script.textContent = 'ran.push("inline")';
            document.body.append(script);
          }
          await new Promise((done) => setTimeout(done, 500));
          return ran;
        }"""
    )
