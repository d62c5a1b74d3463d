// Where the balls are at any moment between the frames that arrived.

import { between } from './turning.js';

const DELAY_FRAMES = 2; // how far behind the newest frame the picture runs, so that there is a next
const SETTLE = 0.1; // s in which the picture's clock takes up most of a deviation
const WINDOW = 0.5; // s of arrivals that tell the pace
const JUMP = 0.5; // s of wall time by which the clock may be off before it is set anew

export class Timeline {
  constructor() {
    this.clear();
  }

  clear() {
    this.frames = []; // {stamp, arrival, places: [x0, y0, x1, ...], turns, sunk}, in order of time
    this.corners = new Map(); // ball -> [{stamp, x, y}]: where it was when it touched something
    this.time = NaN; // sim time of the picture, s
    this.now = NaN;
  }

  get newest() {
    return this.frames.at(-1);
  }

  // Take a frame that arrived at the wall time `arrival`, s. Where balls turn and fall into pockets
  // it has their quaternions `turns` and which are `sunk`; else these are null.
  add(stamp, places, arrival, turns = null, sunk = null) {
    const newest = this.newest;
    if (newest && (stamp < newest.stamp || places.length !== newest.places.length)) this.clear();
    if (newest && stamp === newest.stamp) this.frames.pop();
    this.frames.push({ stamp, arrival, places, turns, sunk });
    while (this.frames.length > 4 && this.frames[1].arrival < arrival - WINDOW
      && this.frames[1].stamp < this.time) this.frames.shift();
  }

  // A contact at a sim time tells the exact corner of a ball's way.
  addCorner(ball, stamp, x, y) {
    if (!this.corners.has(ball)) this.corners.set(ball, []);
    const corners = this.corners.get(ball);
    corners.push({ stamp, x, y });
    while (corners.length && corners[0].stamp < this.frames[0]?.stamp) corners.shift();
  }

  // Sim seconds per wall second, and sim seconds per frame, as they arrived of late.
  pace() {
    const { newest, frames } = this;
    let first = frames.length - 1;
    while (first > 0 && newest.arrival - frames[first - 1].arrival < WINDOW) first -= 1;
    if (first === frames.length - 1) first = Math.max(0, first - 1);
    const steps = frames.length - 1 - first;
    const wall = newest.arrival - frames[first].arrival;
    if (steps < 1 || wall <= 0) return { rate: 1, gap: 0 };
    const elapsed = newest.stamp - frames[first].stamp;
    return { rate: elapsed / wall, gap: elapsed / steps };
  }

  // Move the picture's clock to the wall time `now`, s.
  advance(now) {
    const newest = this.newest;
    if (!newest) return;
    const { rate, gap } = this.pace();
    const due = newest.stamp + rate * (now - newest.arrival) - DELAY_FRAMES * gap;
    const target = Math.min(newest.stamp, due);
    const elapsed = now - this.now;
    const off = Math.abs(target - this.time) > JUMP * Math.max(rate, 1);
    if (!(elapsed >= 0) || off || Number.isNaN(this.time)) {
      this.time = target;
    } else {
      const expected = this.time + rate * elapsed;
      const next = expected + (target - expected) * (1 - Math.exp(-elapsed / SETTLE));
      this.time = Math.min(newest.stamp, Math.max(this.time, next));
    }
    this.now = now;
  }

  // The two frames around the picture's time; they are the same where nothing lies between.
  around() {
    const { frames, time } = this;
    let after = frames.length - 1;
    while (after > 0 && frames[after - 1].stamp > time) after -= 1;
    const to = frames[after];
    return time >= to.stamp ? [to, to] : [frames[Math.max(0, after - 1)], to];
  }

  // Quaternions at the picture's time; null where balls do not turn.
  turns() {
    const [from, to] = this.around();
    if (!from.turns || from === to) return to.turns;
    const part = (this.time - from.stamp) / (to.stamp - from.stamp);
    return to.turns.map((turn, ball) => between(from.turns[ball], turn, part));
  }

  // Which balls lie in a pocket; null where there is none.
  sunk() {
    return this.around()[0].sunk;
  }

  // [x0, y0, x1, ...] at the picture's time.
  places() {
    const { time } = this;
    const [from, to] = this.around();
    if (to === from) return to.places.slice();
    const places = new Array(to.places.length);
    for (let ball = 0; 2 * ball < places.length; ball += 1) {
      let low = { stamp: from.stamp, x: from.places[2 * ball], y: from.places[2 * ball + 1] };
      let high = { stamp: to.stamp, x: to.places[2 * ball], y: to.places[2 * ball + 1] };
      for (const corner of this.corners.get(ball) ?? []) {
        if (corner.stamp <= low.stamp || corner.stamp >= high.stamp) continue;
        if (corner.stamp <= time) low = corner;
        else { high = corner; break; }
      }
      const part = Math.max(0, (time - low.stamp) / (high.stamp - low.stamp));
      places[2 * ball] = low.x + part * (high.x - low.x);
      places[2 * ball + 1] = low.y + part * (high.y - low.y);
    }
    return places;
  }

  // Speed of each ball between the two frames around the picture's time, m/s.
  speeds() {
    const { frames, time } = this;
    let after = frames.length - 1;
    while (after > 1 && frames[after - 1].stamp > time) after -= 1;
    if (after < 1) return [];
    const [from, to] = [frames[after - 1], frames[after]];
    const speeds = [];
    for (let i = 0; i < to.places.length; i += 2) {
      const way = Math.hypot(to.places[i] - from.places[i], to.places[i + 1] - from.places[i + 1]);
      speeds.push(way / (to.stamp - from.stamp));
    }
    return speeds;
  }
}
