// Ball in hand: drag a ball to where it shall lie, or type its position.

import { $, say } from './panel.js';
import { readNumber } from './units.js';

const REACH = 6; // CSS pixels by which a pointer may miss a ball
const TOUCH = 1e-9; // m by which balls may overlap

export class Hand {
  // `view`: canvas, geometry(), table(), places() or null, units, onPlace(ball, x, y), onChange(),
  // advise(text), sunk()
  constructor(view) {
    this.view = view;
    this.held = null; // {ball, x, y, free}
    this.takesCue = false;
    this.shown = {}; // axis -> {text, value}: the text in its field, and the exact place
    const { canvas } = view;
    canvas.addEventListener('pointerdown', (event) => this.take(event));
    canvas.addEventListener('pointermove', (event) => this.move(event));
    canvas.addEventListener('pointerup', (event) => this.drop(event));
    canvas.addEventListener('pointercancel', () => this.letGo());
    $('take').addEventListener('click', () => this.takeCue(!this.takesCue));
    $('ball').addEventListener('change', () => this.show(true));
    $('place').addEventListener('click', () => this.type());
  }

  takeCue(takes) {
    this.takesCue = takes;
    $('take').setAttribute('aria-pressed', String(takes));
    this.view.canvas.classList.toggle('hand', takes);
    if (takes) this.view.canvas.scrollIntoView({ block: 'nearest' }); // it may be above the window
  }

  take(event) {
    const places = this.view.places();
    if (!places || !event.isPrimary || event.button !== 0) return;
    const geometry = this.view.geometry();
    const { balls } = this.view.table();
    const off = ({ radius }, ball) => {
      const [x, y] = geometry.toScreen(places[2 * ball], places[2 * ball + 1]);
      return Math.hypot(event.offsetX - x, event.offsetY - y) - radius * geometry.scale;
    };
    const sunk = this.view.sunk();
    const near = balls.map((ball, i) => ({ i, off: off(ball, i) }))
      .filter(({ i, off: way }) => way < REACH && (i > 0 || this.takesCue || sunk?.[0]))
      .sort((one, other) => one.off - other.off)[0];
    if (!near) return;
    event.preventDefault(); // so that nobody aims
    this.pointer = event.pointerId;
    this.view.canvas.setPointerCapture(event.pointerId);
    const ball = near.i;
    const [x, y] = geometry.toScreen(places[2 * ball], places[2 * ball + 1]);
    this.from = [event.offsetX, event.offsetY];
    this.offset = [x - event.offsetX, y - event.offsetY];
    this.held = { ball, x: places[2 * ball], y: places[2 * ball + 1], free: true };
    $('ball').value = String(ball);
    this.show(true);
    this.view.onChange();
  }

  move(event) {
    if (event.pointerId !== this.pointer || !this.held) return;
    const point = [event.offsetX + this.offset[0], event.offsetY + this.offset[1]];
    const [x, y] = this.view.geometry().toTable(...point).map((part) => Number(part.toFixed(4)));
    const { ball } = this.held;
    const fault = this.fault(ball, x, y);
    this.held = { ball, x, y, free: !fault };
    this.moved = Math.hypot(event.offsetX - this.from[0], event.offsetY - this.from[1]) > 3;
    this.view.advise(fault ?? '');
    this.show(true);
    this.view.onChange();
  }

  drop(event) {
    if (event.pointerId !== this.pointer || !this.held) return;
    this.move(event);
    const { ball, x, y, free } = this.held;
    this.letGo();
    if (!this.moved) return;
    if (free) this.view.onPlace(ball, x, y);
    else this.view.advise(`${this.fault(ball, x, y)}; it stays where it was`);
  }

  letGo() {
    this.held = this.pointer = null;
    this.view.onChange();
  }

  // Why a ball cannot lie there, as far as the page knows; the simulator has the last word.
  fault(ball, x, y) {
    const { balls, length, width, cushions } = this.view.table();
    const places = this.view.places();
    const { label, radius } = balls[ball];
    if (!places) return 'the balls move';
    const sunk = this.view.sunk();
    for (const [i, other] of balls.entries()) {
      if (i === ball || sunk?.[i]) continue;
      const apart = Math.hypot(places[2 * i] - x, places[2 * i + 1] - y);
      if (apart < radius + other.radius - TOUCH) return `${label} cannot lie there: ${other.label} is in the way`;
    }
    const least = cushions ? 0 : radius - TOUCH;
    const inside = x >= least && x <= length - least && y >= least && y <= width - least;
    return inside ? null : `${label} cannot lie there: the cushion is in the way`;
  }

  type() {
    const { units } = this.view;
    const ball = Number($('ball').value);
    try {
      const [x, y] = ['x', 'y'].map((axis) => {
        const text = $(`place-${axis}`).value;
        const shown = this.shown[axis];
        return shown && text === shown.text ? shown.value : readNumber(text, axis) * units.size;
      });
      const fault = this.fault(ball, x, y);
      if (fault) throw new Error(fault);
      say('place-refusal', '');
      this.shown = {};
      this.view.onPlace(ball, x, y);
    } catch (error) {
      say('place-refusal', error.message);
    }
  }

  // Show where the chosen ball is, but for what somebody has typed, unless this is to go.
  show(anew = false) {
    const [places, ball] = [this.view.places(), Number($('ball').value)];
    if (!places || !(2 * ball < places.length)) return;
    const { units } = this.view;
    const at = this.held?.ball === ball ? [this.held.x, this.held.y] : places.slice(2 * ball, 2 * ball + 2);
    ['x', 'y'].forEach((axis, i) => {
      const field = $(`place-${axis}`);
      const typed = this.shown[axis] && field.value !== this.shown[axis].text;
      if (!anew && (typed || document.activeElement === field)) return;
      field.value = units.number(at[i]);
      this.shown[axis] = { text: field.value, value: at[i] };
    });
  }
}
