/** Vectors of three, and placements: 4 × 4 matrices as column-major arrays of 16. */

export type Vector = readonly number[];
export type Matrix = readonly number[];

export const IDENTITY: Matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

export const add = (a: Vector, b: Vector): number[] => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const scaled = (a: Vector, s: number): number[] => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vector, b: Vector): number[] => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const unit = (a: Vector): number[] => scaled(a, 1 / Math.hypot(...a));

export function multiply(a: Matrix, b: Matrix): number[] {
  const out = new Array<number>(16);
  for (let column = 0; column < 4; column++)
    for (let row = 0; row < 4; row++) {
      let sum = 0;
      for (let k = 0; k < 4; k++) sum += a[4 * k + row] * b[4 * column + k];
      out[4 * column + row] = sum;
    }
  return out;
}

/** The inverse of a placement, which may scale and mirror. */
export function inverse(m: Matrix): number[] {
  const [a, b, c] = [0, 4, 8].map((k) => [m[k], m[k + 1], m[k + 2]]);
  const volume = dot(a, cross(b, c));
  const rows = [cross(b, c), cross(c, a), cross(a, b)].map((row) => scaled(row, 1 / volume));
  const ends = rows.map((row) => -dot(row, [m[12], m[13], m[14]]));
  return [0, 1, 2].flatMap((k) => [...rows.map((row) => row[k]), 0]).concat(ends, 1);
}

export const moved = (m: Matrix, p: Vector): number[] =>
  [0, 1, 2].map((row) => m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row]);
export const turned = (m: Matrix, v: Vector): number[] =>
  [0, 1, 2].map((row) => m[row] * v[0] + m[4 + row] * v[1] + m[8 + row] * v[2]);

/** The rotation of a unit quaternion (w, x, y, z) about a point. */
export function rotation([w, x, y, z]: Vector, point: Vector): number[] {
  const m = [
    1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0,
    2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 0,
    2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y), 0,
    0, 0, 0, 1,
  ];
  const gone = turned(m, point);
  for (let row = 0; row < 3; row++) m[12 + row] = point[row] - gone[row];
  return m;
}

export interface Box {
  low: number[];
  high: number[];
  middle: number[];
}

export function boxOf(points: readonly Vector[]): Box {
  const [low, high] = [Math.min, Math.max].map((best) =>
    [0, 1, 2].map((k) => points.reduce((value, point) => best(value, point[k]), points[0][k])),
  );
  return { low, high, middle: scaled(add(low, high), 0.5) };
}
