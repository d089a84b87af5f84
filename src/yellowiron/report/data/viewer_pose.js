// How the machine moves: 4 × 4 matrices (column-major arrays of 16), pose tables, the screws of the tree.

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const scaled = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => scaled(a, 1 / Math.hypot(...a));

function multiply(a, b) {
  const out = new Array(16);
  for (let column = 0; column < 4; column++)
    for (let row = 0; row < 4; row++) {
      let sum = 0;
      for (let k = 0; k < 4; k++) sum += a[4 * k + row] * b[4 * column + k];
      out[4 * column + row] = sum;
    }
  return out;
}

/** The inverse of a placement, which may scale and mirror. */
function inverse(m) {
  const [a, b, c] = [0, 4, 8].map((k) => [m[k], m[k + 1], m[k + 2]]);
  const volume = dot(a, cross(b, c));
  const rows = [cross(b, c), cross(c, a), cross(a, b)].map((row) => scaled(row, 1 / volume));
  const ends = rows.map((row) => -dot(row, [m[12], m[13], m[14]]));
  return [0, 1, 2].flatMap((k) => [...rows.map((row) => row[k]), 0]).concat(ends, 1);
}

const moved = (m, p) => [0, 1, 2].map((row) => m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row]);
const turned = (m, v) => [0, 1, 2].map((row) => m[row] * v[0] + m[4 + row] * v[1] + m[8 + row] * v[2]);

/** The rotation of a unit quaternion (w, x, y, z) about a point. */
function rotation([w, x, y, z], point) {
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

/** First node and four weights of cubic Lagrange interpolation on an even axis [first, last, count]: exact at nodes. */
function weights([first, last, count], x) {
  const t = ((Math.min(Math.max(x, first), last) - first) / (last - first)) * (count - 1);
  const start = Math.min(Math.max(Math.floor(t) - 1, 0), count - 4);
  const weight = [0, 1, 2, 3].map((i) =>
    [0, 1, 2, 3].reduce((product, j) => (i === j ? product : (product * (t - start - j)) / (i - j)), 1),
  );
  return { start, weight };
}

/** A table's row at the drivers' coordinates. */
function interpolated(table, given) {
  const nodes = table.axes.map((axis, i) => weights(axis, given[table.drivers[i]] ?? 0));
  const columns = table.values.length / table.axes.reduce((product, axis) => product * axis[2], 1);
  const row = new Array(columns).fill(0);
  (function visit(depth, index, share) {
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
function treeOrder(model) {
  const reached = new Set([model.root]);
  const order = [];
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

function screw(joint, q) {
  if (joint.type === "prismatic") return [...IDENTITY.slice(0, 12), ...scaled(joint.axis, q), 1];
  if (joint.type === "revolute")
    return rotation([Math.cos(q / 2), ...scaled(joint.axis, Math.sin(q / 2))], joint.anchor);
  if (joint.type === "spherical") return rotation(scaled4(q), joint.anchor);
  return IDENTITY;
}

const scaled4 = (q) => q.map((value) => value / Math.hypot(...q));

/** Body → displacement from the drawn pose, for the given coordinates of independent joints. */
function poseOf(model, given) {
  const at = { ...given };
  const type = Object.fromEntries(model.joints.map((joint) => [joint.name, joint.type]));
  for (const table of model.tables) {
    const row = interpolated(table, given);
    let column = 0;
    for (const name of table.dependent) {
      if (type[name] === "spherical") at[name] = row.slice(column, (column += 4));
      else at[name] = row[column++];
    }
  }
  const pose = { [model.root]: IDENTITY };
  for (const joint of treeOrder(model)) {
    const still = joint.type === "spherical" ? [1, 0, 0, 0] : 0;
    pose[joint.child] = multiply(pose[joint.parent], screw(joint, at[joint.name] ?? still));
  }
  return pose;
}

/** A joint's coordinate in a pose: radians or metres from the drawn one; null where it has no single one. */
function coordinateOf(joint, pose) {
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
