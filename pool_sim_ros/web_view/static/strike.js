// The latest strike: what it did, when, and whether the balls still lie as it left them.

import { Trajectory } from './trajectory.js';

export class Strike {
  constructor() {
    this.take(null);
    this.begin();
  }

  // A shot was accepted.
  begin() {
    this.start = null; // sim time of the strike, s
    this.first = null; // sim time of its first contact, s
  }

  // `shot`: a Trajectory, or null where none is known.
  take(shot, table) {
    this.shot = shot;
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
    if (this.start !== null) return time - this.start;
    const first = this.shot?.events[0];
    return first && this.first !== null ? time - this.first + first[0] : null;
  }

  // Whether the balls lie where it began or where it ended; [x0, y0, ...] in m
  fits(places) {
    return Boolean(this.shot) && (layoutIs(places, this.shot.ends) || layoutIs(places, this.shot.start));
  }
}

export function layoutIs(places, layout) {
  return places.length === 2 * layout.length
    && layout.every(([x, y], ball) => places[2 * ball] === x && places[2 * ball + 1] === y);
}
