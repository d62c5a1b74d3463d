// The page: what arrives from the server, what the user does, and one picture per frame.

import { Aim } from './aim.js';
import { Connection } from './connection.js';
import { Painter, isOver } from './painter.js';
import {
  $, addCollisions, say, showNotice, showProblem, showReadings, showResult, showState,
} from './panel.js';
import { Timeline } from './timeline.js';

const ADVICE_TIME = 6000; // ms
const COMPUTE_TIME = 1000; // ms; a compiled shot takes less
const seconds = () => performance.now() / 1000;

const canvas = $('table');
const painter = new Painter(canvas);
const timeline = new Timeline();

// What is known now. Tests look at it too.
const page = {
  connected: false, simulator: null, state: null, table: null, places: null,
  flashes: [], prediction: null, struck: null, played: null, drawn: 0, painter, timeline,
  compiling: false, waits: false,
};
window.page = page;

const canPlay = () => Boolean(page.connected && page.state && page.table && page.places)
  && !page.state.moving && !page.state.computing;

const aim = new Aim({
  canvas,
  geometry: () => painter.geometry,
  radius: () => page.table.balls[0].radius,
  place: () => (canPlay() ? [page.places[0], page.places[1]] : null),
  onChange: () => { showAim(); askForPrediction(); page.dirty = true; },
  onShoot: (velocity) => {
    page.struck = velocity;
    page.played = null;
    if (sameVelocity(page.prediction, velocity)) page.played = page.prediction;
    else send({ do: 'aim', velocity });
    send({ do: 'strike', velocity });
  },
});
page.aim = aim;

const sameVelocity = (prediction, velocity) => Boolean(prediction)
  && prediction.velocity[0] === velocity[0] && prediction.velocity[1] === velocity[1];

const connection = new Connection({
  onOpen(open) {
    page.connected = open;
    asked = null;
    if (!open) {
      page.state = null;
      page.compiling = false;
      timeline.clear();
    }
    showLink();
  },
  onFrame(numbers) {
    timeline.add(numbers[0], Array.from(numbers.subarray(1)), seconds());
  },
  onText(kind, content) {
    heard[kind]?.(content);
  },
});

const heard = {
  simulator(simulator) {
    page.simulator = simulator;
    if (simulator.problem) {
      page.state = null;
      timeline.clear();
      showResult(null);
    }
    showLink();
  },
  state(state) {
    const rested = page.state?.moving && !state.moving;
    page.state = state;
    watchComputing();
    if (rested) page.played = page.struck = page.prediction = null;
    if (!canPlay() && aim.active) aim.cancel();
    if (!page.prediction) askForPrediction(); // there was nothing to predict from before
    showLink();
  },
  table(table) {
    page.table = table;
    layOut();
  },
  collisions(rows) {
    for (const [, t, kind, a, b, x, y, nx, ny, speed] of rows) {
      page.flashes.push({ stamp: t, x, y, speed });
      const { balls } = page.table;
      timeline.addCorner(a, t, x - nx * balls[a].radius, y - ny * balls[a].radius);
      if (kind === 0) timeline.addCorner(b, t, x + nx * balls[b].radius, y + ny * balls[b].radius);
    }
    addCollisions(rows, page.table.balls);
  },
  response({ phase, code, reason }) {
    if (phase === 'rejected' || (phase === 'preempted' && code !== 'RESET')) advise(`${phase}: ${reason}`);
    if (phase === 'preempted') page.played = null;
  },
  result: (result) => showResult(result, page.table?.balls),
  problem: advise,
  predicts: askForPrediction, // from now on
  compiling(compiling) {
    page.compiling = compiling;
    showLink();
  },
  prediction(prediction) {
    const answered = asked && sameVelocity({ velocity: asked }, aim.velocity);
    asked = null;
    page.prediction = prediction;
    page.dirty = true;
    if (!aim.active && page.struck && sameVelocity(prediction, page.struck)) page.played = prediction;
    if (aim.active && !answered) askForPrediction();
  },
};

let asked = null; // the velocity that a prediction was asked for and has not come
let dismissal = 0;
let patience = 0;

function send(command) {
  if (!connection.send(command)) advise('The page is not connected to its server.');
}

function askForPrediction() {
  if (!aim.active || asked || !page.connected) return;
  asked = aim.velocity;
  connection.send({ do: 'aim', velocity: asked });
}

function advise(text) {
  say('advice', text);
  clearTimeout(dismissal);
  dismissal = setTimeout(() => say('advice', ''), ADVICE_TIME);
  asked = null;
}

// A shot that is computed for long probably waits until the simulator has compiled its physics.
function watchComputing() {
  if (page.state?.computing) {
    patience ||= setTimeout(() => { page.waits = true; showLink(); }, COMPUTE_TIME);
    return;
  }
  clearTimeout(patience);
  patience = 0;
  page.waits = false;
}

