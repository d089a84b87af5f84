/** How the machine moves: pose tables, and the screws of the tree. */

import type { Joint, Model, PoseTable } from "./model.ts";
import { add, cross, dot, IDENTITY, type Matrix, moved, multiply, rotation, scaled, turned, unit, type Vector } from "./vectors.ts";

/** Coordinates of independent joints by their names. */
export type Given = Record<string, number>;
/** Body → displacement from the drawn pose. */
export type Pose = Record<string, Matrix>;
/** What of a model moves. */
export type Moving = Pick<Model, "root" | "joints" | "tables">;

/** First node and four weights of cubic Lagrange interpolation on an even axis [first, last, count]: exact at nodes. */
function weights([first, last, count]: readonly [number, number, number], x: number): { start: number; weight: number[] } {
  const t = ((Math.min(Math.max(x, first), last) - first) / (last - first)) * (count - 1);
  const start = Math.min(Math.max(Math.floor(t) - 1, 0), count - 4);
  const weight = [0, 1, 2, 3].map((i) =>
    [0, 1, 2, 3].reduce((product, j) => (i === j ? product : (product * (t - start - j)) / (i - j)), 1),
  );
  return { start, weight };
}

/** A table's row at the drivers' coordinates. */
export function interpolated(table: PoseTable, given: Given): number[] {
  const nodes = table.axes.map((axis, i) => weights(axis, given[table.drivers[i]] ?? 0));
  const columns = table.values.length / table.axes.reduce((product, axis) => product * axis[2], 1);
  const row = new Array<number>(columns).fill(0);
  (function visit(depth: number, index: number, share: number) {
    if (depth === nodes.length) {
      for (let c = 0; c < columns; c++) row[c] += share * table.values[index * columns + c];
      return;
    }
    const { start, weight } = nodes[depth];
    weight.forEach((w, k) => visit(depth + 1, index * table.axes[depth][2] + start + k, share * w));
  })(0, 0, 1);
  return row;
}

/** Joints of the tree, parents before children. */
export function treeOrder(model: Moving): Joint[] {
  const reached = new Set([model.root]);
  const order: Joint[] = [];
  let waiting = model.joints.filter((joint) => !joint.cut);
  for (let before = -1; waiting.length && before !== order.length; ) {
    before = order.length;
    waiting = waiting.filter((joint) => {
      if (!reached.has(joint.parent)) return true;
      reached.add(joint.child);
      order.push(joint);
      return false;
    });
  }
  return order;
}

function screw(joint: Joint, q: number | Vector): Matrix {
  if (typeof q !== "number") return joint.type === "spherical" ? rotation(q.map((value) => value / Math.hypot(...q)), joint.anchor) : IDENTITY;
  if (joint.type === "prismatic") return [...IDENTITY.slice(0, 12), ...scaled(joint.axis, q), 1];
  if (joint.type === "revolute")
    return rotation([Math.cos(q / 2), ...scaled(joint.axis, Math.sin(q / 2))], joint.anchor);
  return IDENTITY;
}

/** Where every body is, for the given coordinates of independent joints. */
export function poseOf(model: Moving, given: Given): Pose {
  const at: Record<string, number | Vector> = { ...given };
  const type = Object.fromEntries(model.joints.map((joint) => [joint.name, joint.type]));
  for (const table of model.tables) {
    const row = interpolated(table, given);
    let column = 0;
    for (const name of table.dependent) {
      if (type[name] === "spherical") at[name] = row.slice(column, (column += 4));
      else at[name] = row[column++];
    }
  }
  const pose: Pose = { [model.root]: IDENTITY };
  for (const joint of treeOrder(model)) pose[joint.child] = multiply(pose[joint.parent], screw(joint, at[joint.name] ?? 0));
  return pose;
}

/** A joint's coordinate in a pose: radians or metres from the drawn one; null where it has no single one. */
export function coordinateOf(joint: Joint, pose: Pose): number | null {
  const parent = pose[joint.parent];
  const child = pose[joint.child];
  if (!parent || !child) return null;
  const axis = turned(parent, joint.axis);
  if (joint.type === "prismatic")
    return dot(add(moved(child, joint.anchor), scaled(moved(parent, joint.anchor), -1)), axis);
  if (joint.type !== "revolute") return null;
  const across = unit(cross(joint.axis, Math.abs(joint.axis[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]));
  const before = turned(parent, across);
  const after = turned(child, across);
  return Math.atan2(dot(axis, cross(before, after)), dot(before, after));
}
