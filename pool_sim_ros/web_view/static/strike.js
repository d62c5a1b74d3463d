// The latest strike: what it did, when, and whether the balls still lie as it left them.

import { Trajectory } from './trajectory.js';

const SAME = 1e-6; // m: two places that are one, but for rounding

export class Strike {
  constructor() {
    this.take(null);
    this.begin();
  }

  // A shot was accepted.
  begin() {
    this.start = null; // sim time of the strike, s
    this.first = null; // sim time of its first contact, s
    this.rewound = false; // whether the balls lie again where they lay before it
  }

  // `shot`: a Trajectory, or null where none is known.
  take(shot, table) {
    this.shot = shot;
    this.compared = null;
    this.paths = shot?.paths() ?? null;
    this.exact = shot?.exact ? new Trajectory(shot.exact, table).paths() : null;
  }

  contact(time) {
    this.first ??= time ?? null;
  }

  finish(result) {
    if (result.id === this.shot?.id) this.start = result.t_start;
  }

  // Time since the strike at a sim time, s; null where it is not known yet.
  since(time) {
    if (this.rewound) return 0;
    if (this.start !== null) return time - this.start;
    const first = this.shot?.events[0];
    return first && this.first !== null ? time - this.first + first[0] : null;
  }

  // Whether the frame that came last is of this shot, so that the picture may show what lies between
  // the frames exactly.
  isIn({ stamp, places }) {
    const time = this.shot && this.since(stamp);
    if (!(time > 0)) return false;
    if (this.compared !== places) {
      this.compared = places;
      const own = this.shot.places(time);
      this.same = own.length === places.length && own.every((part, i) => Math.abs(part - places[i]) < SAME);
    }
    return this.same;
  }

  // Whether it is of this table: the balls lie where it began or ended; [x0, y0, ...] in m
  fits(places, moving) {
    if (!this.shot) return false;
    const ended = layoutIs(places, this.shot.ends);
    this.rewound = !moving && !ended && layoutIs(places, this.shot.start);
    return ended || this.rewound || moving;
  }
}

export function layoutIs(places, layout) {
  return places.length === 2 * layout.length
    && layout.every(([x, y], ball) => places[2 * ball] === x && places[2 * ball + 1] === y);
}
