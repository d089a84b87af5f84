/** What is said of a joint, from how it is. */

import type { JointEntry, JointState } from "./state.ts";

/** A slide's axis the other way round: as a person gave it, else as it was found; null: it is not known. */
export function turnedRound({ entry, axis: found }: Pick<JointState, "entry" | "axis">): JointEntry | null {
  const { through, anchor, axis } = entry.through || entry.axis ? entry : found;
  if (through) return { through: [through[1], through[0], ...through.slice(2)] };
  return axis ? { anchor, axis: axis.map((value) => -value) } : null;
}

/** Its limits (metres or degrees from where it is undriven) with the lower (0) or upper (1) at a coordinate. */
export function limitsWith(joint: Pick<JointState, "type" | "began" | "entry" | "limits">, end: number, value: number): (number | null)[] {
  const unit = joint.type === "prismatic" ? 1 : 180 / Math.PI;
  const counted = (limit: number) => Number(((limit + joint.began) * unit).toFixed(5));
  const limits = [...(joint.entry.Limit ?? joint.limits.map((limit) => (limit == null ? null : counted(limit))))];
  limits[end] = counted(value);
  return limits;
}
