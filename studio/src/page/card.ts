/** The card: what is asked, or what is selected, with its answers. */

import { button, element, sentence, words } from "../viewer/dom.ts";
import type { Part } from "../viewer/model.ts";
import { fieldOf } from "./drafts.ts";
import { amount, counted, roleOf, valueOf } from "./questions.ts";
import type { JointState, Question } from "./state.ts";
import type { Studio } from "./studio.ts";

interface Answers {
  list: HTMLElement;
  add(key: string | number, text: string, act: () => unknown, yes?: boolean): void;
}

function answersOf(): Answers {
  const list = element("ol", { class: "answers" });
  const add: Answers["add"] = (key, text, act, yes = false) =>
    list.append(element("li", {}, element("button", { type: "button", class: yes ? "yes" : false, onclick: act },
      element("kbd", {}, String(key)), element("span", {}, text))));
  return { list, add };
}

const eyebrow = (text: string): HTMLElement => element("p", { class: "eyebrow" }, text);
const heading = (text: string): HTMLElement => element("h2", {}, text);
const why = (text: string): HTMLElement => element("p", { class: "why" }, text);
const more = (...children: (Node | null)[]): HTMLElement => element("div", { class: "more" }, ...children);

export function fillCard(studio: Studio, card: HTMLElement): void {
  const { question, joint } = studio;
  const picked = [...studio.selection].map((number) => studio.viewer.model.parts[number - 1]);
  card.className = picked.length || (joint && studio.picked) ? "picked" : question || joint ? "" : "done";
  if (joint) card.replaceChildren(...ofJoint(studio, joint));
  else if (picked.length) card.replaceChildren(...ofPicked(studio, picked));
  else if (question) card.replaceChildren(...ofQuestion(studio, question));
  else card.replaceChildren(
    eyebrow("Nothing left to ask"), heading("Build the machine"),
    why(studio.state.causes.map((cause) => cause.words).join(" ") || "Every part, joint and value is settled."),
    more(button("B  build", () => studio.build())),
  );
}

/** What else can be said of parts. */
function rest(studio: Studio, picked: boolean): HTMLElement {
  const absent = !picked && studio.question?.kind === "role";
  return more(
    button(absent ? "X  not drawn" : "X  none", () => studio.none()), button("/  find a role", () => studio.find()),
    button("A  assembly", () => studio.assembly()), button("E  all named so", () => studio.rules(), { "aria-pressed": Boolean(studio.pattern) }),
    studio.pattern ? null : button("M  other side too", () => studio.mirrored(), { "aria-pressed": studio.mirror }),
    button("I  isolate", () => studio.isolate()), button("F  look", () => studio.viewer.focus(studio.shown)),
  );
}

function ofPicked(studio: Studio, picked: Part[]): HTMLElement[] {
  const { question, pattern } = studio;
  const [first] = picked;
  const roles = [...new Set(picked.map((part) => words(part.role) || "no part of the machine"))];
  const { list, add } = answersOf();
  if (question?.kind === "role") add("⏎", `It is the ${words(roleOf(question))}`, () => studio.yes(), true);
  else if (!pattern || roles.length === 1) add("⏎", "Right as it is", () => studio.yes(), true);
  const others = rest(studio, true);
  if (pattern?.ruled) others.append(button("Take back", () => studio.say("do", { kind: "rule", name: pattern.pattern, text: "" })));
  const sure = first.confidence == null ? "" : ` (${Math.round(100 * first.confidence)} %)`;
  return [
    eyebrow(pattern ? `All that is named ${pattern.pattern} · ${counted(picked.length)}`
      : picked.length > 1 ? `${picked.length} parts selected` : `Selected: ${first.name}`),
    heading(sentence(roles.slice(0, 3).join(", ")) + (roles.length > 3 ? " …" : "")),
    why(picked.length > 1 ? "" : `${first.reason}${sure}`),
    list, others,
  ];
}

