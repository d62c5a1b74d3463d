"""A page that is open in the browser, and what tests do with it."""

import time

from waiting import PATIENCE

DESKTOP = {'width': 1280, 'height': 800}
PHONE = {'width': 390, 'height': 844}


class Page:
    """A page that is open in the browser."""

    def __init__(self, page):
        self.page = page
        self.errors = []
        page.on('pageerror', lambda error: self.errors.append(str(error)))

    def get(self, script):
        return self.page.evaluate(script)

    def wait(self, script):
        """Wait until an expression is true."""
        end = time.monotonic() + PATIENCE
        while not self.get(f'Boolean({script})'):
            if time.monotonic() > end:
                shown = self.page.inner_text('body')
                raise AssertionError(f'waited {PATIENCE:g} s for {script}; the page:\n{shown}')
            self.page.wait_for_timeout(30)  # each look costs the browser

    def text(self, element):
        return self.page.inner_text(f'#{element}')

    def press(self, *keys):
        for key in keys:
            self.page.keyboard.press(key)

    def wait_for_rest(self):
        self.wait('page.state && page.places && !page.state.moving && !page.state.computing')

    def start_over(self):
        """Put the balls back, and wait until the page shows it."""
        self.wait_for_rest()
        # Not with the mouse: while the page still fills, the button moves away under it.
        self.get("document.getElementById('reset').click()")
        self.get('scrollTo(0, 0)')
        self.wait(
            'page.table.balls.every(({ position: [x, y] }, i) =>'
            ' page.places[2 * i] === x && page.places[2 * i + 1] === y)'
        )

    def fill(self, **values):
        """Type into fields, as they are named, with _ for -."""
        for name, value in values.items():
            self.page.fill(f'#{name.replace("_", "-")}', value)

    def shoot(self):
        """Shoot what is aimed at, and wait for the result."""
        self.page.click('#shoot')
        self.wait_for_result()

    def wait_for_result(self):
        """Wait until the latest shot is over, and known."""
        self.wait('page.result && page.strike.shot && page.result.id === page.strike.shot.id')
        self.wait('page.standing && !document.getElementById("result").hidden')
        self.wait_for_rest()  # the state comes on a topic of its own

    def scrub(self, frame):
        """Move the bar to a frame."""
        self.get(f"""() => {{
          const bar = document.getElementById('bar');
          bar.value = {frame};
          bar.dispatchEvent(new Event('input'));
        }}""")
        self.wait('!page.dirty')

    def pixel(self, x, y):
        """Return where a place on the table is in the window."""
        box = self.page.locator('#table').bounding_box()
        sx, sy = self.get(f'page.painter.geometry.toScreen({x}, {y})')
        return box['x'] + sx, box['y'] + sy

    def drag(self, x, y):
        """Drag back from the cue ball by x, y in m; stay there until this is predicted."""
        ball = self.get('page.places.slice(0, 2)')
        self.page.mouse.move(*self.pixel(*ball))
        self.page.mouse.down()
        self.page.mouse.move(*self.pixel(ball[0] + x, ball[1] + y), steps=5)
        self.wait(
            'page.prediction && page.prediction.velocity[0] === page.aim.velocity[0]'
            ' && page.prediction.velocity[1] === page.aim.velocity[1]'
        )
        return self.get('page.prediction')

    def record(self):
        """Keep what is drawn from now on, frame by frame."""
        self.get("""() => {
          page.record = [];
          const look = () => {
            if (page.record.at(-1) !== page.places) page.record.push(page.places);
            requestAnimationFrame(look);
          };
          look();
        }""")
