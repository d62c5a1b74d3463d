// One picture per frame: the balls as they are, or as they were at a time of the latest strike.

import { canStrike, page } from './page.js';
import { isOver } from './painter.js';
import { $, showContacts, showReadings, showResult } from './panel.js';
import { showStatus } from './status.js';
import { layoutIs } from './strike.js';
import { Words } from './words.js';

const seconds = () => performance.now() / 1000;
let before = seconds();

// Fit the table into the window.
export function layOut() {
  if (!page.table) return;
  const width = page.canvas.parentElement.clientWidth;
  const flat = window.innerHeight < 500; // a phone on its side
  const height = Math.max(240, window.innerHeight * (flat ? 0.85 : width < 600 ? 0.64 : 0.66));
  page.painter.fit(page.table, width, height, $('axes').checked ? page.units : null);
  page.words = new Words(page.table, page.painter.geometry.upright);
  page.unfit = true;
  page.dirty = true;
}

// Results stand beside no layout but their own.
function showFits(places) {
  const { strike, result, state } = page;
  const ends = result && page.table.balls.map(({ label }) => result.final_positions[label]);
  const fits = ends?.every(Boolean) && layoutIs(places, ends);
  showResult(fits ? result : null, page.table, page.words, page.units);
  $('print').hidden = !(strike.exact && fits);
  page.help.look(places);
  page.standing = strike.fits(places, Boolean(state?.moving || state?.computing));
  if (strike.shot && page.turns && !strike.shot.turns && layoutIs(places, strike.shot.ends)) {
    strike.shot.turnTo(page.turns);
  }
  $('history').disabled = !(strike.shot && page.standing);
}

function lines() {
  const { aim, strike, prediction, replay } = page;
  if (aim.active && replay.time === null) {
    return prediction ? [{ paths: prediction.paths, style: 'strong' }] : [];
  }
  if (!strike.paths || !page.standing) return [];
  const own = { paths: strike.paths, style: 'faint' };
  return strike.exact && $('exact').checked ? [own, { paths: strike.exact, style: 'other' }] : [own];
}

function picture() {
  const { replay, strike, timeline } = page;
  const { time } = replay;
  if (time === null || !strike.shot) {
    return { places: page.places, turns: page.turns, sunk: page.sunk, time: timeline.time, flashes: page.flashes };
  }
  const { shot } = strike;
  const flashes = shot.events.map(([stamp, , , , x, y, speed]) => ({ stamp, x, y, speed }));
  return { places: shot.places(time), turns: shot.turnsAt(time), sunk: shot.sunk(time), time, flashes };
}

// The balls as they are now: between two frames as the latest strike moves them, if that is known.
function now() {
  const { timeline, strike } = page;
  const since = strike.since(timeline.time);
  const { shot } = strike;
  if (since > 0 && since < shot?.duration && strike.isIn(timeline.newest)) {
    return { places: shot.places(since), turns: shot.turnsAt(since) ?? timeline.turns(), sunk: page.sunk && shot.sunk(since) };
  }
  return { places: timeline.places(), turns: timeline.turns(), sunk: timeline.sunk() };
}

function draw() {
  requestAnimationFrame(draw);
  const clock = seconds();
  const elapsed = clock - before;
  before = clock;
  const { timeline, replay, strike, aim, hand } = page;
  if (!page.table || !timeline.newest) return;
  timeline.advance(clock);
  const { places, turns, sunk } = now();
  if (places.length !== 2 * page.table.balls.length) return;
  while (page.flashes.length && isOver(page.flashes[0], timeline.time)) page.flashes.shift();
  replay.advance(elapsed);
  const still = page.places?.length === places.length
    && places.every((place, i) => place === page.places[i]);
  Object.assign(page, { places, turns, sunk });
  if (canStrike() === $('shoot').disabled) showStatus();
  if (!still || page.unfit) {
    page.unfit = false;
    showFits(places);
    replay.show();
    hand.show();
  }
  const live = replay.time === null;
  showContacts(page.standing ? strike.shot : null, page.words,
    live ? strike.since(timeline.time) ?? 0 : replay.time, live);
  const speeds = live ? timeline.speeds() : strike.shot.speeds(replay.time);
  const { balls } = page.table;
  const pocketed = live ? page.state?.pocketed
    : balls.filter((_, ball) => strike.shot.sunk(replay.time)[ball]).map(({ label }) => label);
  showReadings(live ? timeline.time : replay.time, speeds, pocketed);
  if (still && live && !page.flashes.length && !page.dirty) return;
  page.dirty = aim.active || Boolean(hand.held);
  const scene = picture();
  page.shown = scene.places;
  page.painter.draw({ ...scene, aim: aim.active && live ? aim : null, lines: lines(), hand: hand.held, target: live ? page.help.target : null });
  page.drawn += 1;
}

export function start() {
  window.addEventListener('resize', layOut);
  requestAnimationFrame(draw);
}
