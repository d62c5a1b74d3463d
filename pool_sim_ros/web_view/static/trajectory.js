// A shot that can be looked up at any time: what the server sends of a trajectory.

import { inverse, product, turned } from './turning.js';

const SAG = 5e-5; // m between a curve and its corners: far less than a pixel
const STILL = { vx: 0, vy: 0, ax: 0, ay: 0, wx: 0, wy: 0, wz: 0, turnX: 0, turnY: 0 };
const UPRIGHT = [0, 0, 0, 1];

export class Trajectory {
  // `fields`: see motion.py. `turns`: how the balls are turned at the strike, if they turn.
  constructor(fields, table, turns = null) {
    Object.assign(this, fields);
    this.balls = table.balls.length;
    this.rows = this.start.map(() => []);
    for (const [ball, t, x, y, vx, vy, ax, ay, wx = 0, wy = 0, wz = 0, turnX = 0, turnY = 0]
      of this.segments) {
      this.rows[ball].push({ t, x, y, vx, vy, ax, ay, wx, wy, wz, turnX, turnY });
    }
    const { mu_spin: mu, gravity } = table;
    this.loss = mu ? (5 * mu * gravity) / (2 * table.balls[0].radius) : 0;
    this.turns = null;
    if (turns) this.turnFrom(turns);
  }

  // Take how the balls are turned at the strike.
  turnFrom(turns) {
    this.turns = turns;
    this.rows.forEach((rows, ball) => {
      let turn = turns[ball];
      rows.forEach((row, i) => {
        row.turn = turn;
        const end = rows[i + 1]?.t ?? this.duration;
        turn = turned(turn, row, this.loss, Math.max(0, end - row.t));
      });
    });
  }

  // The same from how they are turned at the end, for a page that came after the strike.
  turnTo(turns) {
    this.turnFrom(turns.map(() => UPRIGHT));
    const whole = this.turnsAt(this.duration);
    this.turnFrom(turns.map((turn, ball) => product(inverse(whole[ball]), turn)));
  }

  // What a ball does at a time, and since when.
  row(ball, time) {
    const rows = this.rows[ball];
    let [low, high] = [0, rows.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (rows[middle].t <= time) low = middle + 1;
      else high = middle;
    }
    return rows[low - 1] ?? { ...STILL, t: 0, x: this.start[ball][0], y: this.start[ball][1] };
  }

  place(ball, time) {
    if (time >= this.duration) return this.ends[ball];
    const row = this.row(ball, time);
    return at(row, time - row.t);
  }

  // [x0, y0, x1, ...]
  places(time) {
    return this.start.flatMap((_, ball) => this.place(ball, time));
  }

  speeds(time) {
    return this.start.map((_, ball) => {
      if (time >= this.duration) return 0;
      const { t, vx, vy, ax, ay } = this.row(ball, time);
      return Math.hypot(vx + (time - t) * ax, vy + (time - t) * ay);
    });
  }

  // Quaternions, or null where balls do not turn.
  turnsAt(time) {
    return this.turns && this.start.map((_, ball) => {
      if (!this.rows[ball].length) return this.turns[ball];
      const row = this.row(ball, Math.min(time, this.duration));
      return turned(row.turn, row, this.loss, Math.max(0, Math.min(time, this.duration) - row.t));
    });
  }

  // Of each ball: whether it lies in a pocket.
  sunk(time) {
    return this.pocketed.map((pocket, ball) => pocket >= 0
      && time >= (this.rows[ball].at(-1)?.t ?? 0));
  }

  // The paths of the balls that move: corners so close that curves are smooth.
  paths() {
    return this.rows.flatMap((rows, ball) => {
      const points = rows.flatMap((row, i) => {
        const lasts = (rows[i + 1]?.t ?? this.duration) - row.t;
        return times(row, lasts).map((t) => at(row, t));
      });
      points.push(this.ends[ball]);
      const corners = points.filter(([x, y], i) => !i || x !== points[i - 1][0] || y !== points[i - 1][1]);
      return corners.length > 1 ? [{ ball, points: corners }] : [];
    });
  }
}

const at = ({ x, y, vx, vy, ax, ay }, t) => [
  x + t * (vx + 0.5 * t * ax), y + t * (vy + 0.5 * t * ay),
];

// The times of the corners on a segment, from 0 on and without its end.
function times({ vx, vy, ax, ay }, lasts) {
  const squared = ax * ax + ay * ay;
  const across = Math.abs(vx * ay - vy * ax);
  if (squared === 0) return [0];
  if (across <= 1e-12 * Math.hypot(vx, vy) * Math.sqrt(squared)) {
    const back = -(vx * ax + vy * ay) / squared; // where a ball turns back on its own line
    return back > 0 && back < lasts ? [0, back] : [0];
  }
  const count = Math.max(1, Math.ceil(Math.sqrt((Math.sqrt(squared) * lasts * lasts) / 8 / SAG)));
  return Array.from({ length: count }, (_, i) => (i * lasts) / count);
}
