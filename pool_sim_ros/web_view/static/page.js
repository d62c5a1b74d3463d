// What the page knows now. Tests look at it too.

import { Painter } from './painter.js';
import { $ } from './panel.js';
import { Strike } from './strike.js';
import { Timeline } from './timeline.js';
import { Units } from './units.js';

export const page = {
  canvas: $('table'), painter: new Painter($('table')), timeline: new Timeline(), units: new Units(),
  connected: false, simulator: null, state: null, table: null, compiling: false, waits: false,
  places: null, turns: null, sunk: null, // of the balls as they are now
  shown: null, // the places in the picture, of now or of a time that is replayed
  words: null, flashes: [], prediction: null, strike: new Strike(), result: null, drawn: 0, dirty: true,
  aim: null, form: null, hand: null, help: null, replay: null, connection: null, // made in main.js
};
window.page = page;

export const spins = () => page.table?.motion === 'ball';

export const canPlay = () => Boolean(page.connected && page.state && page.table && page.places)
  && !page.state.moving && !page.state.computing;

export const canStrike = () => canPlay() && !page.sunk?.[0];
