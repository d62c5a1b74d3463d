// Draws the table on a canvas.

import { Geometry } from './geometry.js';

const CLOTH = ['#2a8257', '#1c6240'];
const WOOD = ['#7b4a28', '#5b3319'];
const CUSHION = '#175337';
const FLASH_TIME = 0.25; // s of sim time, at real speed

const rgb = (color) => `rgb(${color.map((part) => Math.round(255 * part)).join(' ')})`;
const isDark = ([r, g, b]) => 0.299 * r + 0.587 * g + 0.114 * b < 0.35; // luma, ITU-R BT.601

export class Painter {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
    this.geometry = null;
  }

  // Lay out for a table in a box of CSS pixels.
  fit(table, width, height) {
    this.geometry = new Geometry(table, width, height);
    this.table = table;
    this.ratio = Math.min(window.devicePixelRatio || 1, 3);
    const { canvas, geometry } = this;
    canvas.width = Math.round(geometry.width * this.ratio);
    canvas.height = Math.round(geometry.height * this.ratio);
    canvas.style.width = `${geometry.width}px`;
    canvas.style.height = `${geometry.height}px`;
    this.ground = this.layer(geometry.width, geometry.height, (c) => this.drawGround(c));
    this.sprites = table.balls.map((ball) => this.drawBall(ball));
  }

  layer(width, height, draw) {
    const layer = document.createElement('canvas');
    layer.width = Math.max(1, Math.ceil(width * this.ratio));
    layer.height = Math.max(1, Math.ceil(height * this.ratio));
    const context = layer.getContext('2d');
    context.scale(this.ratio, this.ratio);
    draw(context);
    return layer;
  }

  drawGround(c) {
    const { width, height, rail, scale } = this.geometry;
    const wood = c.createLinearGradient(0, 0, 0, height);
    wood.addColorStop(0, WOOD[0]);
    wood.addColorStop(1, WOOD[1]);
    c.fillStyle = wood;
    c.beginPath();
    c.roundRect(0, 0, width, height, 0.07 * scale);
    c.fill();
    const edge = 0.045 * scale;
    c.fillStyle = CUSHION;
    c.fillRect(rail - edge, rail - edge, width - 2 * (rail - edge), height - 2 * (rail - edge));
    const [w, h] = [width - 2 * rail, height - 2 * rail];
    const cloth = c.createRadialGradient(
      width / 2, height / 2, 0, width / 2, height / 2, Math.max(w, h) * 0.65,
    );
    cloth.addColorStop(0, CLOTH[0]);
    cloth.addColorStop(1, CLOTH[1]);
    c.fillStyle = cloth;
    c.fillRect(rail, rail, w, h);
    c.fillStyle = '#e9dcc3';
    const middle = (rail - edge) / 2;
    const sight = Math.max(1.2, 0.009 * scale);
    const dot = (x, y) => { c.beginPath(); c.arc(x, y, sight, 0, 7); c.fill(); };
    const [along, across] = this.geometry.upright ? [4, 8] : [8, 4];
    for (let i = 1; i < along; i += 1) {
      dot(rail + (w * i) / along, middle);
      dot(rail + (w * i) / along, height - middle);
    }
    for (let i = 1; i < across; i += 1) {
      dot(middle, rail + (h * i) / across);
      dot(width - middle, rail + (h * i) / across);
    }
  }

  drawBall(ball) {
    const r = ball.radius * this.geometry.scale;
    const half = r * 1.5;
    const layer = this.layer(2 * half, 2 * half, (c) => {
      c.translate(half, half);
      c.fillStyle = 'rgb(0 0 0 / 0.28)';
      c.beginPath();
      c.arc(0.12 * r, 0.16 * r, r, 0, 7);
      c.fill();
      c.fillStyle = rgb(ball.color);
      c.beginPath();
      c.arc(0, 0, r, 0, 7);
      c.fill();
      const shade = c.createRadialGradient(-0.35 * r, -0.4 * r, 0.05 * r, 0, 0, r);
      shade.addColorStop(0, 'rgb(255 255 255 / 0.55)');
      shade.addColorStop(0.35, 'rgb(255 255 255 / 0.08)');
      shade.addColorStop(0.75, 'rgb(0 0 0 / 0.04)');
      shade.addColorStop(1, 'rgb(0 0 0 / 0.38)');
      c.fillStyle = shade;
      c.fill();
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
    });
    return { layer, half };
  }

  // `scene`: places [x0, y0, ...], time, flashes [{stamp, x, y, speed}], aim or null, paths
  draw({ places, time, flashes, aim, paths }) {
    const c = this.context;
    c.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    c.drawImage(this.ground, 0, 0, this.geometry.width, this.geometry.height);
    if (paths) this.drawPaths(paths, aim !== null);
    for (let ball = 0; 2 * ball < places.length; ball += 1) {
      const { layer, half } = this.sprites[ball];
      const [x, y] = this.geometry.toScreen(places[2 * ball], places[2 * ball + 1]);
      c.drawImage(layer, x - half, y - half, 2 * half, 2 * half);
    }
    for (const flash of flashes) this.drawFlash(flash, time);
    if (aim) this.drawCue(aim, places);
  }

  drawPaths(paths, strong) {
    const c = this.context;
    c.save();
    c.globalAlpha = strong ? 0.95 : 0.45;
    c.lineJoin = 'round';
    for (const { ball, points } of paths) {
      const { color, radius } = this.table.balls[ball];
      const line = points.map(([x, y]) => this.geometry.toScreen(x, y));
      c.beginPath();
      line.forEach(([x, y], i) => (i ? c.lineTo(x, y) : c.moveTo(x, y)));
      c.setLineDash([]);
      c.lineWidth = 3.4;
      c.strokeStyle = isDark(color) ? 'rgb(255 255 255 / 0.65)' : 'rgb(0 0 0 / 0.45)';
      c.stroke();
      c.lineWidth = 1.8;
      c.strokeStyle = rgb(color);
      c.stroke();
      const [x, y] = line.at(-1);
      c.beginPath();
      c.arc(x, y, radius * this.geometry.scale, 0, 7);
      c.setLineDash([3, 3]);
      c.lineWidth = 1.4;
      c.strokeStyle = isDark(color) ? '#fff' : rgb(color);
      c.stroke();
    }
    c.restore();
  }

  drawFlash({ stamp, x, y, speed }, time) {
    const part = (time - stamp) / FLASH_TIME;
    if (part < 0 || part > 1) return;
    const c = this.context;
    const [sx, sy] = this.geometry.toScreen(x, y);
    const strength = Math.min(1, 0.35 + speed / 3);
    c.beginPath();
    c.arc(sx, sy, (0.012 + 0.05 * part * strength) * this.geometry.scale, 0, 7);
    c.lineWidth = 1 + 2.5 * (1 - part);
    c.strokeStyle = `rgb(255 240 170 / ${(1 - part) * strength})`;
    c.stroke();
  }

  drawCue({ velocity }, places) {
    const c = this.context;
    const speed = Math.hypot(...velocity);
    if (!speed) return;
    const [ux, uy] = velocity.map((part) => part / speed);
    const at = (distance) => this.geometry.toScreen(
      places[0] - ux * distance, places[1] - uy * distance,
    );
    const tip = this.table.balls[0].radius * 1.25 + 0.04 * speed;
    c.save();
    c.lineCap = 'round';
    for (const [from, to, width, color] of [
      [tip, tip + 0.9, 0.022, '#d9b57c'], [tip + 0.55, tip + 0.9, 0.026, '#3c2415'],
      [tip, tip + 0.012, 0.02, '#3f74a8'],
    ]) {
      c.beginPath();
      c.moveTo(...at(from));
      c.lineTo(...at(to));
      c.lineWidth = Math.max(2, width * this.geometry.scale);
      c.strokeStyle = color;
      c.stroke();
    }
    c.restore();
  }
}

export const isOver = (flash, time) => time - flash.stamp > FLASH_TIME || flash.stamp - time > 5;
