/** What stands beside the questions: the queue of them, the tabs, and the dialogs. */

import { button, element } from "../viewer/dom.ts";
import { KEYS } from "./keys.ts";
import { amount, valueOf } from "./questions.ts";
import type { JointState, Question, SheetValue, State } from "./state.ts";

const none = (text: string): HTMLElement => element("p", { class: "dim" }, text);
const listed = (rows: HTMLElement[], otherwise: string): HTMLElement => (rows.length ? element("ol", {}, ...rows) : none(otherwise));
const closing = (dialog: HTMLDialogElement): HTMLElement => element("div", { class: "more" }, button("Close", () => dialog.close()));

export const queue = (questions: readonly Question[], at: number, go: (index: number) => void): HTMLElement[] =>
  questions.map((question, index) => element("li", {}, element("button", {
    type: "button", "aria-current": index === at, onclick: () => go(index),
  }, element("span", {}, valueOf(question)), element("span", {}, amount(question)))));

export function joints(all: readonly JointState[], chosen: JointState | null, choose: (name: string) => void): HTMLElement[] {
  const tags = { found: ["ok", "found"], guess: ["review", "guess"], given: ["ok", "given"], none: ["missing", "none"] };
  const rows = all.map((joint) => element("li", { class: "t-value" },
    button(joint.title, () => choose(joint.name), { class: "v-name", "aria-current": joint === chosen }),
    element("span", { class: `tag ${tags[joint.known][0]}` }, tags[joint.known][1])));
  return [listed(rows, "No joints yet.")];
}

export function history({ history: said, remarks }: Pick<State, "history" | "remarks">): HTMLElement[] {
  const rows = said.map((entry) => element("li", { class: entry.holds ? false : "gone" }, entry.words,
    element("small", {}, [entry.by, entry.date].filter(Boolean).join(", "))));
  return [...remarks.map((remark) => element("p", { class: "known" }, `${remark}.`)), listed(rows.reverse(), "Nothing decided yet.")];
}

export function values(all: readonly SheetValue[], sheet: (page: number, file: string) => void): HTMLElement[] {
  const rows = all.filter((value) => value.value != null || value.status !== "missing").map((value) => {
    const { page } = value;
    return element("li", { class: "t-value" }, element("b", {}, value.name),
      page == null ? element("span") : button(`p. ${page}`, () => sheet(page, value.file)),
      element("span", {}, value.value == null ? "–" : `${Number(value.value.toPrecision(6))} ${value.unit}`),
      element("span", { class: `tag ${value.status}` }, value.source === "set" ? "given" : value.status));
  });
  return [listed(rows, "No sheet was read.")];
}

/** How the build goes; `asked`: the server has not answered yet. */
export function built({ build }: Pick<State, "build">, asked: boolean, dialog: HTMLDialogElement): HTMLElement[] {
  const said = { none: "", running: "Building …", ready: "Built: ready to simulate.", short: "Built, with points left open: the report says which.", failed: "The build failed." };
  return [
    element("b", {}, asked ? "What was said is kept first, then it builds …" : said[build.state]), element("pre", {}, build.lines.join("\n")),
    element("span", { class: "dim" }, "The same from the command line:"), element("code", {}, build.command), closing(dialog),
  ];
}

export function sheet(source: string, number: number, dialog: HTMLDialogElement): void {
  dialog.replaceChildren(element("img", { src: source, alt: `Page ${number} of the sheet, values boxed` }), closing(dialog));
  dialog.showModal();
}

export function keys(dialog: HTMLDialogElement): void {
  const rows = KEYS.flatMap(([key, text]) => [element("dt", {}, element("kbd", {}, key)), element("dd", {}, text)]);
  dialog.replaceChildren(element("b", {}, "Keys"), element("dl", {}, ...rows), closing(dialog));
  dialog.showModal();
}
