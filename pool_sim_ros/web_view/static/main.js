// The parts of the page, and what they tell one another.

import { followLink, listenToButtons, play, send } from './actions.js';
import { Aim } from './aim.js';
import { AimForm } from './aim_form.js';
import { Connection } from './connection.js';
import { Hand } from './hand.js';
import { Help } from './help.js';
import { listenToKeys } from './keys.js';
import { canPlay, canStrike, page, spins } from './page.js';
import { $, announce, resultWords, say } from './panel.js';
import { Replay } from './replay.js';
import { layOut, start } from './scene.js';
import { advise, showStatus, watchComputing } from './status.js';
import { Trajectory } from './trajectory.js';

const POSE = 7; // numbers of a ball that turns: x, y, z and a quaternion

const { canvas, painter, timeline, units } = page;
let asked = null; // what a prediction was asked for and has not come, as JSON

// Before the hand: who picks a place takes no ball.
const help = page.help = new Help({ canvas, send, onChange: () => { page.dirty = true; } });
// Before the aim: who takes a ball in hand does not aim.
const hand = page.hand = new Hand({
  canvas,
  geometry: () => painter.geometry,
  table: () => page.table,
  places: () => (canPlay() ? page.places : null),
  sunk: () => page.sunk,
  units,
  advise,
  onPlace: (ball, x, y) => send({ do: 'place', places: { [page.table.balls[ball].label]: [x, y] } }),
  onChange() {
    replay.live();
    page.dirty = true;
  },
});
const aim = page.aim = new Aim({
  canvas,
  geometry: () => painter.geometry,
  radius: () => page.table.balls[0].radius,
  place: () => (canStrike() ? [page.places[0], page.places[1]] : null),
  spins,
  onChange() {
    if (aim.active) {
      replay.live();
      announce('aim', `Aim ${aim.readout}`);
    }
    form.show();
    askForPrediction();
    page.dirty = true;
  },
  onShoot: (request) => send({ do: 'strike', ...request }),
});
const replay = page.replay = new Replay({
  shot: () => page.strike.shot,
  live: () => page.strike.since(timeline.time),
  onChange() {
    if (replay.time !== null && aim.active) aim.cancel();
    page.dirty = true;
  },
  onUndo: () => play.undo(),
});
const form = page.form = new AimForm(aim, () => (aim.active ? page.prediction : null));

const heard = {
  simulator(simulator) {
    page.simulator = simulator;
    if (simulator.problem) {
      page.state = page.result = null;
      page.unfit = true;
      timeline.clear();
    }
    showStatus();
  },
  state(state) {
    page.state = state;
    page.unfit = true;
    watchComputing();
    if (state.moving || state.computing) replay.live();
    if (!canPlay() && aim.active) aim.cancel();
    if (!canPlay() && hand.held) hand.letGo();
    if (!page.prediction) askForPrediction(); // there was nothing to predict from before
    showStatus();
  },
  table(table) {
    page.table = table;
    page.result = page.prediction = null;
    timeline.clear();
    $('shots').hidden = !table.is_report;
    $('english').hidden = $('pocket-reading').hidden = !spins();
    $('ball').replaceChildren(...table.balls.map(({ label }, i) => new Option(label, String(i))));
    layOut();
    help.offer(table, page.words);
  },
  collisions(rows) {
    const { balls } = page.table;
    page.strike.contact(rows[0]?.[1]);
    for (const [, t, kind, a, b, x, y, nx, ny, speed] of rows) {
      page.flashes.push({ stamp: t, x, y, speed });
      timeline.addCorner(a, t, x - nx * balls[a].radius, y - ny * balls[a].radius);
      if (kind === 0) timeline.addCorner(b, t, x + nx * balls[b].radius, y + ny * balls[b].radius);
    }
  },
  response({ phase, code, reason, velocity }) {
    if (phase === 'rejected' || (phase === 'preempted' && code !== 'RESET')) advise(`${phase}: ${reason}`);
    if (phase !== 'accepted' || !velocity) return; // what is placed is no shot
    page.strike.begin();
    page.result = null;
    page.unfit = true;
    replay.live();
  },
  strike(fields) {
    page.strike.take(fields && new Trajectory(fields, page.table, spins() ? page.turns : null), page.table);
    if (page.result) page.strike.finish(page.result);
    page.dirty = page.unfit = true;
    replay.live();
    say('reason', fields?.exact?.reason ?? '');
  },
  result(result) {
    page.result = result;
    page.strike.finish(result);
    page.dirty = page.unfit = true;
    if (page.words) announce('result', resultWords(result, page.table, page.words));
  },
  help: (answer) => help.take(answer),
  problem(text) {
    asked = null;
    help.fail();
    advise(text);
  },
  predicts: () => askForPrediction(), // from now on
  compiling(compiling) {
    page.compiling = compiling;
    showStatus();
  },
  prediction(prediction) {
    const answered = asked === JSON.stringify(aim.request);
    asked = null;
    page.prediction = prediction && { ...prediction, paths: new Trajectory(prediction, page.table).paths() };
    page.dirty = true;
    form.show();
    if (aim.active && !answered) askForPrediction();
  },
};

function askForPrediction() {
  if (!aim.active || asked || !page.connected) return;
  asked = JSON.stringify(aim.request);
  page.connection.send({ do: 'aim', ...aim.request });
}

function onFrame(numbers) {
  const now = performance.now() / 1000;
  if (!spins()) {
    timeline.add(numbers[0], Array.from(numbers.subarray(1)), now);
  } else {
    const [places, turns, sunk] = [[], [], []];
    for (let at = 1; at < numbers.length; at += POSE) {
      places.push(numbers[at], numbers[at + 1]);
      turns.push(Array.from(numbers.subarray(at + 3, at + POSE)));
      sunk.push(numbers[at + 2] < 0);
    }
    timeline.add(numbers[0], places, now, turns, sunk);
  }
  followLink();
}

page.connection = new Connection({
  onOpen(open) {
    page.connected = open;
    asked = null;
    if (!open) {
      help.fail();
      page.state = null;
      page.compiling = false;
      timeline.clear();
    }
    showStatus();
  },
  onFrame,
  onText(kind, content) {
    heard[kind]?.(content);
  },
});

listenToKeys({ play, aim, form, replay, canvas });
listenToButtons();
form.show();
start();
