// The bar: what the latest shot did, at any time of it, at any speed, frame by frame.

import { $, say } from './panel.js';

const FRAME = 1 / 60; // s

export class Replay {
  // `view`: shot() or null, live() time since the strike, onChange(), onUndo()
  constructor(view) {
    this.view = view;
    this.time = null; // s since the strike; null: the picture is live
    this.playing = false;
    $('replay').addEventListener('click', () => this.play(!this.playing));
    $('back').addEventListener('click', () => this.step(-1));
    $('forward').addEventListener('click', () => this.step(1));
    $('undo').addEventListener('click', () => view.onUndo());
    $('bar').addEventListener('input', () => {
      this.playing = false;
      this.seek(Number($('bar').value) * FRAME);
    });
  }

  get shot() {
    return this.view.shot();
  }

  live() {
    this.time = null;
    this.playing = false;
    this.show();
  }

  play(playing) {
    if (!this.shot) return;
    this.playing = playing;
    if (playing && (this.time === null || this.time >= this.shot.duration)) this.time = 0;
    this.view.onChange();
    this.show();
  }

  step(frames) {
    if (!this.shot) return;
    this.playing = false;
    const now = this.time ?? this.shot.duration;
    // From the end back to the last whole frame before it.
    const frame = frames < 0 ? Math.ceil(now / FRAME - 1e-6) : Math.floor(now / FRAME + 1e-6);
    this.seek((frame + frames) * FRAME);
  }

  seek(time) {
    if (!this.shot) return;
    this.time = Math.max(0, Math.min(this.shot.duration, time));
    this.view.onChange();
    this.show();
  }

  // Go on by so many seconds of wall time.
  advance(elapsed) {
    if (!this.playing || !this.shot) return;
    const time = this.time + elapsed * Number($('replay-speed').value);
    if (time >= this.shot.duration) this.playing = false;
    this.time = Math.min(time, this.shot.duration);
    this.view.onChange();
    this.show();
  }

  // Show the bar at the time of the picture.
  show() {
    const { shot } = this;
    $('history').disabled = !shot;
    if (!shot) return say('when', '–');
    const time = Math.max(0, Math.min(shot.duration, this.time ?? this.view.live() ?? shot.duration));
    const bar = $('bar');
    const frames = Math.ceil(shot.duration / FRAME);
    if (bar.max !== String(frames)) bar.max = String(frames);
    const frame = time === shot.duration ? frames : Math.round(time / FRAME);
    if (bar.value !== String(frame)) bar.value = String(frame);
    const words = `${time.toFixed(3)} of ${shot.duration.toFixed(3)} s`;
    if (bar.getAttribute('aria-valuetext') !== words) bar.setAttribute('aria-valuetext', words);
    say('when', words);
    say('replay', this.playing ? 'Stop' : 'Replay');
    return undefined;
  }
}
