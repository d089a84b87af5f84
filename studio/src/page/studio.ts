/** One question at a time, the machine beside it, every answer kept by the server before it shows here. */

import { element } from "../viewer/dom.ts";
import { coordinateOf } from "../viewer/pose.ts";
import type { Viewer } from "../viewer/viewer.ts";
import { act } from "./acts.ts";
import { type Aim, aimAt, clicked, nextRound } from "./aim.ts";
import { fillCard } from "./card.ts";
import { type Drafts, writing } from "./drafts.ts";
import { Finder } from "./finder.ts";
import * as findings from "./findings.ts";
import { meaning } from "./keys.ts";
import { limitsWith, turnedRound } from "./joints.ts";
import * as lists from "./lists.ts";
import { around, opened, roleOf, stepped, unsolved, valueOf } from "./questions.ts";
import { asked, listen, type News, packing, token } from "./server.ts";
import type { JointEntry, JointState, Pattern, Question, State } from "./state.ts";
import { wiggler } from "./wiggle.ts";

export const by = <T extends HTMLElement = HTMLElement>(id: string): T => document.getElementById(id) as T;
const dialog = (id: string): HTMLDialogElement => by<HTMLDialogElement>(id);

export class Studio {
  state!: State;
  questions: Question[] = [];
  at = 0;
  /** Numbers of the parts that are selected. */
  selection = new Set<number>();
  /** Name of the joint that was chosen from the list. */
  picked: string | null = null;
  /** Where an axis is pointed at. */
  aim: Aim | null = null;
  mirror = false;
  /** Messages that are not answered yet. */
  waiting = 0;
  /** Part → its number. */
  numbers = new Map<string, number>();
  readonly drafts: Drafts = new Map();
  private readonly finder: Finder;
  private readonly wiggled: ReturnType<typeof wiggler>;
  private ruled: (Pick<Pattern, "pattern" | "ruled"> & { selection: Set<number>; size: number }) | null = null;
  private sent: Promise<unknown> = Promise.resolve();
  private answered = new Map<string, number>();
  private asking = false;
  private about: string | undefined;
  private changes = 0;
  private silence: number | undefined;

  /** `drawn`: version of the machine on the screen. */
  constructor(readonly viewer: Viewer, private drawn: number) {
    this.number();
    this.wiggled = wiggler(viewer);
    this.finder = new Finder(dialog("finder"), by<HTMLInputElement>("find"), by("found"),
      (numbers, more) => this.select(more ? [...this.selection, ...numbers] : numbers));
  }

  /** Hears the person and the server. */
  listen(): void {
    by("undo").onclick = () => this.say("undo", {});
    by("redo").onclick = () => this.say("redo", {});
    by("build").onclick = () => this.build();
    by("help").onclick = () => this.keys();
    document.addEventListener("keydown", (event) => this.key(event));
    document.addEventListener("keydown", (event) => this.roundKey(event), true); // before the picture turns
    listen((news) => void this.heard(news), (silent) => {
      if (silent) this.tell("The studio does not answer. Is it still running? What was decided is kept.", true);
      else by("told").hidden = true;
    });
  }

  private async heard({ version, changes }: News): Promise<void> {
    const newer = version > (this.state?.version ?? 0) || changes !== this.changes;
    this.changes = changes;
    if (newer) await this.load();
  }

  async load(): Promise<void> {
    await this.take(await asked<State>("state"));
  }

  /** A state of the server's: shown at once, the machine as soon as it is there. */
  async take(state: State): Promise<void> {
    if (this.state && (state.version < this.state.version || state.said < this.state.said)) return;
    const key = this.question?.key;
    // What was answered and is not solved yet is not asked again.
    this.answered = unsolved(this.answered, state.solved);
    const known = this.state?.remarks;
    this.state = state;
    const news = known ? state.remarks.filter((remark) => !known.includes(remark)) : [];
    if (news.length) this.tell(`Done as decided. ${news.map((remark) => `${remark}.`).join(" ")}`);
    this.open(key);
    this.show();
    if (state.version !== this.drawn) {
      const model = await packing("machine");
      if (model.version > this.drawn) {
        this.drawn = model.version;
        this.viewer.update(model);
        this.number();
      }
    }
    this.show();
  }

