// From metres on the cloth to pixels in the picture, and back.

const RAIL = 0.13; // m of wood around the cloth

export class Geometry {
  // A table in a box of so many CSS pixels; upright where that makes it larger.
  constructor(table, width, height) {
    const [length, breadth] = [table.length + 2 * RAIL, table.width + 2 * RAIL];
    const lying = Math.min(width / length, height / breadth);
    const upright = Math.min(width / breadth, height / length);
    this.table = table;
    this.upright = upright > lying * 1.15;
    this.scale = this.upright ? upright : lying; // pixels per metre
    this.rail = RAIL * this.scale;
    this.width = (this.upright ? breadth : length) * this.scale;
    this.height = (this.upright ? length : breadth) * this.scale;
  }

  // Upright, x runs down and y to the right; else x runs to the right and y up.
  toScreen(x, y) {
    const { scale, rail, table } = this;
    return this.upright
      ? [rail + y * scale, rail + x * scale]
      : [rail + x * scale, rail + (table.width - y) * scale];
  }

  toTable(sx, sy) {
    const { scale, rail, table } = this;
    return this.upright
      ? [(sy - rail) / scale, (sx - rail) / scale]
      : [(sx - rail) / scale, table.width - (sy - rail) / scale];
  }
}
