/** Where the machine is looked at from. */

import { add, boxOf, cross, dot, type Matrix, scaled, type Vector } from "./vectors.ts";

const FIELD = (20 * Math.PI) / 180;

/** A target, and an azimuth, an elevation and a distance from it. */
export interface View {
  target: Vector;
  azimuth: number;
  elevation: number;
  distance: number;
}

/** The ball around a machine. */
export interface Ball {
  middle: Vector;
  radius: number;
}

export interface Camera {
  eye: Vector;
  back: Vector;
  right: Vector;
  up: Vector;
  /** Half the picture's height at a distance of one. */
  slope: number;
  /** Takes the world to clip space. */
  matrix: Matrix;
}

/** The camera of a view; the ball bounds what is near. */
export function cameraOf({ target, azimuth, elevation, distance }: View, aspect: number, ball: Ball = { middle: target, radius: 1 }): Camera {
  const { middle, radius } = ball;
  const level = Math.cos(elevation);
  const back = [level * Math.cos(azimuth), level * Math.sin(azimuth), Math.sin(elevation)];
  const right = [-Math.sin(azimuth), Math.cos(azimuth), 0];
  const up = cross(back, right);
  const eye = add(target, scaled(back, distance));
  const slope = Math.tan(FIELD / 2);
  const away = Math.hypot(...add(eye, scaled(middle, -1)));
  const far = away + 8 * radius;
  const near = Math.max(away - 1.8 * radius, 0.004 * distance);
  const depth = [(far + near) / (near - far), (2 * far * near) / (near - far)];
  const rows = [scaled(right, 1 / (slope * aspect)), scaled(up, 1 / slope), scaled(back, depth[0]), scaled(back, -1)];
  const ends = rows.map((row) => -dot(row, eye));
  ends[2] += depth[1];
  const matrix = [0, 1, 2].flatMap((k) => rows.map((row) => row[k])).concat(ends);
  return { eye, back, right, up, slope, matrix };
}

/** Target and distance from which all points are seen at a view's angles. */
export function fitted(points: readonly Vector[], view: Pick<View, "azimuth" | "elevation">, aspect: number): Pick<View, "target" | "distance"> {
  const { middle } = boxOf(points);
  const { back, right, up, slope } = cameraOf({ ...view, target: middle, distance: 1 }, aspect);
  const seen = points.map((point) => {
    const offset = add(point, scaled(middle, -1));
    return [dot(offset, right), dot(offset, up), dot(offset, back)];
  });
  // Aim at the middle of what is seen, then step back until every point is in the frame.
  const box = boxOf(seen);
  const need = seen.map(([x, y, z]) =>
    z + Math.max(Math.abs(x - box.middle[0]) / aspect, Math.abs(y - box.middle[1])) / slope,
  );
  const target = add(middle, add(scaled(right, box.middle[0]), scaled(up, box.middle[1])));
  return { target, distance: 1.06 * need.reduce((most, value) => Math.max(most, value), 0) };
}

/** The way from the eye through a point of the picture, from the middle (−1 … 1, up and to the right). */
export function wayThrough({ back, right, up, slope }: Camera, aspect: number, x: number, y: number): number[] {
  return add(add(scaled(right, x * slope * aspect), scaled(up, y * slope)), scaled(back, -1));
}

/** Where a point is in the picture, from the middle; null behind the camera. */
export function seenAt(m: Matrix, point: Vector): [number, number] | null {
  const row = (k: number) => m[k] * point[0] + m[4 + k] * point[1] + m[8 + k] * point[2] + m[12 + k];
  const depth = row(3);
  return depth > 0 ? [row(0) / depth, row(1) / depth] : null;
}