  private number(): void {
    this.numbers = new Map(this.viewer.model.parts.map((part) => [part.path, part.number]));
  }

  /** The questions that are open, the one of that key before the reader, or the one that took its place. */
  private open(key: string | undefined): void {
    Object.assign(this, opened(this.state.questions, this.answered, key, this.at));
  }

  /** Goes to the next question before the answer to the last is solved. */
  private ask(): void {
    this.open(this.question?.key);
    this.show();
    if (this.shown.size) this.viewer.focus(this.shown);
    this.wiggle();
  }

  get question(): Question | undefined {
    return this.questions[this.at];
  }

  /** The joint that is chosen from the list, else the one that is asked about. */
  get joint(): JointState | null {
    const asks = !this.selection.size && this.question?.kind === "joint" ? this.question.key.slice("joint:".length) : null;
    const name = this.picked ?? asks;
    return (name && this.state.joints.find((joint) => joint.name === name)) || null;
  }

  /** Numbers of the parts that are shown: what is selected, else what the question is about. */
  get shown(): Set<number> {
    if (this.selection.size) return this.selection;
    const { joint } = this;
    const { parts, bodies } = this.viewer.model;
    if (joint) return new Set(parts.filter((part) => joint.bodies.includes(bodies[part.body].name)).map((part) => part.number));
    return new Set(this.numbered(this.question?.parts ?? []));
  }

  private numbered(paths: readonly string[]): number[] {
    return paths.map((path) => this.numbers.get(path)).filter((number) => number != null);
  }

  private paths(numbers: Iterable<number>): string[] {
    return [...numbers].map((number) => this.viewer.model.parts[number - 1].path);
  }

  /** The pattern that is answered for, as long as what is selected is what fits it. */
  get pattern(): Pick<Pattern, "pattern" | "ruled"> | null {
    return this.ruled?.selection === this.selection && this.ruled.size === this.selection.size ? this.ruled : null;
  }

  /** Numbers of the parts that an answer gives a role to. */
  get meant(): Set<number> {
    return this.selection.size || (this.question?.kind === "parts" && !this.picked) ? this.shown : new Set();
  }

  // ---- saying ------------------------------------------------------------------------------------------------------
  /** Sends what was said, in the order it was said; the next question is asked at once. Gives whether it was taken. */
  say(path: string, body: unknown, about: string | null | undefined = path === "do" && !this.selection.size && !this.picked ? this.question?.key : null): Promise<boolean> {
    this.mirror = false;
    this.aim = null;
    if (about) this.answered.set(about, Infinity);
    if (path === "do") this.selection.clear();
    this.waiting++;
    const sent = this.sent.then(() => this.send(path, body, about));
    this.sent = sent;
    if (about) this.ask();
    return sent;
  }

  private async send(path: string, body: unknown, about: string | null | undefined): Promise<boolean> {
    let taken = false;
    try {
      const state = await asked<State>(path, body);
      taken = true;
      if (about) this.answered.set(about, state.said);
      await this.take(state);
    } catch (error) {
      if (about && !taken) this.answered.delete(about);
      this.tell((error as Error).message);
      await this.load().catch(() => null);
    } finally {
      this.waiting--;
    }
    return taken;
  }

  /** Says something of the whole machine, `name=text`. */
  whole(answer: string, about?: string | null): Promise<boolean> {
    const at = answer.indexOf("=");
    return this.say("do", { kind: "machine", name: answer.slice(0, at), text: answer.slice(at + 1) }, about);
  }

  /** The meant parts are no part of the machine; a role that is missing is not drawn. */
  none(): unknown {
    const { question } = this;
    if (question?.kind === "role" && !this.selection.size && !this.picked) return this.whole(`${question.absent}=absent`);
    return this.assign(null);
  }

