/** What each key does, by its name, and the words for it. */

export const KEYS: [string, string][] = [
  ["⏎", "Yes"], ["1 – 9", "Instead: the numbered answer"], ["X", "No part of the machine; of a role that is missing: it is not drawn"], ["/", "Find any role"],
  ["S", "Find parts and joints by name; ⇧⏎ takes all parts that are listed, Alt⏎ adds one to what is selected"], ["N, ⇧N", "The next part of those that are asked about, or of the file; the one before"],
  ["J, K", "Next question, the one before"], ["U, ⇧U", "Undo, redo"], ["A", "Take in the assembly around what is selected"],
  ["E", "Everything that is named so: the next answer is kept as a pattern over the CAD tree"],
  ["M", "The same on the other side"], ["P", "Point at a joint's axis: a bore; two round things or points; three points of a circle; Alt: an edge; arrow keys: one round thing after the other"],
  ["R", "A slide the other way round"], ["[, ]", "The joint's lower and upper stop where it is now"],
  ["V", "The whole machine: which way it faces, which variant it is, what is not drawn"],
  ["I", "Only these parts, and all again"], ["F", "Look at these parts"],
  ["W", "Move what the question is about"], ["Esc", "Select nothing"], ["B", "Build"], ["?", "These keys"],
];

export type Act =
  | { act: "next" | "before" | "none" | "overall" | "find" | "search" | "assembly" | "rules" | "mirror" | "isolate" | "focus" | "wiggle" | "build" | "keys" }
  | { act: "undo" | "redo" | "nothing" | "yes" | "point" | "reverse" }
  | { act: "step"; way: number }
  | { act: "stop"; end: number }
  | { act: "answer"; index: number };

const PLAIN = {
  j: "next", k: "before", x: "none", v: "overall", "/": "find", s: "search", a: "assembly", e: "rules", m: "mirror", i: "isolate", f: "focus",
  w: "wiggle", b: "build", "?": "keys", escape: "nothing", enter: "yes", p: "point", r: "reverse",
} as const;

/** What a key means; null: nothing. */
export function meaning({ key, shiftKey }: Pick<KeyboardEvent, "key" | "shiftKey">): Act | null {
  const low = key.toLowerCase();
  if (Object.hasOwn(PLAIN, low)) return { act: PLAIN[low as keyof typeof PLAIN] };
  if (low === "u") return { act: shiftKey ? "redo" : "undo" };
  if (low === "n") return { act: "step", way: shiftKey ? -1 : 1 };
  if (low === "[" || low === "]") return { act: "stop", end: low === "[" ? 0 : 1 };
  return /^[1-9]$/.test(key) ? { act: "answer", index: Number(key) - 1 } : null;
}
