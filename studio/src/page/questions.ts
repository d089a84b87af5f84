/** Which question is asked, and what parts are stepped to: without a page. */

import type { Question } from "./state.ts";

export const counted = (count: number): string => `${count} ${count === 1 ? "part" : "parts"}`;

/** What a question is about, in a word. */
export const amount = (question: Pick<Question, "kind" | "parts">): string =>
  ({ machine: "machine", parts: counted(question.parts.length), role: "missing", value: "value", joint: "joint" })[question.kind];

/** The role that a question about a missing one asks for. */
export const roleOf = (question: Pick<Question, "key">): string => question.key.slice("role:".length);
/** The value that a question asks for. */
export const valueOf = (question: Pick<Question, "title">): string => question.title.replace(/\?$/, "");

/** Key of a question → how much was said when it was answered; Infinity while the server does not know of it. */
export type Answered = ReadonlyMap<string, number>;

/** What is still unsolved of what was answered: it is not asked again. */
export const unsolved = (answered: Answered, solved: number): Map<string, number> => new Map([...answered].filter(([, said]) => said > solved));

/** The questions that are open; and where among them the one of that key is, else the one that took its place. */
export function opened(questions: readonly Question[], answered: Answered, key: string | undefined, at: number): { questions: Question[]; at: number } {
  const left = questions.filter((question) => !answered.has(question.key));
  const same = left.findIndex((question) => question.key === key);
  return { questions: left, at: same >= 0 ? same : Math.min(at, Math.max(left.length - 1, 0)) };
}

/** The parts of the smallest assembly around some that holds more than they are, one level at a time; null: none. */
export function around(paths: readonly string[], all: readonly string[]): string[] | null {
  const steps = paths.map((path) => path.split("/"));
  const above = (depth: number) => `${steps[0].slice(0, depth).join("/")}/`;
  let depth = Math.min(...steps.map((each) => each.length - 1));
  while (depth && paths.some((path) => !path.startsWith(above(depth)))) depth--;
  for (; depth > 0; depth--) {
    const inside = all.filter((path) => path.startsWith(above(depth)));
    if (inside.length > paths.length) return inside;
  }
  return null;
}

/** The number after those that are there (way 1), or before them (-1), around the end of a list. */
export function stepped(numbers: readonly number[], there: ReadonlySet<number>, way: number): number {
  const from = way > 0 ? Math.max(...there) : Math.min(...there);
  const at = there.size ? numbers.indexOf(from) : way > 0 ? -1 : 0;
  return numbers[(at + way + numbers.length) % numbers.length];
}
