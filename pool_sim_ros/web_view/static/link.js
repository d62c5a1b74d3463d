// A link that opens the same shot: ?vx=&vy=&spin=&layout=

import { readNumber } from './units.js';

// `shot`: velocity, spin or null, places [x0, y0, ...]; `table`
export function linkTo({ velocity, spin, places }, table) {
  const url = new URL(location.pathname, location.href);
  url.searchParams.set('vx', String(velocity[0]));
  url.searchParams.set('vy', String(velocity[1]));
  if (spin) url.searchParams.set('spin', spin.join(','));
  const layout = table.balls.map(({ label }, i) => `${encodeURIComponent(label)}:${places[2 * i]},${places[2 * i + 1]}`);
  url.searchParams.set('layout', layout.join(';'));
  return url.href;
}

// What a link asks for: {velocity, spin, layout}, or null; throws an Error where it makes no sense.
export function readLink(search) {
  const fields = new URLSearchParams(search);
  const known = ['vx', 'vy', 'spin', 'layout'];
  if (!known.some((name) => fields.has(name))) return null;
  const numbers = (text, what, count) => {
    const parts = text.split(',');
    if (parts.length !== count) throw new Error(`the link: ${what} must be ${count} numbers`);
    return parts.map((part) => readNumber(part, `the link: ${what}`));
  };
  const asked = { velocity: null, spin: null, layout: null };
  if (fields.has('vx') || fields.has('vy')) {
    asked.velocity = ['vx', 'vy'].map((name) => readNumber(fields.get(name) ?? '', `the link: ${name}`));
    if (!asked.velocity[0] && !asked.velocity[1]) throw new Error('the link: vx and vy are both 0');
  }
  if (fields.has('spin')) {
    if (!asked.velocity) throw new Error('the link: spin needs vx and vy');
    asked.spin = numbers(fields.get('spin'), 'spin', 3);
  }
  if (fields.has('layout')) {
    asked.layout = Object.fromEntries(fields.get('layout').split(';').map((part) => {
      const end = part.lastIndexOf(':');
      if (end < 1) throw new Error('the link: layout must be LABEL:x,y;LABEL:x,y and so on');
      return [readLabel(part.slice(0, end)), numbers(part.slice(end + 1), 'layout', 2)];
    }));
  }
  return asked;
}

function readLabel(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    throw new Error(`the link: “${text.slice(0, 20)}” is no label`);
  }
}

// The balls that lie elsewhere than a link has them: label -> [x, y].
export function misplaced(layout, table, places) {
  return Object.fromEntries(Object.entries(layout).filter(([label, [x, y]]) => {
    const ball = table.balls.findIndex((each) => each.label === label);
    return ball < 0 || places[2 * ball] !== x || places[2 * ball + 1] !== y;
  }));
}
