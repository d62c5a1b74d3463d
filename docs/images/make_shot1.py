"""Draw docs/images/shot1.gif, the report's first shot; needs Pillow.

Run it from the project's folder: python docs/images/make_shot1.py
"""

from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from pool_sim_ros.physics import report_table, simulate

SCALE = 270  # pixels per metre
FINE = 4  # the scale of drawing, for smooth edges
RAIL = 0.09  # m
PERIOD = 0.02  # s; a GIF counts in hundredths
SLOWED = 2  # times slower than real time
LAST = 1.5  # s: how long the last picture stays
CLOTH, CUSHION, WOOD = '#24754d', '#175337', '#6b4023'
FILE = Path(__file__).with_name('shot1.gif')


def picture(table, positions, trails):
    """Return the table with the balls at `positions`, (n, 2) m, and their paths so far."""
    pixels = SCALE * FINE

    def place(x, y):
        return (RAIL + x) * pixels, (RAIL + table.width - y) * pixels

    size = [round((side + 2 * RAIL) * pixels) for side in (table.length, table.width)]
    image = Image.new('RGB', size, WOOD)
    draw = ImageDraw.Draw(image)
    for color, edge in ((CUSHION, 0.03), (CLOTH, 0.0)):
        (left, bottom), (right, top) = (
            place(-edge, -edge),
            place(table.length + edge, table.width + edge),
        )
        draw.rectangle((left, top, right, bottom), fill=color)
    for ball, trail in zip(table.balls, trails, strict=True):
        draw.line([place(*point) for point in trail], rgb(ball.color), 2 * FINE, joint='curve')
    font = ImageFont.load_default(0.055 * pixels)
    for ball, position in zip(table.balls, positions, strict=True):
        x, y = place(*position)
        for color, part in ((rgb(ball.color), 1.0), ('white', 0.6)):
            r = ball.radius * part * pixels
            draw.ellipse((x - r, y - r, x + r, y + r), fill=color)
        draw.text((x, y), ball.label, 'black', font, anchor='mm')
    return image.resize([side // FINE for side in size], Image.Resampling.LANCZOS)


def rgb(color):
    return tuple(round(255 * part) for part in color)


def main():
    table = report_table()
    shot = simulate(table, (-4.0, 0.0))
    times = np.append(np.arange(0.0, shot.duration, PERIOD), shot.duration)
    fine = np.linspace(0.0, shot.duration, 2000)
    paths = shot.positions(fine)
    frames = [
        picture(
            table,
            positions,
            [
                [*map(tuple, paths[fine <= time, i]), tuple(positions[i])]
                for i in range(len(table.balls))
            ],
        )
        for time, positions in zip(times, shot.positions(times), strict=True)
    ]
    palette = frames[-1].quantize(96)
    frames = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    durations = [round(1000 * PERIOD * SLOWED)] * (len(frames) - 1) + [round(1000 * LAST)]
    frames[0].save(
        FILE, save_all=True, append_images=frames[1:], duration=durations, loop=0, optimize=False
    )


if __name__ == '__main__':
    main()
