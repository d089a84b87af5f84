/** Pointing at a joint's axis: what the clicks so far mean, or one round thing after the other. */

import type { Hit } from "../viewer/viewer.ts";
import { asked } from "./server.ts";
import type { FoundAxis } from "./state.ts";

export interface Aim {
  picks: { part: string; point: number[]; edge: boolean }[];
  found: FoundAxis | null;
  said: string;
  /** Place of what was found among the joint's round things; -1: none. */
  at: number;
  rounds: Promise<FoundAxis[]>;
}

export const aimAt = (joint: string): Aim => ({
  picks: [], found: null, at: -1,
  said: "Click a bore or another round thing, with Alt an edge; or go through the round things there with the arrow keys.",
  rounds: asked<{ rounds: FoundAxis[] }>("rounds", { joint }).then(({ rounds }) => rounds, () => []),
});

/** The next round thing near the joint (way 1), or the one before; gives whether there is any. */
export async function nextRound(aim: Aim, way: number): Promise<boolean> {
  const rounds = await aim.rounds;
  if (!rounds.length) return false;
  aim.at = aim.at < 0 ? (way > 0 ? 0 : rounds.length - 1) : (aim.at + way + rounds.length) % rounds.length;
  const found = rounds[aim.at];
  Object.assign(aim, { picks: [], found, said: `${found.words} (${aim.at + 1} of ${rounds.length})` });
  return true;
}

/** One more click. */
export async function clicked(aim: Aim, hit: Hit, edge: boolean): Promise<void> {
  if (aim.picks.length === 3 || edge) aim.picks = [];
  aim.picks.push({ part: hit.part, point: hit.point, edge });
  try {
    const found = await asked<FoundAxis>("axis", { picks: aim.picks });
    Object.assign(aim, { found, said: found.words });
  } catch (error) {
    Object.assign(aim, { found: null, said: (error as Error).message });
  }
}
