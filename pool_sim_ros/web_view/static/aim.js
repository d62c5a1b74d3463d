// Aiming: a drag back from the cue ball, the keys, or numbers.

const GAIN = 6; // m/s per metre of drag
const FASTEST = 15; // m/s; the simulator has the last word
const LEAST = 0.05; // m/s; a shorter drag is none
const REACH = 26; // CSS pixels around the cue ball that a finger may miss it by
const FINE = 0.1; // of the motion, in fine mode

const rounded = (value, digits) => Number(value.toFixed(digits));

export class Aim {
  // `view`: canvas, place() of the cue ball or null, geometry(), spins(), onChange(), onShoot(request)
  constructor(view) {
    this.view = view;
    this.direction = 180; // deg from the x axis, as the numbers show it
    this.speed = 3; // m/s; of the cue, where balls spin
    this.given = null; // {velocity, spin} of the ball, where these were given instead
    this.side = this.above = this.elevation = 0; // of the cue, where balls spin
    this.fine = false;
    this.active = false; // whether it is shown
    this.pointer = null;
    const { canvas } = view;
    canvas.addEventListener('pointerdown', (event) => this.grasp(event));
    canvas.addEventListener('pointermove', (event) => this.drag(event));
    canvas.addEventListener('pointerup', (event) => this.release(event));
    canvas.addEventListener('pointercancel', (event) => {
      if (event.pointerId === this.pointer) this.cancel();
    });
  }

  get velocity() {
    if (this.given) return this.given.velocity;
    const angle = (this.direction * Math.PI) / 180;
    // Without the rounding of cos and sin at right angles, which would let a straight shot stray.
    const part = (value) => (Math.abs(value) < 1e-15 ? 0 : value * this.speed);
    return [part(Math.cos(angle)), part(Math.sin(angle))];
  }

  // What the server is asked for.
  get request() {
    if (this.given || !this.view.spins()) {
      const { velocity, spin } = this.given ?? this;
      return spin && this.view.spins() ? { velocity, spin } : { velocity };
    }
    const { speed, direction: azimuth, elevation, side, above } = this;
    return { cue: { speed, azimuth, elevation, side, above } };
  }

  get readout() {
    const { direction, speed, side, above, elevation } = this;
    if (this.given) return this.given.velocity.map((part) => `${part}`).join(', ') + ' m/s';
    const english = this.view.spins() && (side || above)
      ? `  ${Math.abs(side)} ${side < 0 ? 'right' : 'left'} ${Math.abs(above)} ${above < 0 ? 'below' : 'above'}` : '';
    return `${direction}°  ${speed} m/s${english}${elevation ? `  ${elevation}° up` : ''}`;
  }

  grasp(event) {
    const place = this.view.place();
    if (!place || !event.isPrimary || event.button !== 0 || event.defaultPrevented) return;
    const geometry = this.view.geometry();
    const [x, y] = geometry.toScreen(...place);
    const reach = Math.max(REACH, 1.6 * this.view.radius() * geometry.scale);
    if (Math.hypot(event.offsetX - x, event.offsetY - y) > reach) return;
    this.pointer = event.pointerId;
    this.view.canvas.setPointerCapture(event.pointerId);
    this.before = [this.direction, this.speed];
    this.given = null;
    this.last = [event.offsetX, event.offsetY];
    this.pulled = [...this.last]; // where the butt of the cue is
    // In fine mode a drag corrects the aim that is there.
    if (this.fine && this.active) {
      const back = this.speed / GAIN;
      const angle = (this.direction * Math.PI) / 180;
      this.pulled = geometry.toScreen(place[0] - back * Math.cos(angle), place[1] - back * Math.sin(angle));
    } else {
      this.speed = 0;
    }
    this.change();
  }

  drag(event) {
    if (event.pointerId !== this.pointer) return;
    const place = this.view.place();
    if (!place) {
      this.cancel();
      return;
    }
    const gain = this.fine || event.shiftKey ? FINE : 1;
    const now = [event.offsetX, event.offsetY];
    this.pulled = this.pulled.map((part, i) => part + gain * (now[i] - this.last[i]));
    this.last = now;
    const digits = gain < 1 ? 3 : 2;
    const [x, y] = this.view.geometry().toTable(...this.pulled);
    const back = [place[0] - x, place[1] - y];
    this.speed = rounded(Math.min(FASTEST, Math.hypot(...back) * GAIN), digits);
    if (this.speed > 0) this.direction = canonical(rounded((Math.atan2(back[1], back[0]) * 180) / Math.PI, digits));
    this.change();
  }

  release(event) {
    if (event.pointerId !== this.pointer) return;
    this.drag(event);
    if (this.pointer === null) return;
    this.pointer = null;
    if (this.speed < LEAST) this.cancel();
    else if (this.fine) this.change(); // a fine aim is shot by the button
    else this.shoot();
  }

  cancel() {
    if (this.pointer !== null || this.speed < LEAST) [this.direction, this.speed] = this.before ?? [180, 3];
    this.pointer = null;
    this.active = false;
    this.view.onChange();
  }

  turn(degrees) {
    this.step({ direction: rounded(this.direction + degrees, 6) });
  }

  strengthen(speed) {
    this.step({ speed: rounded(Math.min(FASTEST, Math.max(0.01, this.speed + speed)), 6) });
  }

  step(change) {
    if (this.view.place()) this.set(change);
  }

  // Take numbers as they are given: direction, speed, side, above, elevation; or velocity and spin.
  set({ velocity, spin, ...cue }) {
    this.given = velocity ? { velocity, spin } : null;
    Object.assign(this, cue);
    if (velocity) {
      this.speed = rounded(Math.hypot(...velocity), 6);
      this.direction = rounded((Math.atan2(velocity[1], velocity[0]) * 180) / Math.PI, 6);
    }
    this.direction = canonical(this.direction);
    this.change();
  }

  shoot() {
    if (!this.view.place()) return;
    this.active = false;
    this.view.onShoot(this.request);
    this.view.onChange();
  }

  change() {
    this.active = Boolean(this.view.place());
    this.view.onChange();
  }
}

// -180 and 180 are one direction; what is in between stays digit for digit.
function canonical(degrees) {
  if (degrees > -180 && degrees <= 180) return degrees;
  const turned = rounded(degrees - 360 * Math.ceil((degrees - 180) / 360), 9);
  return turned === -180 ? 180 : turned;
}