function notice() {
  const compiled = 'the physics is compiled; this takes about 15 s, on the first run only.';
  if (page.state.computing && page.compiling) return `Your shot waits until ${compiled}`;
  if (page.compiling) return `Shots, and the paths while you aim, wait until ${compiled}`;
  if (page.waits) return 'The shot is being computed. The first one waits until the physics is compiled.';
  return null;
}

function showAim() {
  if (document.activeElement !== $('direction')) $('direction').value = aim.direction.toFixed(1);
  if (document.activeElement !== $('strength')) $('strength').value = aim.speed.toFixed(2);
}

function showLink() {
  const { connected, simulator, state } = page;
  const lost = connected ? simulator?.problem : 'The page has lost its server, and keeps trying to reach it.';
  showProblem(lost);
  showState(state, lost, page.compiling);
  showNotice(connected && state && !lost ? notice() : null);
  say('simulator', simulator?.name ?? '');
  const usable = Boolean(connected && state);
  for (const button of document.querySelectorAll('button')) button.disabled = !usable;
  $('speed').disabled = !usable;
  if (!usable) return;
  $('shoot').disabled = !canPlay();
  for (const button of $('shots').querySelectorAll('button')) button.disabled = !canPlay();
  $('step').disabled = !state.paused;
  $('pause').textContent = state.paused ? 'Resume' : 'Pause';
  $('pause').setAttribute('aria-pressed', String(state.paused));
  showSpeed(state.real_time_factor);
}

function showSpeed(factor) {
  const select = $('speed');
  if (![...select.options].some((option) => Number(option.value) === factor)) {
    select.add(new Option(`${factor} ×`, String(factor)));
  }
  if (document.activeElement !== select) select.value = String(factor);
}

function layOut() {
  if (!page.table) return;
  const width = canvas.parentElement.clientWidth;
  const height = Math.max(260, window.innerHeight * (width < 600 ? 0.56 : 0.66));
  painter.fit(page.table, width, height);
  page.dirty = true;
}

const play = {
  shot: (number) => { page.played = null; send({ do: 'shot', number }); },
  pause: () => send({ do: 'pause', paused: !page.state?.paused }),
  step: () => send({ do: 'step' }),
  reset: () => { page.played = null; send({ do: 'reset' }); },
  shoot: () => (canPlay() ? aim.shoot() : advise('Wait until the balls are at rest.')),
};

for (const button of $('shots').querySelectorAll('button')) {
  button.addEventListener('click', () => play.shot(Number(button.dataset.shot)));
}
for (const name of ['pause', 'step', 'reset', 'shoot']) $(name).addEventListener('click', play[name]);
$('speed').addEventListener('change', () => send({ do: 'speed', factor: Number($('speed').value) }));
for (const id of ['direction', 'strength']) {
  $(id).addEventListener('input', () => {
    aim.set($('direction').valueAsNumber, $('strength').valueAsNumber);
  });
}

document.addEventListener('keydown', (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const inField = event.target.matches('input, select');
  const onButton = event.target.matches('button');
  const fine = event.shiftKey;
  const keys = {
    ArrowLeft: () => aim.turn(fine ? 0.1 : 1),
    ArrowRight: () => aim.turn(fine ? -0.1 : -1),
    ArrowUp: () => aim.strengthen(fine ? 0.01 : 0.1),
    ArrowDown: () => aim.strengthen(fine ? -0.01 : -0.1),
    Escape: () => aim.cancel(),
    Enter: play.shoot,
    ' ': play.pause,
    s: play.step,
    r: play.reset,
    1: () => play.shot(1), 2: () => play.shot(2), 3: () => play.shot(3), 4: () => play.shot(4),
  };
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  if (!keys[key] || (onButton && (key === 'Enter' || key === ' '))) return;
  if (inField && !(key === 'Escape' || (key === 'Enter' && event.target.matches('input')))) return;
  event.preventDefault();
  // So that Enter shoots, and does not press the button that was used last.
  if (key.startsWith('Arrow')) canvas.focus({ preventScroll: true });
  keys[key]();
});

window.addEventListener('resize', layOut);

function draw() {
  requestAnimationFrame(draw);
  if (!page.table || !timeline.newest) return;
  timeline.advance(seconds());
  const places = timeline.places();
  if (places.length !== 2 * page.table.balls.length) return;
  const { flashes } = page;
  while (flashes.length && isOver(flashes[0], timeline.time)) flashes.shift();
  showReadings(timeline.time, timeline.speeds());
  const still = page.places?.length === places.length
    && places.every((place, i) => place === page.places[i]);
  page.places = places;
  if (canPlay() === $('shoot').disabled) showLink();
  if (still && !flashes.length && !page.dirty) return;
  page.dirty = aim.active;
  const shown = aim.active ? page.prediction : page.played;
  painter.draw({
    places, flashes, time: timeline.time, aim: aim.active ? aim : null, paths: shown?.paths ?? null,
  });
  page.drawn += 1;
}
requestAnimationFrame(draw);
showAim();