function ofQuestion(studio: Studio, question: Question): HTMLElement[] {
  const { kind, page } = question;
  const about = { machine: "The whole machine", parts: "Is that right?", role: "Missing", value: "Value", joint: amount(question) }[kind];
  const made = [eyebrow(about), heading(question.title), why(question.reason)];
  for (const known of question.known) made.push(element("p", { class: "known" }, known));
  if (question.parts.length > 1) made.push(element("p", { class: "names" }, question.parts.map((path) => path.split("/").pop()).join(", ")));
  const { list, add } = answersOf();
  if (kind === "parts" || kind === "machine") add("⏎", "Yes", () => studio.yes(), true);
  question.candidates.forEach((candidate, index) => {
    const first = kind === "value" && !index;
    add(first ? "⏎" : index + 1, candidate.words, () => studio.answer(index), first);
  });
  made.push(list);
  if (kind === "value") made.push(valueForm(studio, question));
  else if (kind === "machine") made.push(more(button("V  more of the whole machine", () => studio.overall())));
  else made.push(rest(studio, false));
  if (page != null) made.push(more(button(`Page ${page} of the sheet`, () => studio.sheet(page, question.file))));
  return made;
}

function valueForm(studio: Studio, question: Question): HTMLElement {
  return fieldOf(studio.drafts, question.key, { placeholder: "1400 mm", label: question.title },
    (text) => (text ? studio.give(valueOf(question), text) : null), () => studio.show());
}

function ofJoint(studio: Studio, joint: JointState): HTMLElement[] {
  const { aim, state } = studio;
  const how = { found: "Found", guess: "A guess", given: "Given by a person", none: "Not found" }[joint.known];
  const kinds = { Revolute: "turns", Prismatic: "slides", Spherical: "ball", Fixed: "fixed" };
  const bodies = [...new Set(state.roles.map((role) => role.body))];
  const choice = (label: string, options: [string, string][], chosen: string, act: (value: string) => unknown) =>
    element("label", {}, label, element("select", { onchange: (event: Event) => act((event.target as HTMLSelectElement).value) },
      ...options.map(([value, text]) => element("option", { value, selected: value === chosen }, text))));
  const { list, add } = answersOf();
  if (aim ? aim.found : Object.keys(joint.axis).length) add("⏎", aim ? "Its axis is there" : "Yes, its axis is right", () => studio.yes(), true);
  if (!aim) joint.others.forEach(([, text], index) => add(index + 1, text, () => studio.answer(index)));
  const typed = `joint:${joint.name}`;
  const form = fieldOf(studio.drafts, typed, { placeholder: "x y z, direction x y z (m)", label: "Axis" }, (text) => {
    const numbers = text.split(/[\s,;]+/).filter(Boolean).map(Number);
    if (numbers.length === 6 && numbers.every((value) => Number.isFinite(value)))
      return studio.sayAxis({ anchor: numbers.slice(0, 3), axis: numbers.slice(3) });
    studio.tell("Six numbers: a point of the axis in metres, and its direction.");
    return null;
  }, () => studio.show());
  const { name, entry } = joint;
  return [
    eyebrow(`Joint · ${how}`), heading(joint.title), why(aim ? "" : joint.reason),
    ...(aim ? [element("p", { class: "known" }, aim.said)] : []),
    list,
    more(
      button(aim ? "P  stop pointing" : "P  point at its axis", () => studio.point(), { "aria-pressed": Boolean(aim) }),
      joint.type === "prismatic" ? button("R  other way round", () => studio.reverse()) : null,
      button("[  lower stop here", () => studio.stop(0)), button("]  upper stop here", () => studio.stop(1)),
      button("W  move", () => studio.wiggle()),
      Object.keys(entry).length ? button("Take back", () => studio.say("do", { kind: "joint", name, entry: {} })) : null,
    ),
    element("details", { open: studio.drafts.has(typed) }, element("summary", {}, "Type, bodies, typed axis"), element("div", { class: "t-more" },
      choice("It ", Object.entries(kinds), sentence(joint.type), (value) => studio.sayJoint({ joint_type: value })),
      ...[0, 1].map((end) => choice(end ? "and " : "Between ", bodies.map((body) => [body, words(body)]), joint.bodies[end],
        (value) => studio.sayJoint({ Body: end ? [joint.bodies[0], value] : [value, joint.bodies[1]] }))), form)),
  ];
}
