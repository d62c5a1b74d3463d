// What the page says in words and numbers.

const CUSHIONS = ['x = 0', 'x = length', 'y = 0', 'y = width'];
const SHOWN = 12;

export const $ = (id) => document.getElementById(id);

function row(cells) {
  const tr = document.createElement('tr');
  for (const [text, className] of cells) {
    const td = document.createElement('td');
    td.textContent = text;
    if (className) td.className = className;
    tr.append(td);
  }
  return tr;
}

export function say(id, text) {
  const element = $(id);
  if (element.textContent !== text) element.textContent = text;
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

export function showReadings(time, speeds) {
  say('time', `${time.toFixed(2)} s`);
  say('fastest', `${Math.max(0, ...speeds).toFixed(2)} m/s`);
  say('moving', String(speeds.filter((speed) => speed > 1e-4).length));
}

export function addCollisions(rows, balls) {
  const body = $('collisions').tBodies[0];
  const name = (index) => balls[index]?.label ?? index;
  for (const [, t, kind, a, b, , , , , speed] of rows.slice(-SHOWN)) {
    const what = kind === 0 ? `${name(a)} on ${name(b)}` : `${name(a)} on cushion ${CUSHIONS[b]}`;
    body.prepend(row([[t.toFixed(2)], [what], [speed.toFixed(2), 'number']]));
  }
  while (body.rows.length > SHOWN) body.deleteRow(-1);
}

export function showResult(result, balls = []) {
  $('result').hidden = !result;
  if (!result) return;
  const { shot, printed, final_positions_in: ends, integrator } = result;
  say('result-title', shot ? `Shot ${shot} of the report` : 'Where the balls stopped');
  const equal = (label) => printed[label][0] === ends[label][0] && printed[label][1] === ends[label][1];
  const labels = balls.map(({ label }) => label).filter((label) => ends[label]);
  const heads = printed ? ['ball', 'x, y in inches', 'printed', ''] : ['ball', 'x, y in inches'];
  const place = ([x, y]) => `${x.toFixed(2)}, ${y.toFixed(2)}`;
  $('positions').tHead.replaceChildren(row(heads.map((head, i) => [head, i ? 'number' : ''])));
  $('positions').tBodies[0].replaceChildren(...labels.map((label) => row([
    [label], [place(ends[label]), 'number'],
    ...(printed ? [
      [place(printed[label]), 'number'],
      equal(label) ? ['=', 'number same'] : ['≠', 'number other'],
    ] : []),
  ])));
  if (printed) {
    say('verdict', `${labels.filter(equal).length} of ${labels.length} as the report printed them`);
  } else {
    say('verdict', `integrator ${integrator}`);
  }
}
