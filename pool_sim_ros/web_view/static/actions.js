// What the buttons, the keys and the address of the page ask for.

import { linkTo, misplaced, readLink } from './link.js';
import { canPlay, page, spins } from './page.js';
import { $, say } from './panel.js';
import { layOut } from './scene.js';
import { advise } from './status.js';

export function send(command) {
  if (!page.connection.send(command)) advise('The page is not connected to its server.');
}

export const play = {
  shot(number) {
    if (page.table?.is_report) send({ do: 'shot', number });
  },
  pause: () => send({ do: 'pause', paused: !page.state?.paused }),
  step: () => send({ do: 'step' }),
  reset: () => send({ do: 'reset' }),
  undo: () => (canPlay() ? send({ do: 'undo' }) : advise('Wait until the balls are at rest.')),
  shoot() {
    if (!canPlay()) advise('Wait until the balls are at rest.');
    else if (page.sunk?.[0]) advise('The cue ball is in a pocket.');
    else if (page.form.refused) advise(`Nothing was shot. ${$('refusal').textContent}`);
    else page.aim.shoot();
  },
  escape() {
    page.hand.letGo();
    page.aim.cancel();
    page.replay.live();
    page.dirty = true;
  },
};

// Put a link to the aim, or to the latest strike, into the address and onto the clipboard.
async function link() {
  const { aim, prediction, strike, places, table } = page;
  const { shot } = strike;
  const aims = aim.active || !shot;
  const href = linkTo(aims ? {
    velocity: (aim.given ? aim : prediction ?? aim).velocity,
    spin: spins() ? aim.given?.spin ?? prediction?.spin : null,
    places,
  } : { velocity: shot.velocity, spin: shot.spin, places: shot.start.flat() }, table);
  history.replaceState(null, '', href);
  const what = aims ? 'this aim' : 'the latest shot';
  try {
    await navigator.clipboard.writeText(href);
    advise(`The link to ${what} is copied, and stands in the address.`);
  } catch {
    advise(`The link to ${what} stands in the address.`);
  }
}

let linked = location.search;

// Do what the address asks for, once the balls rest.
export function followLink() {
  if (!linked || !canPlay()) return;
  try {
    const asked = readLink(linked);
    linked = '';
    if (!asked) return;
    const places = asked.layout ? misplaced(asked.layout, page.table, page.places) : {};
    if (Object.keys(places).length) send({ do: 'place', places });
    if (asked.spin && !spins()) throw new Error('the link: on this table balls have no spin');
    if (asked.velocity) page.aim.set({ velocity: asked.velocity, spin: asked.spin ?? undefined });
  } catch (error) {
    linked = '';
    advise(error.message);
  }
}

export function listenToButtons() {
  for (const button of $('shots').querySelectorAll('button')) {
    button.addEventListener('click', () => play.shot(Number(button.dataset.shot)));
  }
  for (const name of ['pause', 'step', 'reset', 'shoot']) $(name).addEventListener('click', play[name]);
  $('link').addEventListener('click', link);
  $('speed').addEventListener('change', () => send({ do: 'speed', factor: Number($('speed').value) }));
  $('axes').addEventListener('change', layOut);
  $('exact').addEventListener('change', () => { page.dirty = true; });
  $('units').value = page.units.name;
  $('units').addEventListener('change', () => {
    page.units.choose($('units').value);
    for (const unit of document.querySelectorAll('.unit')) unit.textContent = page.units.name;
    page.hand.show(true);
    layOut();
  });
  page.canvas.addEventListener('pointermove', (event) => {
    if (!page.painter.geometry) return;
    const [x, y] = page.painter.geometry.toTable(event.offsetX, event.offsetY);
    say('where', `${page.units.text(x)}, ${page.units.text(y)}`);
  });
  page.canvas.addEventListener('pointerleave', () => say('where', '–'));
}
