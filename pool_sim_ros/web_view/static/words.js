// Contacts and places in words, as somebody sees them who looks at the picture.

const [BALL, CUSHION, POCKET] = [0, 1, 3];
const PLAIN = [[1, 0], [-1, 0], [0, 1], [0, -1]]; // normals of the cushions x = 0, x = length, ...

export class Words {
  constructor(table, upright) {
    Object.assign(this, { table, upright });
  }

  label(ball) {
    return this.table.balls[ball]?.label ?? String(ball);
  }

  // [t, kind, a, b, x, y, speed]
  contact([, kind, a, b, x, y]) {
    const ball = this.label(a);
    if (kind === BALL) return `${ball} hits ${this.label(b)}`;
    if (kind === POCKET) return `${ball} into the ${this.pocket(b)}`;
    return kind === CUSHION ? `${ball} off the ${this.cushion(b, x, y)}` : `${ball} stops`;
  }

  cushion(row, x, y) {
    const { cushions } = this.table;
    if (!cushions) return `${this.side(PLAIN[row] ?? [0, 0])} cushion`;
    const segment = cushions.segments[row];
    if (!segment) return `point of the ${this.nearest(x, y)}`;
    const normal = segment.slice(4);
    const along = Math.max(...normal.map(Math.abs)) > 0.999;
    return along ? `${this.side(normal)} cushion` : `jaw of the ${this.nearest(x, y)}`;
  }

  // A cushion's side, by its normal into the table. Upright, x runs down and y to the right.
  side([nx, ny]) {
    const lying = Math.abs(nx) > Math.abs(ny)
      ? (nx > 0 ? 'left' : 'right') : (ny > 0 ? 'bottom' : 'top');
    return this.upright ? { left: 'top', right: 'bottom', bottom: 'left', top: 'right' }[lying] : lying;
  }

  pocket(number) {
    const place = this.table.pockets[number];
    return place ? this.named(place[0], place[1]) : `pocket ${number}`;
  }

  nearest(x, y) {
    const far = ([px, py]) => Math.hypot(px - x, py - y);
    const [first, ...others] = this.table.pockets;
    if (!first) return 'corner';
    const place = others.reduce((best, pocket) => (far(pocket) < far(best) ? pocket : best), first);
    return this.named(place[0], place[1]);
  }

  named(x, y) {
    const { length, width } = this.table;
    const third = (part) => (part < 0.25 ? 0 : part > 0.75 ? 2 : 1);
    const [along, across] = [third(x / length), third(y / width)];
    const [column, row] = this.upright ? [across, along] : [along, 2 - across];
    const names = [['top', 'middle', 'bottom'][row], ['left', 'middle', 'right'][column]];
    return `${names.filter((name, i) => name !== 'middle' || names[1 - i] === 'middle').join(' ')}`
      + `${names.includes('middle') ? ' middle' : ''} pocket`;
  }
}
