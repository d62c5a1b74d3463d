// Draws the table on a canvas.

import { Balls, isDark, rgb } from './balls.js';
import { Geometry } from './geometry.js';
import { drawAxes, drawGround } from './ground.js';

const FLASH_TIME = 0.25; // s of sim time, at real speed

export class Painter {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
    this.geometry = null;
  }

  // Lay out for a table in a box of CSS pixels; `units` where axes are wanted.
  fit(table, width, height, units = null) {
    this.geometry = new Geometry(table, width, height);
    this.table = table;
    this.ratio = Math.min(window.devicePixelRatio || 1, 3);
    const { canvas, geometry } = this;
    canvas.width = Math.round(geometry.width * this.ratio);
    canvas.height = Math.round(geometry.height * this.ratio);
    canvas.style.width = `${geometry.width}px`;
    canvas.style.height = `${geometry.height}px`;
    this.ground = this.layer(geometry.width, geometry.height, (c) => {
      drawGround(c, geometry, table);
      if (units) drawAxes(c, geometry, table, units);
    });
    this.balls = new Balls(table, geometry, (...parts) => this.layer(...parts));
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

  // `scene`: places [x0, y0, ...], turns, sunk, time, flashes [{stamp, x, y, speed}], aim or null,
  // lines [{paths, style}] with the style 'strong', 'faint' or 'other', hand {ball, x, y, free} or null,
  // target {x, y, within} or null
  draw({ places, turns, sunk, time, flashes, aim, lines, hand, target }) {
    const c = this.context;
    c.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    c.drawImage(this.ground, 0, 0, this.geometry.width, this.geometry.height);
    if (target) this.drawTarget(target);
    for (const { paths, style } of lines) this.drawPaths(paths, style);
    this.balls.draw(c, places, turns, sunk);
    for (const flash of flashes) this.drawFlash(flash, time);
    if (hand) this.drawHand(hand);
    if (aim) this.drawCue(aim, places);
  }

  // The place to which a ball is to come.
  drawTarget({ x, y, within }) {
    const c = this.context;
    const [sx, sy] = this.geometry.toScreen(x, y);
    c.beginPath();
    c.arc(sx, sy, within * this.geometry.scale, 0, 7);
    c.fillStyle = 'rgb(255 255 255 / 0.16)';
    c.fill();
    c.setLineDash([5, 4]);
    c.lineWidth = 1.6;
    c.strokeStyle = '#fff';
    c.stroke();
    c.setLineDash([]);
  }

  drawPaths(paths, style) {
    const c = this.context;
    c.save();
    c.globalAlpha = style === 'faint' ? 0.5 : 0.95;
    c.lineJoin = 'round';
    for (const { ball, points } of paths) {
      const { color, radius } = this.table.balls[ball];
      const line = points.map(([x, y]) => this.geometry.toScreen(x, y));
      c.beginPath();
      line.forEach(([x, y], i) => (i ? c.lineTo(x, y) : c.moveTo(x, y)));
      c.setLineDash([]);
      if (style === 'other') {
        c.setLineDash([6, 4]);
        c.lineWidth = 1.6;
        c.strokeStyle = '#fff';
        c.stroke();
      } else {
        c.lineWidth = 3.4;
        c.strokeStyle = isDark(color) ? 'rgb(255 255 255 / 0.65)' : 'rgb(0 0 0 / 0.45)';
        c.stroke();
        c.lineWidth = 1.8;
        c.strokeStyle = rgb(color);
        c.stroke();
      }
      const [x, y] = line.at(-1);
      c.beginPath();
      c.arc(x, y, radius * this.geometry.scale, 0, 7);
      c.setLineDash([3, 3]);
      c.lineWidth = 1.4;
      c.strokeStyle = style === 'other' || isDark(color) ? '#fff' : rgb(color);
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

  // The ball in hand: where it would lie, red where it cannot.
  drawHand({ ball, x, y, free }) {
    const c = this.context;
    const { color, radius } = this.table.balls[ball];
    c.beginPath();
    c.arc(...this.geometry.toScreen(x, y), radius * this.geometry.scale, 0, 7);
    c.fillStyle = rgb(color);
    c.fill();
    c.lineWidth = 3;
    c.strokeStyle = free ? '#fff' : '#ff3b1f';
    c.stroke();
  }

  drawCue({ velocity, readout }, places) {
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
    this.drawReadout(readout, at(tip + 0.12), at(0));
    c.restore();
  }

  // The numbers beside the cue, within the picture, and not over the ball if that can be.
  drawReadout(text, [x, y], ball) {
    const c = this.context;
    c.font = '600 13px system-ui, sans-serif';
    c.textBaseline = 'middle';
    const [width, height] = [c.measureText(text).width + 14, 24];
    const fit = (place, size, most) => Math.max(4, Math.min(most - size - 4, place));
    const apart = this.table.balls[0].radius * this.geometry.scale + 8;
    const places = [[12, -height - 12], [12, 12], [-width - 12, -height - 12], [-width - 12, 12]].map(([dx, dy]) => {
      const [left, top] = [fit(x + dx, width, this.geometry.width), fit(y + dy, height, this.geometry.height)];
      const [bx, by] = [ball[0] - Math.max(left, Math.min(left + width, ball[0])),
        ball[1] - Math.max(top, Math.min(top + height, ball[1]))];
      return { left, top, free: Math.hypot(bx, by) > apart };
    });
    const { left, top } = places.find(({ free }) => free) ?? places[0];
    c.fillStyle = 'rgb(0 0 0 / 0.72)';
    c.beginPath();
    c.roundRect(left, top, width, height, 6);
    c.fill();
    c.fillStyle = '#fff';
    c.textAlign = 'left';
    c.fillText(text, left + 7, top + height / 2 + 1);
  }
}

export const isOver = (flash, time) => time - flash.stamp > FLASH_TIME || flash.stamp - time > 5;