  /** Gives the meant parts a role; `null`: no part of the machine. */
  assign(role: string | null): unknown {
    if (this.pattern) return this.say("do", { kind: "rule", name: this.pattern.pattern, text: role ?? "none" });
    const parts = this.paths(this.meant);
    if (!parts.length) return this.tell("Click a part first, or several with Shift.");
    return this.say("do", { kind: "role", parts: Object.fromEntries(parts.map((path) => [path, role])), mirror: this.mirror });
  }

  yes(): unknown {
    const { question, joint } = this;
    if (joint) return this.sayAxis(this.aim?.found?.entry ?? joint.axis);
    if (!this.selection.size && question?.kind === "machine") return this.whole(question.yes);
    if (!this.selection.size && question?.kind === "value") return this.answer(0);
    if (this.selection.size && question?.kind === "role") return this.assign(roleOf(question));
    const parts = [...this.meant].map((number) => this.viewer.model.parts[number - 1]);
    if (!parts.length) return this.tell("Click the part that it is.");
    if (this.pattern) {
      const [role, ...others] = new Set(parts.map((part) => part.role || null));
      return others.length ? this.tell("They have several roles: find the one of all with /.") : this.assign(role);
    }
    return this.say("do", {
      kind: "confirm", mirror: this.mirror,
      parts: Object.fromEntries(parts.map((part) => [part.path, part.role || null])),
    });
  }

  /** The numbered answer to the question. */
  answer(index: number): unknown {
    const { question, joint } = this;
    if (joint) return joint.others[index] && this.sayAxis(JSON.parse(joint.others[index][0]));
    const candidate = question?.candidates[index];
    if (!question || !candidate) return;
    if (question.kind === "machine") return this.whole(candidate.answer);
    if (question.kind === "value") return this.give(valueOf(question), candidate.answer);
    if (question.kind === "parts") return this.assign(candidate.answer);
    return this.say("do", { kind: "role", parts: { [candidate.answer]: roleOf(question) }, mirror: this.mirror });
  }

  give(name: string, text: string): Promise<boolean> {
    return this.say("do", { kind: "value", name, text });
  }

  /** The dialog opens at once: later it would take the focus from what is written meanwhile. */
  async build(): Promise<void> {
    if (!this.state) return;
    this.asking = true;
    this.showBuild();
    if (!dialog("building").open) dialog("building").showModal();
    const begun = await this.say("build", {});
    this.asking = false;
    this.showBuild();
    if (!begun) dialog("building").close();
  }

  // ---- joints ------------------------------------------------------------------------------------------------------
  /** Says more of the joint; what was said of it before stays. */
  sayJoint(change: JointEntry): Promise<boolean> | null {
    const { joint } = this;
    if (!joint) return this.tell("Choose a joint first, in the list of joints.");
    const entry = Object.entries({ ...joint.entry, ...change }).filter(([, said]) => said !== undefined);
    return this.say("do", { kind: "joint", name: joint.name, entry: Object.fromEntries(entry) });
  }

  sayAxis(entry: JointEntry | null): Promise<boolean> | null {
    if (!entry || !Object.keys(entry).length) return this.tell("Its axis is not known: point at it with P.");
    return this.sayJoint({ anchor: undefined, axis: undefined, through: undefined, ...entry });
  }

  /** Turns a slide round, and so the way that counts as out. */
  reverse(): unknown {
    const { joint } = this;
    if (joint && joint.type !== "prismatic") return this.tell("Pivots all turn the same way round: to the left, up, or forward. A slide has a way of its own.");
    return this.sayAxis(joint && turnedRound(joint));
  }

  /** Where the joint is now becomes its lower (0) or upper (1) stop. */
  stop(end: number): unknown {
    const { joint, viewer } = this;
    const built = viewer.model.joints.find((each) => each.name === joint?.name);
    const value = built && coordinateOf(built, viewer.pose);
    if (!joint || value == null) return this.tell("This joint cannot be moved yet.");
    return this.sayJoint({ Limit: limitsWith(joint, end, value) });
  }

  /** Begins to point at the joint's axis, or ends it. */
  point(): unknown {
    if (!this.joint) return this.tell("Choose a joint first, in the list of joints.");
    this.aim = this.aim ? null : aimAt(this.joint.name);
    return this.show();
  }

