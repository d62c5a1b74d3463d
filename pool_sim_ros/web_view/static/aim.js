// Aiming: a drag back from the cue ball, the keys, or the two numbers.

const GAIN = 6; // m/s per metre of drag
const FASTEST = 15; // m/s; the simulator has the last word
const LEAST = 0.05; // m/s; a shorter drag is none
const REACH = 26; // CSS pixels around the cue ball that a finger may miss it by

export class Aim {
  // `view`: canvas, place() of the cue ball or null, geometry(), onChange(), onShoot(velocity)
  constructor(view) {
    this.view = view;
    this.direction = 180; // deg from the x axis, as the numbers show it
    this.speed = 3; // m/s
    this.active = false; // whether it is shown
    this.pointer = null;
    const { canvas } = view;
    canvas.addEventListener('pointerdown', (event) => this.grasp(event));
    canvas.addEventListener('pointermove', (event) => this.drag(event));
    canvas.addEventListener('pointerup', (event) => this.release(event));
    canvas.addEventListener('pointercancel', () => this.cancel());
  }

  get velocity() {
    const angle = (this.direction * Math.PI) / 180;
    // Without the rounding of cos and sin at right angles, which would let a straight shot stray.
    const part = (value) => (Math.abs(value) < 1e-15 ? 0 : value * this.speed);
    return [part(Math.cos(angle)), part(Math.sin(angle))];
  }

  grasp(event) {
    const place = this.view.place();
    if (!place || !event.isPrimary || event.button !== 0) return;
    const geometry = this.view.geometry();
    const [x, y] = geometry.toScreen(...place);
    const reach = Math.max(REACH, 1.6 * this.view.radius() * geometry.scale);
    if (Math.hypot(event.offsetX - x, event.offsetY - y) > reach) return;
    this.pointer = event.pointerId;
    this.view.canvas.setPointerCapture(event.pointerId);
    this.before = [this.direction, this.speed];
    this.speed = 0;
    this.change();
  }

  drag(event) {
    if (event.pointerId !== this.pointer) return;
    const place = this.view.place();
    if (!place) {
      this.cancel();
      return;
    }
    const [x, y] = this.view.geometry().toTable(event.offsetX, event.offsetY);
    const back = [place[0] - x, place[1] - y];
    this.speed = Math.min(FASTEST, Math.hypot(...back) * GAIN);
    if (this.speed > 0) this.direction = (Math.atan2(back[1], back[0]) * 180) / Math.PI;
    this.change();
  }

  release(event) {
    if (event.pointerId !== this.pointer) return;
    this.drag(event);
    if (this.pointer === null) return;
    this.pointer = null;
    if (this.speed < LEAST) this.cancel();
    else this.shoot();
  }

  cancel() {
    if (this.pointer !== null || this.speed < LEAST) [this.direction, this.speed] = this.before ?? [180, 3];
    this.pointer = null;
    this.active = false;
    this.view.onChange();
  }

  turn(degrees) {
    this.set(this.direction + degrees, this.speed);
  }

  strengthen(speed) {
    this.set(this.direction, this.speed + speed);
  }

  set(direction, speed) {
    if (!Number.isFinite(direction) || !Number.isFinite(speed) || !this.view.place()) return;
    const turned = ((((direction + 180) % 360) + 360) % 360) - 180;
    this.direction = Math.round(turned * 1000) / 1000;
    this.speed = Math.round(Math.min(FASTEST, Math.max(0.1, speed)) * 1000) / 1000;
    this.change();
  }

  shoot() {
    if (!this.view.place()) return;
    this.active = false;
    this.view.onShoot(this.velocity);
    this.view.onChange();
  }

  change() {
    this.active = true;
    this.view.onChange();
  }
}
