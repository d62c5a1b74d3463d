// The keyboard: everything that the pointer can do.

// `play`: the actions; `aim`, `form`, `replay`; `canvas` gets the focus where keys aim.
export function listenToKeys({ play, aim, form, replay, canvas }) {
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const inField = event.target.matches('input, select');
    const onButton = event.target.matches('button, summary');
    const finer = (event.shiftKey ? 0.1 : 1) * (aim.fine ? 0.1 : 1);
    const keys = {
      ArrowLeft: () => aim.turn(finer),
      ArrowRight: () => aim.turn(-finer),
      ArrowUp: () => aim.strengthen(0.1 * finer),
      ArrowDown: () => aim.strengthen(-0.1 * finer),
      Escape: play.escape,
      Enter: play.shoot,
      ' ': play.pause,
      s: play.step,
      r: play.reset,
      f: () => form.beFine(!aim.fine),
      p: () => replay.play(!replay.playing),
      u: play.undo,
      ',': () => replay.step(-1),
      '.': () => replay.step(1),
      1: () => play.shot(1), 2: () => play.shot(2), 3: () => play.shot(3), 4: () => play.shot(4),
    };
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (!keys[key] || (onButton && (key === 'Enter' || key === ' '))) return;
    const aims = event.target.closest('#aim') && event.target.matches('input');
    if (inField && !(key === 'Escape' || (key === 'Enter' && aims))) return;
    event.preventDefault();
    // So that Enter shoots, and does not press the button that was used last.
    if (key.startsWith('Arrow')) canvas.focus({ preventScroll: true });
    keys[key]();
  });
}
