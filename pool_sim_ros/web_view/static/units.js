// Metres or inches: how positions are shown and typed. Everything is computed in metres.

const UNITS = { m: { size: 1, digits: 3, tick: 0.5 }, in: { size: 0.0254, digits: 2, tick: 10 } };

export class Units {
  constructor() {
    this.name = recall() in UNITS ? recall() : 'm';
  }

  choose(name) {
    this.name = name;
    try {
      localStorage.setItem('unit', name);
    } catch { /* a browser may keep nothing */ }
  }

  get size() {
    return UNITS[this.name].size;
  }

  get tick() {
    return UNITS[this.name].tick;
  }

  number(metres) {
    return (metres / this.size).toFixed(UNITS[this.name].digits).replace(/^-(0\.0*)$/, '$1');
  }

  text(metres) {
    return `${this.number(metres)} ${this.name}`;
  }
}

function recall() {
  try {
    return localStorage.getItem('unit') ?? 'm';
  } catch {
    return 'm';
  }
}

// A number that somebody typed; throws an Error that says what is wrong with it.
export function readNumber(text, what, least = -Infinity, most = Infinity) {
  const trimmed = text.trim().replace(/^−/, '-');
  if (!trimmed) throw new Error(`${what}: a number is missing`);
  if (/^[+-]?\d+,\d+$/.test(trimmed)) {
    throw new Error(`${what}: “${trimmed}” has a comma; write ${trimmed.replace(',', '.')}`);
  }
  if (!/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(trimmed) || !Number.isFinite(Number(trimmed))) {
    throw new Error(`${what}: “${trimmed.slice(0, 20)}” is no number`);
  }
  const number = Number(trimmed);
  if (number < least) throw new Error(`${what}: ${trimmed} must be at least ${least}`);
  if (number > most) throw new Error(`${what}: ${trimmed} must be at most ${most}`);
  return number;
}
