// What the page says in words and numbers.

const ANNOUNCE_TIME = 400; // ms without a change until it is read out

export const $ = (id) => document.getElementById(id);

// A row of cells [text, class, scope]; one with a scope is a header.
function row(cells) {
  const tr = document.createElement('tr');
  for (const [text, className, scope] of cells) {
    const cell = document.createElement(scope ? 'th' : 'td');
    cell.textContent = text;
    if (className) cell.className = className;
    if (scope) cell.scope = scope;
    tr.append(cell);
  }
  return tr;
}

export function say(id, text) {
  const element = $(id);
  if (element.textContent !== text) element.textContent = text;
}

const waiting = new Map();

// For a screen reader: the last word on a matter, once it has not changed for a while.
export function announce(matter, text) {
  clearTimeout(waiting.get(matter));
  waiting.set(matter, setTimeout(() => say('announcement', text), ANNOUNCE_TIME));
}

export function showProblem(text) {
  $('problem').hidden = !text;
  say('problem', text ?? '');
}

export function showNotice(text) {
  $('notice').hidden = !text;
  say('notice', text ?? '');
}

export function showState(state, problem, compiling) {
  if (problem || !state) return say('state', problem ? 'no simulator' : 'waiting');
  const doing = state.computing ? (compiling ? 'waiting' : 'computing') : state.moving ? 'rolling' : 'at rest';
  return say('state', state.paused ? `paused, ${doing}` : doing);
}

export function showReadings(time, speeds, pocketed) {
  say('time', `${time.toFixed(2)} s`);
  say('fastest', `${Math.max(0, ...speeds).toFixed(2)} m/s`);
  say('moving', String(speeds.filter((speed) => speed > 1e-4).length));
  say('pocketed', pocketed?.join(' ') || '–');
}

let listed = { shot: null, words: null, shown: -1 };

// The contacts of a shot by time since the strike; those after `time` are faint or not there yet.
export function showContacts(shot, words, time, live) {
  const body = $('collisions').tBodies[0];
  const events = shot?.events ?? [];
  if (listed.shot !== shot || listed.words !== words) {
    body.replaceChildren(...events.map((event) => row([
      [event[0].toFixed(3), 'number'], [words.contact(event)], [event[6].toFixed(2), 'number'],
    ])));
    listed = { shot, words, shown: -1 };
    say('no-collisions', !shot ? 'A shot lists them.' : events.length ? '' : 'No ball touches anything.');
  }
  let shown = events.length;
  while (shown > 0 && events[shown - 1][0] > time) shown -= 1;
  const key = live ? shown : shown + events.length + 1;
  if (listed.shown === key) return;
  [...body.rows].forEach((tr, i) => {
    tr.hidden = live && i >= shown;
    tr.classList.toggle('later', !live && i >= shown);
  });
  const last = body.rows[shown - 1];
  const box = $('contacts');
  if (last) box.scrollTop = last.offsetTop + last.offsetHeight - box.clientHeight;
  listed.shown = key;
}

// Where the balls of a shot stopped, and what the report printed.
export function showResult(result, table, words, units) {
  $('result').hidden = !result;
  if (!result) return;
  const { shot, printed, final_positions: ends, final_positions_in: inches, integrator } = result;
  const ofReport = shot && table.is_report;
  say('result-title', ofReport ? `Shot ${shot} of the report` : 'Where the balls stopped');
  const labels = table.balls.map(({ label }) => label).filter((label) => ends[label]);
  const equal = (label) => printed[label].every((part, i) => part === inches[label][i]);
  const pair = ([x, y]) => `${x.toFixed(2)}, ${y.toFixed(2)}`;
  const unit = printed ? 'in' : units.name;
  const place = (label) => {
    const pocket = result.pocketed?.[label];
    if (pocket !== undefined) return words.pocket(pocket);
    return printed ? pair(inches[label]) : ends[label].map((part) => units.number(part)).join(', ');
  };
  const heads = printed ? ['ball', `x, y (${unit})`, 'printed', 'same'] : ['ball', `x, y (${unit})`];
  $('positions').tHead.replaceChildren(row(heads.map((head, i) => [head, i ? 'number' : '', 'col'])));
  $('positions').tBodies[0].replaceChildren(...labels.map((label) => row([
    [label, '', 'row'], [place(label), 'number'],
    ...(printed ? [
      [pair(printed[label]), 'number'],
      equal(label) ? ['=', 'number same'] : ['≠', 'number other'],
    ] : []),
  ])));
  say('verdict', printed
    ? `${labels.filter(equal).length} of ${labels.length} as the report printed them`
    : `integrator ${integrator}`);
}

// What a shot did, in a sentence.
export function resultWords(result, table, words) {
  const { shot, printed, final_positions_in: inches, t_start: start, t_end: end } = result;
  const lasted = `${(end - start).toFixed(2)} s`;
  if (shot && table.is_report && printed) {
    const same = Object.keys(inches).filter((label) => printed[label].every((part, i) => part === inches[label][i]));
    return `Shot ${shot} of the report ended after ${lasted}: ${same.length} of ${Object.keys(inches).length} balls as printed.`;
  }
  const fell = Object.entries(result.pocketed ?? {}).map(([label, pocket]) => `${label} in the ${words.pocket(pocket)}`);
  return `The balls rest after ${lasted}.${fell.length ? ` Pocketed: ${fell.join(', ')}.` : ''}`;
}