  /** Arrow keys, while an axis is pointed at: the next round thing near the joint, or the one before. */
  private roundKey(event: KeyboardEvent): void {
    const way = ({ ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 } as Record<string, number>)[event.key];
    const target = event.target as Element;
    if (!way || !this.aim || document.querySelector("dialog[open]") || target.closest("input, textarea, select, [role=tab]")) return;
    event.preventDefault();
    event.stopPropagation();
    const { aim } = this;
    void nextRound(aim, way).then((any) => {
      if (this.aim !== aim) return;
      if (any) this.show();
      else this.tell("Nothing of the joint's two bodies is round: type its axis.");
    });
  }

  /** A click while an axis is pointed at. */
  private async aimed(aim: Aim, event: MouseEvent): Promise<void> {
    const box = this.viewer.canvas.getBoundingClientRect();
    const hit = this.viewer.surfaceAt(event.clientX - box.left, event.clientY - box.top);
    if (!hit) return;
    await clicked(aim, hit, event.altKey);
    this.show();
  }

  choosesJoint(name: string): void {
    this.picked = name;
    this.aim = null;
    this.selection.clear();
    this.show();
    if (this.shown.size) this.viewer.focus(this.shown);
  }

  // ---- showing -----------------------------------------------------------------------------------------------------
  tell(text: string, stays = false): null {
    const told = by("told");
    told.textContent = text;
    told.hidden = false;
    clearTimeout(this.silence);
    if (!stays) this.silence = window.setTimeout(() => (told.hidden = true), 5000);
    return null;
  }

  show(): void {
    const { state, questions, joint, aim } = this;
    document.title = `${state.machine} – yellowiron studio`;
    by("machine").textContent = state.machine;
    by("file").textContent = state.file;
    by("saved").textContent = state.solved < state.said ? "Kept, solving …" : state.said ? "Kept" : "";
    by("verdict").title = `${state.verdict} ${state.tally}`;
    by("verdict").replaceChildren(element("b", {}, state.verdict), ` ${state.tally}`);
    const done = state.history.filter((entry) => entry.holds).length;
    by<HTMLButtonElement>("undo").disabled = done === 0;
    by<HTMLButtonElement>("redo").disabled = done === state.history.length;
    by("count").textContent = `${questions.length} ${questions.length === 1 ? "question" : "questions"}`;
    by("place").textContent = questions.length ? `${this.at + 1} of ${questions.length}` : "";
    by("queue").replaceChildren(...lists.queue(questions, this.at, (index) => this.go(index)));
    by("queue").querySelector("[aria-current=true]")?.scrollIntoView({ block: "nearest" });
    this.showCard();
    by("history").replaceChildren(...lists.history(state));
    by("values").replaceChildren(...lists.values(state.values, (page, file) => this.sheet(page, file)));
    by("joints").replaceChildren(...lists.joints(state.joints, joint, (name) => this.choosesJoint(name)));
    this.showBuild();
    this.viewer.light(this.shown);
    const number = aim?.found && this.numbers.get(aim.found.part);
    const meant = aim?.found && number ? [{ number, point: aim.found.point, direction: aim.found.direction }] : [];
    const ahead = !joint && !this.selection.size && this.question?.key === "machine:forward";
    this.viewer.showAxes([...(joint ? [joint.name] : []), ...meant, ...(ahead ? [{ ahead } as const] : [])]);
    this.viewer.canvas.style.cursor = aim ? "crosshair" : "";
  }

  /** What a person is writing in stays, and a list that is open, whatever becomes known meanwhile. */
  private showCard(): void {
    const card = by("card");
    const about = this.joint?.name ?? (this.selection.size ? [...this.selection].join() : this.question?.key);
    const chooses = document.activeElement instanceof HTMLSelectElement && card.contains(document.activeElement);
    if (writing(card) || (chooses && about === this.about)) return;
    this.about = about;
    fillCard(this, card);
  }

  private showBuild(): void {
    by<HTMLButtonElement>("build").disabled = this.state.build.state === "running";
    dialog("building").replaceChildren(...lists.built(this.state, this.asking, dialog("building")));
  }

