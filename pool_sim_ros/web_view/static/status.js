// What the page says of simulator, server and compilation, and which buttons can be used.

import { canPlay, canStrike, page } from './page.js';
import { $, say, showNotice, showProblem, showState } from './panel.js';

const ADVICE_TIME = 6000; // ms
const COMPUTE_TIME = 1000; // ms; a compiled shot takes less

let dismissal = 0;
let patience = 0;

// Say something for a while.
export function advise(text) {
  say('advice', text);
  clearTimeout(dismissal);
  if (text) dismissal = setTimeout(() => say('advice', ''), ADVICE_TIME);
}

// A shot that is computed for long probably waits until the simulator has compiled its physics.
export function watchComputing() {
  if (page.state?.computing) {
    patience ||= setTimeout(() => { page.waits = true; showStatus(); }, COMPUTE_TIME);
    return;
  }
  clearTimeout(patience);
  patience = 0;
  page.waits = false;
}

function notice() {
  const until = 'the physics is compiled; this takes about 20 s, on the first run only.';
  if (page.state.computing && page.compiling) return `Your shot waits until ${until}`;
  if (page.compiling) return `Compiling the physics. Shots, and the paths while you aim, wait until ${until}`;
  if (page.waits) return 'The shot is being computed. The first one waits until the physics is compiled.';
  if (canPlay() && !canStrike()) return 'The cue ball is in a pocket. Drag it onto the table, or type its position.';
  return null;
}

export function showStatus() {
  const { connected, simulator, state } = page;
  const lost = connected ? simulator?.problem : 'The page has lost its server, and keeps trying to reach it.';
  showProblem(lost);
  showState(state, lost, page.compiling);
  showNotice(connected && state && !lost ? notice() : null);
  say('simulator', simulator?.name ?? '');
  const usable = Boolean(connected && state);
  for (const button of document.querySelectorAll('button')) button.disabled = !usable;
  $('speed').disabled = !usable;
  page.replay.show();
  if (!usable) return;
  $('shoot').disabled = !canStrike();
  $('place').disabled = $('undo').disabled = !canPlay();
  page.help.enable();
  for (const button of $('shots').querySelectorAll('button')) button.disabled = !canPlay();
  $('step').disabled = !state.paused;
  say('pause', state.paused ? 'Resume' : 'Pause');
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
