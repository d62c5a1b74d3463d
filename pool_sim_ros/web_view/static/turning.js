// How a ball is turned while it spins: unit quaternions [x, y, z, w], as in orientation.py.

const STEP = 1 / 120; // s; the axis turns so little in it that nobody sees the error

export function product([ax, ay, az, aw], [bx, by, bz, bw]) {
  return [
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
    aw * bw - ax * bx - ay * by - az * bz,
  ];
}

export const inverse = ([x, y, z, w]) => [-x, -y, -z, w];

// Turn `q` about a vector by its length, rad.
function turnBy(q, x, y, z) {
  const angle = Math.hypot(x, y, z);
  if (angle === 0) return q;
  const part = Math.sin(angle / 2) / angle;
  return product([part * x, part * y, part * z, Math.cos(angle / 2)], q);
}

// `spin` at the start and its change, of x and y in rad/s^2; that about z falls by `loss` to 0.
export function turned(q, { wx, wy, wz, turnX, turnY }, loss, lasts) {
  const alone = wz === 0 && wx * turnY === wy * turnX; // one axis all the time
  const steps = alone ? 1 : Math.max(1, Math.ceil(lasts / STEP));
  const step = lasts / steps;
  for (let i = 0; i < steps; i += 1) {
    const middle = (i + 0.5) * step;
    const z = Math.sign(wz) * Math.max(0, Math.abs(wz) - loss * middle);
    q = turnBy(q, step * (wx + turnX * middle), step * (wy + turnY * middle), step * z);
  }
  return q;
}

// Between two quaternions; from far apart by the shorter way.
export function between(a, b, part) {
  const sign = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] < 0 ? -1 : 1;
  const mixed = a.map((value, i) => (1 - part) * value + part * sign * b[i]);
  const length = Math.hypot(...mixed) || 1;
  return mixed.map((value) => value / length);
}

// The columns of the rotation: where the ball's own x, y and z axes point.
export function axes([x, y, z, w]) {
  return [
    [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)],
    [2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)],
    [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)],
  ];
}