  sheet(number: number, file: string): void {
    const source = `sheet/${number}?file=${encodeURIComponent(file)}&token=${encodeURIComponent(token)}`;
    lists.sheet(source, number, dialog("sheet"));
  }

  keys(): void {
    lists.keys(dialog("keys"));
  }

  go(index: number): void {
    const count = this.questions.length;
    if (!count) return;
    this.at = (index + count) % count;
    this.selection.clear();
    this.picked = this.aim = null;
    this.show();
    if (this.shown.size) this.viewer.focus(this.shown);
    this.wiggle();
  }

  /** Chooses a part that was clicked; with Shift it joins the others. */
  choose(number: number, event: MouseEvent | null): unknown {
    if (this.aim && event) return this.aimed(this.aim, event);
    this.picked = null;
    const several = event?.shiftKey;
    if (!number) this.selection.clear();
    else if (several && this.selection.has(number)) this.selection.delete(number);
    else this.selection = new Set(several ? [...this.selection, number] : [number]);
    return this.show();
  }

  select(numbers: readonly number[]): void {
    this.choose(0, null);
    this.selection = new Set(numbers);
    this.show();
    this.viewer.focus(this.shown);
  }

  /** Takes in the assembly around what is selected, one level at a time. */
  assembly(): unknown {
    const { parts } = this.viewer.model;
    const paths = this.paths(this.meant);
    if (!paths.length) return this.tell("Click a part first.");
    const inside = around(paths, parts.map((part) => part.path));
    if (!inside) return this.tell("No assembly is around these parts.");
    this.selection = new Set(this.numbered(inside));
    return this.show();
  }

  mirrored(): void {
    this.mirror = !this.mirror;
    this.show();
  }

  nothing(): void {
    this.selection.clear();
    this.picked = this.aim = null;
    this.show();
  }

  isolate(): void {
    const { shown } = this;
    const hidden = this.viewer.model.parts.some((part) => part.hidden);
    this.viewer.show((part) => hidden || !shown.size || shown.has(part.number));
  }

  wiggle(): void {
    this.wiggled(this.shown);
  }

  /** Selects the next part (1), or the one before (-1): of several that are asked about, else of the file. */
  step(way: number): void {
    const { question, selection } = this;
    const asks = question?.kind === "parts" && !this.picked ? this.numbered(question.parts).sort((a, b) => a - b) : [];
    const within = asks.length > 1 && [...selection].every((number) => asks.includes(number));
    const numbers = within ? asks : this.viewer.model.parts.filter((part) => !part.hidden).map((part) => part.number);
    if (numbers.length) this.select([stepped(numbers, within ? selection : this.shown, way)]);
  }

  // ---- finding -----------------------------------------------------------------------------------------------------
  /** Finds a role for what is meant. */
  find(): unknown {
    if (!this.meant.size) return this.tell("Click a part first, or several with Shift; S finds one by its name.");
    return this.finder.open(findings.roles(this));
  }

  overall(): unknown {
    return this.finder.open(findings.ofWhole(this));
  }

  search(): unknown {
    return this.finder.open(findings.named(this));
  }

  rules(): unknown {
    return this.finder.open(findings.patterns(this, this.paths(this.meant))).catch((error: Error) => this.tell(error.message));
  }

  /** Selects what fits a pattern: it is what is answered for next. */
  rule({ pattern, parts, ruled }: Pattern): void {
    this.select(this.numbered(parts));
    this.ruled = { pattern, ruled, selection: this.selection, size: this.selection.size };
    this.show();
  }

  // ---- keys --------------------------------------------------------------------------------------------------------
  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]")) return;
    const target = event.target as HTMLElement;
    if (target.closest("input, textarea, select")) {
      if (event.key === "Escape") target.blur();
      return;
    }
    // A button that has the focus is pressed by Enter itself.
    if (event.key === "Enter" && target.closest("button, summary")) return;
    const meant = meaning(event);
    if (!meant || !this.state) return; // before that, the page says that it loads
    event.preventDefault();
    act(this, meant);
  }
}
