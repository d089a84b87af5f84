// The studio: one question at a time, the machine beside it, every answer kept by the server before it shows here.

const token = new URLSearchParams(location.search).get("token") ?? "";
const by = (id) => document.getElementById(id);
const KEYS = [
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

async function ask(path, body) {
  const options = { headers: { "X-Yellowiron-Token": token } };
  if (body !== undefined) Object.assign(options, { method: "POST", body: JSON.stringify(body) });
  const answer = await fetch(path, options);
  if (!answer.ok) {
    const text = await answer.text();
    let said = text;
    try { said = JSON.parse(text).message ?? text; } catch { /* plain text */ }
    throw new Error(said);
  }
  return answer;
}

/** So many rows of what was found are shown at a time. */
const LISTED = 100;

const packing = async (path) => unpack(new Uint8Array(await (await ask(path)).arrayBuffer()));
const button = (label, onclick, attributes = {}) => element("button", { type: "button", onclick, ...attributes }, label);

class Studio {
  constructor(viewer, drawn) {
    this.viewer = viewer;
    this.drawn = drawn; // version of the machine on the screen
    this.selection = new Set();
    this.picked = null; // name of the joint that was chosen from the list
    this.aim = null; // where an axis was pointed at: clicks, and what they mean
    this.at = 0;
    this.mirror = false;
    this.ruled = null; // the pattern that the selection is of
    this.waiting = 0; // messages that are not answered yet
    this.sent = Promise.resolve();
    this.answered = new Map(); // key of a question → how much was said when it was answered
    by("undo").onclick = () => this.say("undo", {});
    by("redo").onclick = () => this.say("redo", {});
    by("build").onclick = () => this.build();
    by("help").onclick = () => this.keys();
    document.addEventListener("keydown", (event) => this.#key(event));
    document.addEventListener("keydown", (event) => this.#roundKey(event), true); // before the picture turns
    by("find").addEventListener("input", () => this.#list());
    by("find").addEventListener("keydown", (event) => this.#findKey(event));
    const events = new EventSource(`events?token=${encodeURIComponent(token)}`);
    events.onmessage = (event) => this.#heard(JSON.parse(event.data));
    events.onerror = () => this.tell("The studio does not answer. Is it still running? What was decided is kept.", true);
    events.onopen = () => (by("told").hidden = true);
  }

  /** Another window decided something, or a build goes on. */
  async #heard({ version, changes }) {
    const newer = version > (this.state?.version ?? 0) || changes !== this.changes;
    this.changes = changes;
    if (newer) await this.load();
  }

  async load() {
    await this.take(await (await ask("state")).json());
  }

  /** A state of the server's: shown at once, the machine as soon as it is there. */
  async take(state) {
    if (this.state && (state.version < this.state.version || state.said < this.state.said)) return;
    const key = this.question?.key;
    // What was answered and is not solved yet is not asked again.
    for (const [answered, said] of this.answered) if (said <= state.solved) this.answered.delete(answered);
    const known = this.state?.remarks;
    this.state = state;
    const news = known ? state.remarks.filter((remark) => !known.includes(remark)) : [];
    if (news.length) this.tell(`Done as decided. ${news.map((remark) => `${remark}.`).join(" ")}`);
    this.#open(key);
    this.show();
    if (state.version !== this.drawn) {
      const model = await packing("machine");
      this.drawn = model.version;
      this.viewer.update(model);
      this.numbers = new Map(model.parts.map((part) => [part.path, part.number]));
    }
    this.show();
  }

  /** The questions that are open, the one of that key before the reader, or the one that took its place. */
  #open(key) {
    this.questions = this.state.questions.filter((question) => !this.answered.has(question.key));
    const same = this.questions.findIndex((question) => question.key === key);
    this.at = same >= 0 ? same : Math.min(this.at, Math.max(this.questions.length - 1, 0));
  }

  /** Goes to the next question before the answer to the last is solved. */
  #ask() {
    this.#open(this.question?.key);
    this.show();
    if (this.shown.size) this.viewer.focus(this.shown);
    this.wiggle();
  }

  get question() {
    return this.questions?.[this.at];
  }

  /** The joint that is chosen from the list, else the one that is asked about. */
  get joint() {
    const asked = !this.selection.size && this.question?.kind === "joint" ? this.question.key.slice("joint:".length) : null;
    const name = this.picked ?? asked;
    return (name && this.state.joints.find((joint) => joint.name === name)) || null;
  }

  /** Numbers of the parts that are shown: what is selected, else what the question is about. */
  get shown() {
    if (this.selection.size) return this.selection;
    const { joint } = this;
    const { parts, bodies } = this.viewer.model;
    if (joint) return new Set(parts.filter((part) => joint.bodies.includes(bodies[part.body].name)).map((part) => part.number));
    return new Set((this.question?.parts ?? []).map((path) => this.numbers.get(path)).filter(Boolean));
  }

  /** The pattern that is answered for, as long as what is selected is what fits it. */
  get pattern() {
    return this.ruled?.selection === this.selection && this.ruled.size === this.selection.size ? this.ruled : null;
  }

  /** Numbers of the parts that an answer gives a role to. */
  get meant() {
    return this.selection.size || (this.question?.kind === "parts" && !this.picked) ? this.shown : new Set();
  }

  // ---- saying ------------------------------------------------------------------------------------------------------
  /** Sends what was said, in the order it was said; the next question is asked at once. */
  say(path, body, about = path === "do" && !this.selection.size && !this.picked ? this.question?.key : null) {
    this.mirror = false;
    this.aim = null;
    if (about) this.answered.set(about, Infinity);
    if (path === "do") this.selection.clear();
    this.waiting++;
    this.sent = this.sent.then(() => this.#send(path, body, about));
    if (about) this.#ask();
    return this.sent;
  }

  async #send(path, body, about) {
    try {
      const state = await (await ask(path, body)).json();
      if (about) this.answered.set(about, state.said);
      await this.take(state);
    } catch (error) {
      if (about) this.answered.delete(about);
      this.tell(error.message);
      await this.load().catch(() => null);
    } finally {
      this.waiting--;
    }
  }

  /** Says something of the whole machine, `name=text`. */
  whole(answer, about) {
    const at = answer.indexOf("=");
    return this.say("do", { kind: "machine", name: answer.slice(0, at), text: answer.slice(at + 1) }, about);
  }

  /** X: the meant parts are no part of the machine; a role that is missing is not drawn. */
  none() {
    const { question } = this;
    if (question?.kind === "role" && !this.selection.size && !this.picked) return this.whole(`${question.absent}=absent`);
    return this.assign(null);
  }

  /** Gives the meant parts a role; `null`: no part of the machine. */
  assign(role) {
    if (this.pattern) return this.say("do", { kind: "rule", name: this.pattern.pattern, text: role ?? "none" });
    const parts = [...this.meant].map((number) => this.viewer.model.parts[number - 1].path);
    if (!parts.length) return this.tell("Click a part first, or several with Shift.");
    return this.say("do", { kind: "role", parts: Object.fromEntries(parts.map((path) => [path, role])), mirror: this.mirror });
  }

  yes() {
    const { question, joint } = this;
    if (joint) return this.#axis(this.aim?.found?.entry ?? joint.axis);
    if (!this.selection.size && question?.kind === "machine") return this.whole(question.yes);
    if (!this.selection.size && question?.kind === "value") return this.answer(0);
    if (this.selection.size && question?.kind === "role") return this.assign(question.key.slice("role:".length));
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
  answer(index) {
    const { question, joint } = this;
    if (joint) return joint.others[index] && this.#axis(JSON.parse(joint.others[index][0]));
    const candidate = question?.candidates[index];
    if (!candidate) return;
    if (question.kind === "machine") return this.whole(candidate.answer);
    if (question.kind === "value") return this.give(question.title.replace(/\?$/, ""), candidate.answer);
    if (question.kind === "parts") return this.assign(candidate.answer);
    const role = question.key.slice("role:".length);
    return this.say("do", { kind: "role", parts: { [candidate.answer]: role }, mirror: this.mirror });
  }

  // ---- joints ------------------------------------------------------------------------------------------------------
  /** Says more of the joint; what was said of it before stays. */
  #say(change) {
    const { joint } = this;
    if (!joint) return this.tell("Choose a joint first, in the list of joints.");
    const entry = { ...joint.entry, ...change };
    return this.say("do", { kind: "joint", name: joint.name, entry: Object.fromEntries(Object.entries(entry).filter(([, said]) => said !== undefined)) });
  }

  #axis(entry) {
    if (!entry || !Object.keys(entry).length) return this.tell("Its axis is not known: point at it with P.");
    return this.#say({ anchor: undefined, axis: undefined, through: undefined, ...entry });
  }

  /** Turns a slide round, and so the way that counts as out. */
  reverse() {
    const { joint } = this;
    if (joint && joint.type !== "prismatic") return this.tell("Pivots all turn the same way round: to the left, up, or forward. A slide has a way of its own.");
    const { through, anchor, axis } = Object.keys(joint?.entry ?? {}).some((key) => ["through", "axis"].includes(key)) ? joint.entry : (joint?.axis ?? {});
    if (through) return this.#axis({ through: [through[1], through[0], ...through.slice(2)] });
    return this.#axis(axis ? { anchor, axis: axis.map((value) => -value) } : null);
  }

  /** Where the joint is now becomes its lower (0) or upper (1) stop. */
  stop(end) {
    const { joint, viewer } = this;
    const built = viewer.model.joints.find((each) => each.name === joint?.name);
    if (!built || joint.type === "spherical") return this.tell("This joint cannot be moved yet.");
    const unit = joint.type === "prismatic" ? 1 : 180 / Math.PI;
    const known = joint.limits.map((limit) => (limit == null ? null : Number(((limit + joint.began) * unit).toFixed(5))));
    const limits = [...(joint.entry.Limit ?? known)];
    limits[end] = Number(((coordinateOf(built, viewer.pose) + joint.began) * unit).toFixed(5));
    return this.#say({ Limit: limits });
  }

  /** Begins to point at the joint's axis, or ends it. */
  point() {
    if (!this.joint) return this.tell("Choose a joint first, in the list of joints.");
    this.aim = this.aim ? null : { picks: [], found: null, said: "Click a bore or another round thing, with Alt an edge; or go through the round things there with the arrow keys.", at: -1 };
    if (this.aim) this.aim.rounds = ask("rounds", { joint: this.joint.name }).then(async (answer) => (await answer.json()).rounds, () => []);
    this.show();
  }

  /** Arrow keys, while an axis is pointed at: the next round thing near the joint, or the one before. */
  #roundKey(event) {
    const way = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (!way || !this.aim || document.querySelector("dialog[open]") || event.target.closest("input, textarea, select, [role=tab]")) return;
    event.preventDefault();
    event.stopPropagation();
    this.#round(this.aim, way);
  }

  async #round(aim, way) {
    const rounds = await aim.rounds;
    if (this.aim !== aim) return;
    if (!rounds.length) return this.tell("Nothing of the joint's two bodies is round: type its axis.");
    aim.at = aim.at < 0 ? (way > 0 ? 0 : rounds.length - 1) : (aim.at + way + rounds.length) % rounds.length;
    const found = rounds[aim.at];
    Object.assign(aim, { picks: [], found, said: `${found.words} (${aim.at + 1} of ${rounds.length})` });
    this.show();
  }

  /** A click while an axis is pointed at: what all clicks so far mean. */
  async #aimed(event) {
    const { aim, viewer } = this;
    const box = viewer.canvas.getBoundingClientRect();
    const hit = viewer.surfaceAt(event.clientX - box.left, event.clientY - box.top);
    if (!hit) return;
    if (aim.picks.length === 3 || event.altKey) aim.picks = [];
    aim.picks.push({ part: hit.part, point: hit.point, edge: event.altKey });
    try {
      const found = await (await ask("axis", { picks: aim.picks })).json();
      Object.assign(aim, { found, said: found.words });
    } catch (error) {
      Object.assign(aim, { found: null, said: error.message });
    }
    this.show();
  }

  choosesJoint(name) {
    this.picked = name;
    this.aim = null;
    this.selection.clear();
    this.show();
    if (this.shown.size) this.viewer.focus(this.shown);
  }

  give(name, text) {
    return this.say("do", { kind: "value", name, text });
  }

  async build() {
    await this.say("build", {});
    if (!by("building").open) by("building").showModal();
  }

  tell(text, stays = false) {
    const told = by("told");
    told.textContent = text;
    told.hidden = false;
    clearTimeout(this.silence);
    if (!stays) this.silence = setTimeout(() => (told.hidden = true), 5000);
  }

  // ---- showing -----------------------------------------------------------------------------------------------------
  show() {
    const { state, questions } = this;
    document.title = `${state.machine} – yellowiron studio`;
    by("machine").textContent = state.machine;
    by("file").textContent = state.file;
    by("saved").textContent = state.solved < state.said ? "Kept, solving …" : state.said ? "Kept" : "";
    by("verdict").title = `${state.verdict} ${state.tally}`;
    by("verdict").replaceChildren(element("b", {}, state.verdict), ` ${state.tally}`);
    const done = state.history.filter((entry) => entry.holds).length;
    by("undo").disabled = done === 0;
    by("redo").disabled = done === state.history.length;
    by("count").textContent = `${questions.length} ${questions.length === 1 ? "question" : "questions"}`;
    by("place").textContent = questions.length ? `${this.at + 1} of ${questions.length}` : "";
    by("queue").replaceChildren(...questions.map((question, index) => element("li", {}, element("button", {
      type: "button", "aria-current": index === this.at, onclick: () => this.go(index),
    }, element("span", {}, question.title.replace(/\?$/, "")), element("span", {}, this.#amount(question))))));
    by("queue").querySelector("[aria-current=true]")?.scrollIntoView({ block: "nearest" });
    this.#card();
    this.#history();
    this.#values();
    this.#joints();
    this.#built();
    this.viewer.light(this.shown);
    const { joint, aim } = this;
    const meant = aim?.found && { number: this.numbers.get(aim.found.part), point: aim.found.point, direction: aim.found.direction };
    const ahead = !joint && !this.selection.size && this.question?.key === "machine:forward";
    this.viewer.showAxes([...(joint ? [joint.name] : []), ...(meant ? [meant] : []), ...(ahead ? [{ ahead }] : [])]);
    this.viewer.canvas.style.cursor = aim ? "crosshair" : "";
  }

  #amount(question) {
    return { machine: "machine", parts: this.#counted(question.parts), role: "missing", value: "value", joint: "joint" }[question.kind];
  }

  go(index) {
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
  choose(number, event) {
    if (this.aim && event) return this.#aimed(event);
    this.picked = null;
    const several = event?.shiftKey;
    if (!number) this.selection.clear();
    else if (several && this.selection.has(number)) this.selection.delete(number);
    else this.selection = new Set(several ? [...this.selection, number] : [number]);
    this.show();
  }

  /** Takes in the assembly around what is selected, one level at a time. */
  assembly() {
    const { parts } = this.viewer.model;
    const paths = [...this.meant].map((number) => parts[number - 1].path.split("/"));
    if (!paths.length) return this.tell("Click a part first.");
    let depth = Math.min(...paths.map((path) => path.length - 1));
    while (depth && paths.some((path) => path.slice(0, depth).join("/") !== paths[0].slice(0, depth).join("/"))) depth--;
    for (; depth > 0; depth--) {
      const above = `${paths[0].slice(0, depth).join("/")}/`;
      const inside = parts.filter((part) => part.path.startsWith(above)).map((part) => part.number);
      if (inside.length > this.meant.size) {
        this.selection = new Set(inside);
        return this.show();
      }
    }
    return this.tell("No assembly is around these parts.");
  }

  #card() {
    const { question, state } = this;
    const card = by("card");
    // What a person is writing in stays, whatever becomes known meanwhile.
    const about = this.joint?.name ?? (this.selection.size ? [...this.selection].join() : question?.key);
    if (about === this.about && card.contains(document.activeElement) && document.activeElement.matches("input, select")) return;
    this.about = about;
    const picked = [...this.selection].map((number) => this.viewer.model.parts[number - 1]);
    card.className = picked.length ? "picked" : question ? "" : "done";
    const answers = element("ol", { class: "answers" });
    const add = (key, text, act, yes = false) =>
      answers.append(element("li", {}, element("button", { type: "button", class: yes ? "yes" : false, onclick: act }, element("kbd", {}, key), element("span", {}, text))));
    const rest = element("div", { class: "more" },
      button(!picked.length && question?.kind === "role" ? "X  not drawn" : "X  none", () => this.none()), button("/  find a role", () => this.find()),
      button("A  assembly", () => this.assembly()), button("E  all named so", () => this.rules(), { "aria-pressed": Boolean(this.pattern) }),
      this.pattern ? null : button("M  other side too", () => { this.mirror = !this.mirror; this.show(); }, { "aria-pressed": this.mirror }),
      button("I  isolate", () => this.isolate()), button("F  look", () => this.viewer.focus(this.shown)));
    const { joint } = this;
    const asked = !picked.length && question;
    if (joint) return this.#jointCard(joint, card, answers, add);
    if (picked.length) {
      const roles = [...new Set(picked.map((part) => words(part.role) || "no part of the machine"))];
      card.replaceChildren(
        element("p", { class: "eyebrow" }, this.pattern ? `All that is named ${this.pattern.pattern} · ${this.#counted(picked)}`
          : picked.length > 1 ? `${picked.length} parts selected` : `Selected: ${picked[0].name}`),
        element("h2", {}, sentence(roles.slice(0, 3).join(", ")) + (roles.length > 3 ? " …" : "")),
        element("p", { class: "why" }, picked.length > 1 ? "" : `${picked[0].reason}${picked[0].confidence == null ? "" : ` (${Math.round(100 * picked[0].confidence)} %)`}`),
      );
      if (question?.kind === "role") add("⏎", `It is the ${words(question.key.slice("role:".length))}`, () => this.yes(), true);
      else if (!this.pattern || roles.length === 1) add("⏎", "Right as it is", () => this.yes(), true);
      if (this.pattern?.ruled) rest.append(button("Take back", () => this.say("do", { kind: "rule", name: this.pattern.pattern, text: "" })));
      card.append(answers, rest);
    } else if (asked) {
      card.replaceChildren(
        element("p", { class: "eyebrow" }, { machine: "The whole machine", parts: "Is that right?", role: "Missing", value: "Value" }[question.kind]),
        element("h2", {}, question.title),
        element("p", { class: "why" }, question.reason),
      );
      for (const known of question.known) card.append(element("p", { class: "known" }, known));
      if (question.parts.length > 1) card.append(element("p", { class: "names" }, question.parts.map((path) => path.split("/").pop()).join(", ")));
      if (["parts", "machine"].includes(question.kind)) add("⏎", "Yes", () => this.yes(), true);
      question.candidates.forEach((candidate, index) =>
        add(question.kind === "value" && !index ? "⏎" : index + 1, candidate.words, () => this.answer(index), question.kind === "value" && !index));
      card.append(answers);
      if (question.kind === "value") card.append(this.#form(question));
      else card.append(question.kind === "machine" ? element("div", { class: "more" }, button("V  more of the whole machine", () => this.overall())) : rest);
      if (question.page != null) card.append(element("div", { class: "more" }, button(`Page ${question.page} of the sheet`, () => this.sheet(question.page, question.file))));
    } else {
      card.replaceChildren(
        element("p", { class: "eyebrow" }, "Nothing left to ask"), element("h2", {}, "Build the machine"),
        element("p", { class: "why" }, state.causes.map((cause) => cause.words).join(" ") || "Every part, joint and value is settled."),
        element("div", { class: "more" }, button("B  build", () => this.build())),
      );
    }
  }

  #jointCard(joint, card, answers, add) {
    const { aim, state } = this;
    const how = { found: "Found", guess: "A guess", given: "Given by a person", none: "Not found" }[joint.known];
    const kinds = { Revolute: "turns", Prismatic: "slides", Spherical: "ball", Fixed: "fixed" };
    const bodies = [...new Set(state.roles.map((role) => role.body))];
    const choice = (label, options, chosen, act) => element("label", {}, label, element("select", { onchange: (event) => act(event.target.value) },
      ...options.map(([value, text]) => element("option", { value, selected: value === chosen }, text))));
    card.className = this.picked ? "picked" : "";
    card.replaceChildren(
      element("p", { class: "eyebrow" }, `Joint · ${how}`), element("h2", {}, joint.title),
      element("p", { class: "why" }, aim ? "" : joint.reason),
    );
    if (aim) card.append(element("p", { class: "known" }, aim.said));
    if (aim ? aim.found : Object.keys(joint.axis).length) add("⏎", aim ? "Its axis is there" : "Yes, its axis is right", () => this.yes(), true);
    if (!aim) joint.others.forEach(([, text], index) => add(index + 1, text, () => this.answer(index)));
    const input = element("input", { type: "text", placeholder: "x y z, direction x y z (m)", "aria-label": "Axis", autocomplete: "off" });
    const form = element("form", {}, input, element("button", { type: "submit" }, "Set"));
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      const numbers = input.value.split(/[\s,;]+/).filter(Boolean).map(Number);
      if (numbers.length !== 6 || numbers.some((value) => !Number.isFinite(value))) return this.tell("Six numbers: a point of the axis in metres, and its direction.");
      this.#axis({ anchor: numbers.slice(0, 3), axis: numbers.slice(3) });
    });
    card.append(answers, element("div", { class: "more" },
      button(aim ? "P  stop pointing" : "P  point at its axis", () => this.point(), { "aria-pressed": Boolean(aim) }),
      joint.type === "prismatic" ? button("R  other way round", () => this.reverse()) : "", button("[  lower stop here", () => this.stop(0)), button("]  upper stop here", () => this.stop(1)),
      button("W  move", () => this.wiggle()),
      Object.keys(joint.entry).length ? button("Take back", () => this.say("do", { kind: "joint", name: joint.name, entry: {} })) : null),
      element("details", {}, element("summary", {}, "Type, bodies, typed axis"), element("div", { class: "t-more" },
        choice("It ", Object.entries(kinds), sentence(joint.type), (value) => this.#say({ joint_type: value })),
        ...[0, 1].map((end) => choice(end ? "and " : "Between ", bodies.map((body) => [body, words(body)]), joint.bodies[end],
          (value) => this.#say({ Body: end ? [joint.bodies[0], value] : [value, joint.bodies[1]] }))), form)));
  }

  #joints() {
    const tags = { found: ["ok", "found"], guess: ["review", "guess"], given: ["ok", "given"], none: ["missing", "none"] };
    const rows = this.state.joints.map((joint) => element("li", { class: "t-value" },
      button(joint.title, () => this.choosesJoint(joint.name), { class: "v-name", "aria-current": joint === this.joint }),
      element("span", { class: `tag ${tags[joint.known][0]}` }, tags[joint.known][1])));
    by("joints").replaceChildren(rows.length ? element("ol", {}, ...rows) : element("p", { class: "dim" }, "No joints yet."));
  }

  #form(question) {
    const input = element("input", { type: "text", placeholder: "1400 mm", "aria-label": question.title, autocomplete: "off" });
    const form = element("form", {}, input, element("button", { type: "submit" }, "Set"));
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      if (input.value.trim()) this.give(question.title.replace(/\?$/, ""), input.value.trim());
    });
    return form;
  }

  #history() {
    const rows = this.state.history.map((entry) => element("li", { class: entry.holds ? false : "gone" }, entry.words,
      element("small", {}, [entry.by, entry.date].filter(Boolean).join(", "))));
    const remarks = this.state.remarks.map((remark) => element("p", { class: "known" }, `${remark}.`));
    by("history").replaceChildren(...remarks, rows.length ? element("ol", {}, ...rows.reverse()) : element("p", { class: "dim" }, "Nothing decided yet."));
  }

  #values() {
    const rows = this.state.values.filter((value) => value.value != null || value.status !== "missing").map((value) =>
      element("li", { class: "t-value" }, element("b", {}, value.name),
        value.page == null ? element("span") : button(`p. ${value.page}`, () => this.sheet(value.page, value.file)),
        element("span", {}, value.value == null ? "–" : `${Number(value.value.toPrecision(6))} ${value.unit}`),
        element("span", { class: `tag ${value.status}` }, value.source === "set" ? "given" : value.status)));
    by("values").replaceChildren(rows.length ? element("ol", {}, ...rows) : element("p", { class: "dim" }, "No sheet was read."));
  }

  #built() {
    const { build } = this.state;
    const said = { none: "", running: "Building …", ready: "Built: ready to simulate.", short: "Built, with points left open: the report says which.", failed: "The build failed." };
    by("build").disabled = build.state === "running";
    by("building").replaceChildren(
      element("b", {}, said[build.state]), element("pre", {}, build.lines.join("\n")),
      element("span", { class: "dim" }, "The same from the command line:"), element("code", {}, build.command),
      element("div", { class: "more" }, button("Close", () => by("building").close())),
    );
  }

  sheet(number, file) {
    const source = `sheet/${number}?file=${encodeURIComponent(file)}&token=${encodeURIComponent(token)}`;
    by("sheet").replaceChildren(element("img", { src: source, alt: `Page ${number} of the sheet, values boxed` }),
      element("div", { class: "more" }, button("Close", () => by("sheet").close())));
    by("sheet").showModal();
  }

  keys() {
    by("keys").replaceChildren(element("b", {}, "Keys"), element("dl", {}, ...KEYS.flatMap(([key, text]) => [element("dt", {}, element("kbd", {}, key)), element("dd", {}, text)])),
      element("div", { class: "more" }, button("Close", () => by("keys").close())));
    by("keys").showModal();
  }

  isolate() {
    const { shown } = this;
    const hidden = this.viewer.model.parts.some((part) => part.hidden);
    this.viewer.show((part) => hidden || !shown.size || shown.has(part.number));
  }

  /** Moves the actuator that moves what is meant, a little and back. */
  wiggle() {
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) return;
    const { viewer } = this;
    const bodies = new Set([...this.shown].map((number) => viewer.model.bodies[viewer.model.parts[number - 1].body].name));
    const there = (pose) => [...bodies].some((body) => pose[body]?.some((value, k) => Math.abs(value - IDENTITY[k]) > 1e-4));
    const count = (pose) => Object.values(pose).filter((m) => m.some((value, k) => Math.abs(value - IDENTITY[k]) > 1e-4)).length;
    const ways = viewer.model.sliders.map((slider) => {
      const [low, high] = slider.range;
      const far = (high > -low ? high : low) * 0.35;
      const given = Object.fromEntries(slider.joints.map(([joint, sign]) => [joint, sign * far]));
      return { given, pose: poseOf(viewer.model, given) };
    });
    const moving = ways.filter(({ pose }) => there(pose)).sort((a, b) => count(a.pose) - count(b.pose))[0];
    if (!moving) return;
    const begin = performance.now();
    const step = (now) => {
      if (this.wiggling !== step) return;
      const t = Math.min((now - begin) / 1600, 1);
      const share = Math.sin(Math.PI * t) ** 2;
      viewer.move(Object.fromEntries(Object.entries(moving.given).map(([joint, value]) => [joint, share * value])));
      if (t < 1) requestAnimationFrame(step);
      else this.wiggling = null;
    };
    this.wiggling = step;
    requestAnimationFrame(step);
  }

  // ---- finding -----------------------------------------------------------------------------------------------------
  /** Finds a role for what is meant. */
  find() {
    if (!this.meant.size) return this.tell("Click a part first, or several with Shift; S finds one by its name.");
    const rows = this.state.roles.map((role) => ({ words: role.words, name: role.name, take: () => this.assign(role.name) }));
    this.#finder("Role of these parts", rows, "No role of that name. A part without one of its own, such as a cab, has its body's.");
  }

  /** Finds what can be said of the whole machine. */
  overall() {
    const rows = this.state.machineSaid.map(({ answer, words }) => ({ words, name: answer, take: () => this.whole(answer, null) }));
    this.#finder("Of the whole machine: its front, a variant, what is not drawn", rows, "Nothing of that name can be said of the whole machine.");
  }

  /** Finds parts by their names and those of their assemblies, and joints. */
  search() {
    const parts = this.viewer.model.parts.filter((part) => !part.hidden)
      .map((part) => ({ words: part.path, name: part.path.split("/").at(-1), number: part.number, take: () => this.#select([part.number]) }));
    const joints = this.state.joints
      .map((joint) => ({ words: `${joint.title} · joint`, name: joint.name, take: () => this.choosesJoint(joint.name) }));
    this.#finder("Name of a part, an assembly or a joint", [...parts, ...joints], "No part or joint of that name.");
  }

  /** Finds the patterns over the CAD tree that fit what is selected, or takes one that is written. */
  async rules() {
    const paths = [...this.meant].map((number) => this.viewer.model.parts[number - 1].path);
    const rows = async (body) => (await (await ask("patterns", body)).json()).patterns.filter((one) => one.parts.length || one.ruled).map((one) => ({
      words: `${one.pattern} · ${this.#counted(one.parts)}${one.ruled ? ` · ${words(one.role ?? "") || "no part of the machine"}` : ""}`,
      name: one.pattern, take: () => this.#rule(one),
    }));
    try {
      const none = "No part and no assembly is named so. As much of a path as you like; * stands for any text.";
      this.#finder("A pattern, such as HITCH/* or *BOLT*", await rows({ parts: paths }), none, async (pattern) => (await rows({ pattern }))[0]);
    } catch (error) {
      this.tell(error.message);
    }
  }

  #rule({ pattern, parts, ruled }) {
    this.#select(parts.map((path) => this.numbers.get(path)).filter(Boolean));
    this.ruled = { pattern, ruled, selection: this.selection, size: this.selection.size };
    this.show();
  }

  #counted(parts) {
    return `${parts.length} ${parts.length === 1 ? "part" : "parts"}`;
  }

  /** Selects the next part (1), or the one before (-1): of several that are asked about, else of the file. */
  step(way) {
    const { question, selection } = this;
    const asked = question?.kind === "parts" && !this.picked ? question.parts.map((path) => this.numbers.get(path)).filter(Boolean).sort((a, b) => a - b) : [];
    const within = asked.length > 1 && [...selection].every((number) => asked.includes(number));
    const numbers = within ? asked : this.viewer.model.parts.filter((part) => !part.hidden).map((part) => part.number);
    if (!numbers.length) return;
    const from = way > 0 ? Math.max(...this.shown) : Math.min(...this.shown);
    const at = (within ? selection : this.shown).size ? numbers.indexOf(from) : (way > 0 ? -1 : 0);
    this.#select([numbers[(at + way + numbers.length) % numbers.length]]);
  }

  #select(numbers) {
    this.choose(0, null);
    this.selection = new Set(numbers);
    this.show();
    this.viewer.focus(this.shown);
  }

  /** Lets one of some rows be found by its words; `typed` may make one more of what is written. */
  #finder(label, rows, none, typed = null) {
    this.finding = { rows, none, typed };
    by("find").value = "";
    by("find").placeholder = label;
    by("find").setAttribute("aria-label", label);
    by("finder").setAttribute("aria-label", label);
    this.#list();
    by("finder").showModal();
    by("find").focus();
  }

  #list() {
    const wanted = by("find").value.trim().toLowerCase().split(/\s+/).filter(Boolean);
    // Who types a whole name means that one, not the first that has the words too.
    const whole = wanted.join(" ");
    const rank = ({ words, name }) => [words.toLowerCase(), name.toLowerCase()].includes(whole) ? 0 : words.toLowerCase().startsWith(whole) ? 1 : 2;
    this.found = this.finding.rows.filter(({ name, words }) => wanted.every((word) => `${name} ${words}`.toLowerCase().includes(word)))
      .sort((one, other) => rank(one) - rank(other));
    this.row = 0;
    this.#rows();
    const text = by("find").value.trim();
    this.typing = this.finding.typed && text ? this.#typed(this.finding, text) : null;
  }

  /** What is written is the first of what is found, where it means something. */
  async #typed(finding, text) {
    const row = await finding.typed(text).catch(() => null);
    if (!row || finding !== this.finding || by("find").value.trim() !== text) return;
    this.found = [row, ...this.found.filter(({ name }) => name !== row.name)];
    this.#rows();
  }

  #rows() {
    const none = element("li", { class: "dim" }, this.finding.none);
    const from = Math.max(0, Math.min(this.row - LISTED / 2, this.found.length - LISTED));
    const rows = this.found.slice(from, from + LISTED)
      .map(({ words }, index) => element("li", {}, button(words, () => this.#take(from + index), { "aria-selected": from + index === this.row })));
    const more = this.found.length - rows.length;
    by("found").replaceChildren(...(rows.length ? rows : [none]), ...(more > 0 ? [element("li", { class: "dim" }, `and ${more} more`)] : []));
    by("found").querySelector("[aria-selected=true]")?.scrollIntoView({ block: "nearest" });
  }

  #take(index) {
    const row = this.found[index];
    this.#shut();
    row?.take();
  }

  #shut() {
    by("finder").close();
    by("find").blur(); // else it keeps the focus until the next frame, and the next key is lost in it
  }

  #findKey(event) {
    if (event.key === "Escape") (event.preventDefault(), this.#shut()); // else the first one only empties the field
    if (event.key === "Enter") {
      event.preventDefault();
      if (this.typing) return this.typing.then(() => this.#take(this.row));
      const numbers = (event.altKey ? [this.found[this.row]] : this.found).map((row) => row?.number).filter(Boolean);
      if (!(event.shiftKey || event.altKey) || !numbers.length) return this.#take(this.row);
      this.#shut();
      return this.#select(event.altKey ? [...this.selection, ...numbers] : numbers);
    }
    const way = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (!way || !this.found.length) return;
    event.preventDefault();
    this.row = (this.row + way + this.found.length) % this.found.length;
    this.#rows();
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]")) return;
    if (event.target.closest("input, textarea, select")) return event.key === "Escape" && event.target.blur();
    const acts = {
      j: () => this.go(this.at + 1), k: () => this.go(this.at - 1), x: () => this.none(), v: () => this.overall(), "/": () => this.find(), s: () => this.search(), n: () => this.step(event.shiftKey ? -1 : 1),
      a: () => this.assembly(), e: () => this.rules(), m: () => { this.mirror = !this.mirror; this.show(); }, i: () => this.isolate(),
      f: () => this.viewer.focus(this.shown), w: () => this.wiggle(), b: () => this.build(), "?": () => this.keys(),
      u: () => this.say(event.shiftKey ? "redo" : "undo", {}), escape: () => { this.selection.clear(); this.picked = this.aim = null; this.show(); },
      enter: () => this.yes(), p: () => this.point(), r: () => this.reverse(), "[": () => this.stop(0), "]": () => this.stop(1),
    };
    // A button that has the focus is pressed by Enter itself.
    if (event.key === "Enter" && event.target.closest("button, summary")) return;
    const act = acts[event.key.toLowerCase()] ?? (/^[1-9]$/.test(event.key) ? () => this.answer(Number(event.key) - 1) : null);
    if (!act) return;
    event.preventDefault();
    act();
  }
}

try {
  const page = (id) => element("div", { class: "t-list", id });
  const [shapes, model] = await Promise.all([packing("shapes"), packing("machine")]);
  let studio = null;
  const viewer = new Viewer(by("viewer"), Object.assign(model, { shapes: shapes.shapes, leftOut: shapes.leftOut }), {
    pages: [["Joints", page("joints")], ["Values", page("values")], ["History", page("history")]],
    onchoose: (number, event) => studio?.choose(number, event),
    onjoint: (name) => studio && !studio.aim && studio.choosesJoint(name),
  });
  studio = new Studio(viewer, model.version);
  studio.numbers = new Map(model.parts.map((part) => [part.path, part.number]));
  await studio.load();
  window.yellowiron = studio;
} catch (error) {
  by("viewer").replaceChildren(element("p", { class: "t-wait" }, `The studio cannot be shown here: ${error.message}.`));
}
