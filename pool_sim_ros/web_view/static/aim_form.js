// The numbers of the aim, and the target on the ball.

import { $, say } from './panel.js';
import { readNumber } from './units.js';

const OFFSET = 0.5; // radii; farther out the tip slips off
const FIELDS = {
  direction: ['angle', -Infinity, Infinity],
  strength: ['speed', 0, Infinity],
  vx: ['vx', -Infinity, Infinity],
  vy: ['vy', -Infinity, Infinity],
  side: ['side', -OFFSET, OFFSET],
  above: ['above', -OFFSET, OFFSET],
  elevation: ['elevation', 0, 90],
};

export class AimForm {
  constructor(aim, prediction) {
    Object.assign(this, { aim, prediction });
    for (const id of Object.keys(FIELDS)) {
      $(id).addEventListener('input', () => this.read(id));
      $(id).addEventListener('blur', () => this.show());
    }
    $('fine').addEventListener('click', () => this.beFine(!aim.fine));
    const target = $('target');
    target.addEventListener('pointerdown', (event) => {
      target.setPointerCapture(event.pointerId);
      this.hit(event);
    });
    target.addEventListener('pointermove', (event) => {
      if (target.hasPointerCapture(event.pointerId)) this.hit(event);
    });
    target.addEventListener('keydown', (event) => this.nudge(event));
    $('center').addEventListener('click', () => aim.set({ side: 0, above: 0, elevation: 0 }));
  }

  beFine(fine) {
    this.aim.fine = fine;
    $('fine').setAttribute('aria-pressed', String(fine));
  }

  // Take what is typed into a field; say why not, and change nothing, where it makes no sense.
  read(id) {
    try {
      const number = (name) => readNumber($(name).value, ...FIELDS[name]);
      const value = number(id);
      if (id === 'strength' && value === 0) throw new Error('speed: it must be above 0 m/s');
      this.refuse(null, null);
      if (id === 'vx' || id === 'vy') {
        const velocity = [number('vx'), number('vy')];
        if (!velocity[0] && !velocity[1]) throw new Error('vx, vy: both are 0; the ball would not move');
        this.aim.set({ velocity, spin: this.aim.given?.spin });
      } else if (id === 'side' || id === 'above') {
        const [side, above] = [number('side'), number('above')];
        if (Math.hypot(side, above) > OFFSET) {
          throw new Error(`side, above: more than ${OFFSET} radii from the middle the tip slips off`);
        }
        this.aim.set({ side, above });
      } else {
        this.aim.set({ [{ strength: 'speed' }[id] ?? id]: value });
      }
    } catch (error) {
      this.refuse(error.message, id);
    }
  }

  refuse(words, id) {
    say('refusal', words ?? '');
    for (const name of Object.keys(FIELDS)) {
      if (name === id) $(name).setAttribute('aria-invalid', 'true');
      else $(name).removeAttribute('aria-invalid');
    }
    this.refused = Boolean(words);
  }

  hit(event) {
    const box = $('target').getBoundingClientRect();
    const [x, y] = [box.left + box.width / 2, box.top + box.height / 2];
    const radius = box.width / $('target').viewBox.baseVal.width;
    this.aimAt((x - event.clientX) / radius, (y - event.clientY) / radius);
  }

  nudge(event) {
    const step = this.aim.fine || event.shiftKey ? 0.01 : 0.05;
    const { side, above } = this.aim;
    const way = {
      ArrowLeft: [step, 0], ArrowRight: [-step, 0], ArrowUp: [0, step], ArrowDown: [0, -step],
    }[event.key];
    if (!way) return;
    event.preventDefault();
    event.stopPropagation();
    this.aimAt(side + way[0], above + way[1]);
  }

  aimAt(side, above) {
    const far = Math.hypot(side, above);
    const part = far > OFFSET ? (OFFSET - 1e-3) / far : 1;
    const number = (value) => Number((value * part).toFixed(far > OFFSET ? 3 : 2)) || 0;
    this.aim.set({ side: number(side), above: number(above) });
  }

  // Show the numbers as they are used, but for what somebody is typing.
  show() {
    const { aim } = this;
    const spins = aim.view.spins();
    // Where balls spin, what the ball gets of the cue is predicted.
    const ball = aim.given || !spins ? aim.velocity : this.prediction()?.velocity;
    const values = {
      direction: aim.direction, strength: aim.speed, side: aim.side, above: aim.above,
      elevation: aim.elevation, vx: ball?.[0], vy: ball?.[1],
    };
    for (const [id, value] of Object.entries(values)) {
      const kept = document.activeElement === $(id) || value === undefined;
      const exact = aim.given || !id.startsWith('v');
      if (!kept) $(id).value = exact ? String(value) : String(Number(value.toFixed(4)));
    }
    if (!this.refused || !Object.keys(FIELDS).includes(document.activeElement?.id)) this.refuse(null, null);
    $('tip').setAttribute('cx', String(-aim.side));
    $('tip').setAttribute('cy', String(-aim.above));
    $('tip').setAttribute('opacity', aim.given ? '0.25' : '1');
    $('target').setAttribute('aria-label', `Where the tip hits the ball: side ${aim.side}, above ${aim.above} radii`);
  }
}
