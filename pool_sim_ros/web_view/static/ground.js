// The table without its balls: wood, cushions, cloth, pockets and, if wanted, axes.

const CLOTH = ['#2a8257', '#1c6240'];
const WOOD = ['#7b4a28', '#5b3319'];
const CUSHION = '#175337';
const HOLE = '#12100e';
const EDGE = 0.045; // m of a cushion, seen from above
const JAW = 0.12; // m within which a jaw belongs to the end of a cushion

export function drawGround(c, geometry, table) {
  const { width, height, rail, scale } = geometry;
  const wood = c.createLinearGradient(0, 0, 0, height);
  wood.addColorStop(0, WOOD[0]);
  wood.addColorStop(1, WOOD[1]);
  c.fillStyle = wood;
  c.beginPath();
  c.roundRect(0, 0, width, height, 0.07 * scale);
  c.fill();
  const edge = EDGE * scale;
  const [w, h] = [width - 2 * rail, height - 2 * rail];
  const cloth = c.createRadialGradient(
    width / 2, height / 2, 0, width / 2, height / 2, Math.max(w, h) * 0.65,
  );
  cloth.addColorStop(0, CLOTH[0]);
  cloth.addColorStop(1, CLOTH[1]);
  if (table.cushions) {
    c.fillStyle = cloth;
    c.fillRect(rail - edge, rail - edge, w + 2 * edge, h + 2 * edge);
    drawCushions(c, geometry, table);
  } else {
    c.fillStyle = CUSHION;
    c.fillRect(rail - edge, rail - edge, w + 2 * edge, h + 2 * edge);
    c.fillStyle = cloth;
    c.fillRect(rail, rail, w, h);
  }
  drawPockets(c, geometry, table);
  drawSights(c, geometry, table, (rail - edge) / 2);
}

// Each straight cushion with what is behind it, as far as the wood; its ends are the jaws.
function drawCushions(c, geometry, { cushions, length, width }) {
  const straight = ([, , , , nx, ny]) => Math.max(Math.abs(nx), Math.abs(ny)) > 0.999;
  const jaws = cushions.segments.filter((segment) => !straight(segment));
  const behind = ([x, y], [nx, ny]) => {
    const near = jaws
      .flatMap(([x0, y0, x1, y1]) => [[[x1, y1], [x0, y0]], [[x0, y0], [x1, y1]]])
      .map(([inner, outer]) => ({ inner, outer, off: Math.hypot(inner[0] - x, inner[1] - y) }))
      .sort((one, other) => one.off - other.off)[0];
    return near && near.off < JAW ? [near.inner, near.outer] : [[x - nx * EDGE, y - ny * EDGE]];
  };
  c.save();
  c.beginPath();
  const [[left, top], [right, bottom]] = [geometry.toScreen(-EDGE, -EDGE),
    geometry.toScreen(length + EDGE, width + EDGE)];
  c.rect(left, top, right - left, bottom - top);
  c.clip();
  c.fillStyle = CUSHION;
  for (const segment of cushions.segments.filter(straight)) {
    const [from, to, normal] = [segment.slice(0, 2), segment.slice(2, 4), segment.slice(4)];
    c.beginPath();
    [...behind(from, normal).reverse(), from, to, ...behind(to, normal)].forEach(([x, y], i) => {
      const point = geometry.toScreen(x, y);
      if (i) c.lineTo(...point);
      else c.moveTo(...point);
    });
    c.fill();
  }
  for (const [x, y, radius] of cushions.noses) {
    c.beginPath();
    c.arc(...geometry.toScreen(x, y), Math.max(0.5, radius * geometry.scale), 0, 7);
    c.fill();
  }
  c.restore();
}

function drawPockets(c, geometry, { pockets = [] }) {
  for (const [x, y, radius] of pockets) {
    const [sx, sy] = geometry.toScreen(x, y);
    const r = radius * geometry.scale;
    const hole = c.createRadialGradient(sx, sy, r * 0.4, sx, sy, r);
    hole.addColorStop(0, '#000');
    hole.addColorStop(1, HOLE);
    c.fillStyle = hole;
    c.beginPath();
    c.arc(sx, sy, r, 0, 7);
    c.fill();
  }
}

function drawSights(c, { width, height, rail, scale, upright }, { pockets = [] }, middle) {
  c.fillStyle = '#e9dcc3';
  const [w, h] = [width - 2 * rail, height - 2 * rail];
  const sight = Math.max(1.2, 0.009 * scale);
  const dot = (x, y) => { c.beginPath(); c.arc(x, y, sight, 0, 7); c.fill(); };
  const [along, across] = upright ? [4, 8] : [8, 4];
  const free = (i, count) => !(pockets.length === 6 && count === 8 && i === 4); // a pocket is there
  for (let i = 1; i < along; i += 1) {
    if (!free(i, along)) continue;
    dot(rail + (w * i) / along, middle);
    dot(rail + (w * i) / along, height - middle);
  }
  for (let i = 1; i < across; i += 1) {
    if (!free(i, across)) continue;
    dot(middle, rail + (h * i) / across);
    dot(width - middle, rail + (h * i) / across);
  }
}

// Axes with their numbers on the rails.
export function drawAxes(c, geometry, { length, width }, units) {
  const { rail, scale } = geometry;
  c.save();
  c.font = `${Math.max(10, Math.min(13, 0.045 * scale))}px system-ui, sans-serif`;
  c.textAlign = 'center';
  c.textBaseline = 'middle';
  c.fillStyle = '#fff';
  c.strokeStyle = 'rgb(255 255 255 / 0.35)';
  c.lineWidth = 1;
  const step = units.tick * units.size;
  const line = (from, to, text, at) => {
    c.beginPath();
    c.moveTo(...from);
    c.lineTo(...to);
    c.stroke();
    c.fillText(text, ...at);
  };
  const out = -(rail * 0.5) / scale;
  const name = (value, axis) => (value ? units.number(value).replace(/\.?0+$/, '') : axis);
  for (let x = 0; x <= length + 1e-9; x += step) {
    line(geometry.toScreen(x, 0), geometry.toScreen(x, width), name(x, '0'), geometry.toScreen(x, out));
  }
  for (let y = step; y <= width + 1e-9; y += step) {
    line(geometry.toScreen(0, y), geometry.toScreen(length, y), name(y, '0'), geometry.toScreen(out, y));
  }
  c.font = `italic ${c.font}`;
  c.fillText(`x, ${units.name}`, ...geometry.toScreen(length * 0.97, out));
  c.fillText('y', ...geometry.toScreen(out, width * 0.97));
  c.restore();
}
