"""Reads the pixels of a picture of a table."""

from matplotlib.image import imread


def pixels(picture, folder, dpi=200):
    """Return the picture as it is saved, (height, width, 3), each channel from 0 to 1."""
    picture.save(str(folder / 'picture.png'), 'png', dpi)
    return imread(folder / 'picture.png')[..., :3]


def color_at(image, table, x, y):
    """Return the colour at a place in m; the picture has a margin of 1 % of the length."""
    margin = 0.01 * table.length
    height, width, _ = image.shape
    column = (x + margin) / (table.length + 2 * margin) * width
    row = height - (y + margin) / (table.width + 2 * margin) * height
    return tuple(image[int(row), int(column)])
