"""Draw docs/images/page.png and break.gif from the page; needs Pillow, playwright and Chromium.

Run it from the project's folder while a simulator with a seven-foot table and its page run:
python docs/images/make_page.py http://localhost:8080
"""

import base64
import io
import shutil
import sys
from pathlib import Path

from PIL import Image
from playwright.sync_api import sync_playwright

SIZE = {'width': 1280, 'height': 860}
WIDTH = 560  # pixels of the film
RATE = 20  # frames a second
LASTS = 3.2  # s of the shot in the film
LAST = 1.5  # s: how long the last picture stays
COLORS = 128
RACK = (0.16, 0.36, 0.32, 0.64)  # where the balls are in the first picture, as parts of it
FOLDER = Path(__file__).parent


def wait(page, condition):
    while not page.evaluate(f'Boolean({condition})'):
        page.wait_for_timeout(20)


def seek(page, time):
    page.evaluate(f'page.replay.seek({time})')
    wait(page, '!page.dirty')


def picture(page):
    """Return the table as it is drawn now."""
    data = page.evaluate("document.getElementById('table').toDataURL('image/png')")
    image = Image.open(io.BytesIO(base64.b64decode(data.split(',')[1]))).convert('RGB')
    height = round(image.height * WIDTH / image.width)
    return image.resize((WIDTH, height), Image.Resampling.LANCZOS)


def palette_of(image):
    """Return a palette in which the balls count as much as the table."""
    width, height = image.size
    left, top, right, bottom = RACK
    box = left * width, top * height, right * width, bottom * height
    rack = image.crop(tuple(map(round, box)))
    both = Image.new('RGB', (width, 2 * height))
    both.paste(image, (0, 0))
    both.paste(rack.resize(image.size), (0, height))
    return both.quantize(COLORS, Image.Quantize.MAXCOVERAGE)


def main(address):
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=shutil.which('chromium'), args=['--no-sandbox']
        )
        page = browser.new_page(viewport=SIZE)
        page.goto(address)
        wait(page, 'page.places && !page.state.moving')
        page.click('#reset')
        page.fill('#direction', '179.2')
        page.fill('#strength', '6')
        page.click('#shoot')
        wait(page, 'page.result && page.strike.shot && page.standing')
        seek(page, 0.9)
        page.evaluate('scrollTo(0, 0)')
        page.screenshot(path=FOLDER / 'page.png')
        frames = []
        page.evaluate('page.strike.paths = []')  # the film shows the balls alone
        for frame in range(round(LASTS * RATE) + 1):
            seek(page, frame / RATE)
            frames.append(picture(page))
        browser.close()
    palette = palette_of(frames[0])
    frames = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    durations = [round(1000 / RATE)] * (len(frames) - 1) + [round(1000 * LAST)]
    frames[0].save(
        FOLDER / 'break.gif',
        save_all=True,
        append_images=frames[1:],
        duration=durations,
        loop=0,
    )


if __name__ == '__main__':
    main(sys.argv[1])
