// The balls: discs as they are, and balls that turn, with marks that turn with them.

import { axes } from './turning.js';

const SPOT = 0.5; // rad: half the opening of the white spot with the label
const CAP = 0.95; // rad: of the white caps beside a stripe
const DOT = 0.2; // rad: of the dots of the cue ball
const CORNERS = 28; // of a mark's outline
const STRIPED = /^(9|1[0-5])$/;
const DEEP = 0.8; // size of a ball in a pocket

const rgb = (color) => `rgb(${color.map((part) => Math.round(255 * part)).join(' ')})`;
export const isDark = ([r, g, b]) => 0.299 * r + 0.587 * g + 0.114 * b < 0.35; // luma, ITU-R BT.601

export class Balls {
  // `layer(width, height, draw)` makes a picture that is drawn once.
  constructor(table, geometry, layer) {
    Object.assign(this, { table, geometry });
    this.turning = table.motion === 'ball';
    this.sprites = table.balls.map((ball) => {
      const half = 1.5 * ball.radius * geometry.scale;
      const draw = this.turning ? drawShade : drawDisc;
      return { half, picture: layer(2 * half, 2 * half, (c) => draw(c, ball, half / 1.5)) };
    });
  }

  // `turns`: quaternions or null; `sunk`: which lie in a pocket, or null
  draw(c, places, turns, sunk) {
    const balls = this.table.balls.map((_, ball) => ball);
    if (sunk) balls.sort((one, other) => sunk[other] - sunk[one]); // what is deeper first
    for (const ball of balls) {
      const [x, y] = this.geometry.toScreen(places[2 * ball], places[2 * ball + 1]);
      const deep = Boolean(sunk?.[ball]);
      const { half, picture } = this.sprites[ball];
      c.save();
      c.translate(x, y);
      if (deep) {
        c.scale(DEEP, DEEP);
        c.globalAlpha = 0.55;
      }
      if (this.turning) this.drawTurned(c, this.table.balls[ball], half / 1.5, turns?.[ball]);
      c.drawImage(picture, -half, -half, 2 * half, 2 * half);
      c.restore();
    }
  }

  drawTurned(c, ball, r, turn = [0, 0, 0, 1]) {
    const { upright } = this.geometry;
    // From table axes to the screen: there y points down.
    const own = axes(turn).map(([x, y, z]) => (upright ? [y, x, z] : [x, -y, z]));
    c.fillStyle = rgb(ball.color);
    c.beginPath();
    c.arc(0, 0, r, 0, 7);
    c.fill();
    if (ball.is_cue) {
      for (const axis of own) this.marks(c, axis, DOT, r, '#b3261e');
      return;
    }
    const right = upright ? own[1] : own[0];
    const down = upright ? own[0] : own[1].map((part) => -part);
    if (STRIPED.test(ball.label)) this.marks(c, down, CAP, r, '#f6f3ec');
    this.marks(c, own[2], SPOT, r, '#fbf9f4');
    for (const side of [1, -1]) {
      const height = side * own[2][2];
      if (height < 0.12 || ball.label.length > 3) continue;
      c.save();
      const shift = 0.97 * r * side;
      const turned = right.map((part) => part * side); // so that it is no mirror image
      c.transform(turned[0], turned[1], down[0], down[1], own[2][0] * shift, own[2][1] * shift);
      c.fillStyle = '#1b1a18';
      c.font = `700 ${(ball.label.length > 2 ? 0.42 : ball.label.length > 1 ? 0.58 : 0.72) * r}px system-ui, sans-serif`;
      c.textAlign = 'center';
      c.textBaseline = 'middle';
      c.fillText(ball.label, 0, 0.05 * r);
      c.restore();
    }
  }

  // Two round marks, at both ends of an axis; what is behind the ball is not seen.
  marks(c, axis, opening, r, color) {
    c.fillStyle = color;
    for (const side of [1, -1]) cap(c, axis.map((part) => part * side), opening, r);
  }
}

function cap(c, [x, y, z], opening, r) {
  if (z < -Math.sin(opening)) return;
  const flat = Math.hypot(x, y);
  const across = flat > 1e-9 ? [-y / flat, x / flat, 0] : [1, 0, 0];
  const along = [y * across[2] - z * across[1], z * across[0] - x * across[2], x * across[1] - y * across[0]];
  const [near, wide] = [Math.cos(opening), Math.sin(opening)];
  c.beginPath();
  for (let i = 0; i <= CORNERS; i += 1) {
    const angle = (2 * Math.PI * i) / CORNERS;
    const [u, v] = [wide * Math.cos(angle), wide * Math.sin(angle)];
    let px = near * x + u * across[0] + v * along[0];
    let py = near * y + u * across[1] + v * along[1];
    if (near * z + v * along[2] < 0) { // behind the rim: what is seen ends there
      const out = Math.hypot(px, py);
      px /= out;
      py /= out;
    }
    c.lineTo(px * r, py * r);
  }
  c.fill();
}

function drawShade(c, ball, r) {
  c.translate(1.5 * r, 1.5 * r);
  c.beginPath();
  c.arc(0, 0, r, 0, 7);
  shade(c, r, 0.4);
}

function shade(c, r, light) {
  const shaded = c.createRadialGradient(-0.35 * r, -0.4 * r, 0.05 * r, 0, 0, r);
  shaded.addColorStop(0, `rgb(255 255 255 / ${light})`);
  shaded.addColorStop(0.35, 'rgb(255 255 255 / 0.08)');
  shaded.addColorStop(0.75, 'rgb(0 0 0 / 0.04)');
  shaded.addColorStop(1, 'rgb(0 0 0 / 0.38)');
  c.fillStyle = shaded;
  c.fill();
}

function drawDisc(c, ball, r) {
  c.translate(1.5 * r, 1.5 * r);
  c.fillStyle = 'rgb(0 0 0 / 0.28)';
  c.beginPath();
  c.arc(0.12 * r, 0.16 * r, r, 0, 7);
  c.fill();
  c.fillStyle = rgb(ball.color);
  c.beginPath();
  c.arc(0, 0, r, 0, 7);
  c.fill();
  shade(c, r, 0.55);
  c.fillStyle = ball.is_cue ? 'rgb(255 255 255 / 0.6)' : 'rgb(255 255 255 / 0.94)';
  c.beginPath();
  c.arc(0, 0, 0.6 * r, 0, 7);
  c.fill();
  c.fillStyle = '#1b1a18';
  const size = (ball.label.length > 2 ? 1.5 / ball.label.length : 0.85) * r;
  c.font = `650 ${size}px system-ui, sans-serif`;
  c.textAlign = 'center';
  c.textBaseline = 'middle';
  c.fillText(ball.label, 0, 0.06 * r);
}

export { rgb };
