// Help me: the shots most likely to bring a ball somewhere. The server seeks them.

import { canPlay, page } from './page.js';
import { $, say } from './panel.js';
import { layoutIs } from './strike.js';
import { readNumber } from './units.js';

const WITHIN = 0.1; // m from the place that is near enough

const percent = (part) => (100 * part).toFixed(0);

export class Help {
  // `send(command)` returns nothing; `onChange()`
  constructor({ canvas, send, onChange }) {
    Object.assign(this, { canvas, send, onChange });
    this.target = null; // the place that is drawn: {x, y, within}
    this.answer = null; // of the server
    this.searching = false;
    canvas.addEventListener('pointerdown', (event) => this.pick(event));
    $('pick').addEventListener('click', () => this.takeClick(!this.takesClick));
    $('help').addEventListener('click', () => this.ask());
    $('help-where').addEventListener('change', () => this.choose());
    for (const axis of ['x', 'y']) $(`help-${axis}`).addEventListener('change', () => this.draw());
  }

  // Offer the balls and pockets of a table.
  offer(table, words) {
    const balls = table.balls.slice(1).map(({ label }) => new Option(label, label));
    $('help-ball').replaceChildren(...balls, new Option(`${table.balls[0].label}, the cue ball`, ''));
    const pockets = table.pockets.map((_, number) => new Option(words.pocket(number), String(number)));
    $('help-where').replaceChildren(
      ...(pockets.length ? [new Option('any pocket', 'any'), ...pockets] : []), new Option('a place', 'place'),
    );
    this.units = page.units;
    [$('help-x').value, $('help-y').value] = [0.25 * table.length, 0.5 * table.width].map((part) => page.units.number(part));
    this.forget('');
    this.choose();
  }

  choose() {
    $('help-place').hidden = $('help-where').value !== 'place';
    this.takeClick(false);
    this.draw();
  }

  takeClick(takes) {
    this.takesClick = takes;
    $('pick').setAttribute('aria-pressed', String(takes));
    if (takes) this.canvas.scrollIntoView({ block: 'nearest' }); // it may be above the window
  }

  pick(event) {
    if (!this.takesClick || !event.isPrimary || event.button !== 0) return;
    event.preventDefault(); // so that nobody aims
    event.stopImmediatePropagation();
    const { length, width } = page.table;
    const [x, y] = page.painter.geometry.toTable(event.offsetX, event.offsetY);
    $('help-x').value = page.units.number(Math.min(length, Math.max(0, x)));
    $('help-y').value = page.units.number(Math.min(width, Math.max(0, y)));
    this.takeClick(false);
    this.draw();
  }

  // The place that is asked for; throws an Error that says what is wrong with the numbers.
  place() {
    const [x, y] = ['x', 'y'].map((axis) => readNumber($(`help-${axis}`).value, axis) * page.units.size);
    return { x, y, within: WITHIN };
  }

  draw() {
    this.target = null;
    if (this.active && $('help-where').value === 'place') {
      try {
        this.target = this.place();
      } catch { /* it is told when somebody asks */ }
    }
    this.onChange();
  }

  // Whether somebody uses this: then the place is drawn.
  get active() {
    return this.searching || this.answer || $('helping').contains(document.activeElement);
  }

  goal() {
    const [ball, where] = [$('help-ball').value, $('help-where').value];
    if (where !== 'place') {
      if (!ball) throw new Error('The cue ball is to stay out of the pockets.');
      const goal = { ball, pocket: where === 'any' ? where : Number(where) };
      return { all: [goal, { keep: page.table.balls[0].label }] };
    }
    const { x, y, within } = this.place();
    return ball ? { ball, to: [x, y], within } : { cue_to: [x, y], within };
  }

  ask() {
    if (!canPlay()) return;
    try {
      const goal = this.goal();
      this.forget('Seeking a shot …');
      this.searching = true;
      this.draw();
      this.send({ do: 'help', goal });
    } catch (error) {
      this.forget(error.message);
    }
    this.enable();
  }

  take(answer) {
    this.searching = false;
    this.answer = answer;
    if (answer) {
      const { shots, played } = answer;
      say('help-words', shots.length ? '' : `No shot was found among ${played.toLocaleString('en')}.`);
      $('helped').replaceChildren(...shots.map((shot) => this.row(shot)));
    } else {
      this.forget('');
    }
    this.draw();
    this.enable();
  }

  row({ strike, chance, low, high, speed, azimuth }) {
    const line = document.createElement('li');
    const show = document.createElement('button');
    show.textContent = `${percent(chance)} %`;
    show.title = 'Show where the balls would go';
    show.addEventListener('click', () => this.show(strike));
    const words = document.createElement('span');
    words.textContent = `${percent(low)} to ${percent(high)} %, ${speed.toFixed(2)} m/s at ${azimuth.toFixed(1)}°`;
    const play = document.createElement('button');
    play.textContent = 'Play';
    play.addEventListener('click', () => canPlay() && this.send({ do: 'strike', ...strike }));
    line.append(show, words, play);
    return line;
  }

  show({ velocity, cue }) {
    if (!cue) return page.aim.set({ velocity });
    const { azimuth: direction, ...others } = cue;
    return page.aim.set({ direction, ...others });
  }

  forget(words) {
    this.answer = null;
    say('help-words', words);
    $('helped').replaceChildren();
  }

  // An answer stands beside no layout but its own.
  look(places) {
    if (this.answer && !layoutIs(places, this.answer.positions)) {
      this.forget('');
      this.draw();
    }
  }

  // The server could not do it, or is gone.
  fail() {
    if (!this.searching) return;
    this.searching = false;
    this.forget('');
    this.draw();
    this.enable();
  }

  enable() {
    $('help').disabled = this.searching || !canPlay();
  }
}
