// The 3D view of the report: its controls, what they do, and what is known of the part that was clicked.

/** The packing of packing.py: gzip of [length, JSON header, binary]. */
async function unpack(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  const buffer = await new Response(stream).arrayBuffer();
  const length = new DataView(buffer).getUint32(0, true);
  const model = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const kinds = { f32: Float32Array, i32: Int32Array, u16: Uint16Array, i8: Int8Array };
  const array = ([kind, offset, count]) => new kinds[kind](buffer, 4 + length + offset, count);
  for (const table of model.tables) table.values = array(table.values);
  for (const shape of model.shapes)
    for (const key of ["points", "indices", "normals"]) shape[key] = shape[key] && array(shape[key]);
  return model;
}

/** An element: `element("button", {class: "x", onclick: …}, child, "text")`. */
function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    // What a role says is "true" or "false"; other attributes are there or not.
    else if (name.startsWith("aria-") && value != null) made.setAttribute(name, String(value));
    else if (value !== false && value != null) made.setAttribute(name, value === true ? "" : value);
  }
  made.append(...children.filter((child) => child != null));
  return made;
}

function svg(tag, attributes = {}) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  change(made, attributes);
  return made;
}

function change(made, attributes) {
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
}

const words = (name) => name.replaceAll("_", " ");
const sentence = (name) => words(name).replace(/^./, (letter) => letter.toUpperCase());
const signed = (value, digits) => (value < -0.5 * 10 ** -digits ? "−" : "") + Math.abs(value).toFixed(digits);
const degrees = (radians) => `${signed((radians * 180) / Math.PI, 1)}°`;
const tenth = (value) => value.toFixed(1);
const STEPS = 400; // of a slider
const SLOW = 150; // milliseconds for a frame
const PALE = [172, 174, 176]; // four fifths of what parts that are not asked for turn to

function boxOf(points) {
  const [low, high] = [Math.min, Math.max].map((best) =>
    [0, 1, 2].map((k) => points.reduce((value, point) => best(value, point[k]), points[0][k])),
  );
  return { low, high, middle: scaled(add(low, high), 0.5) };
}

class Viewer {
  /** `pages` are more tabs of the panel, `[name, element]`; `onchoose(number, event)` takes the place of the card,
   * `onjoint(name)` hears of a joint whose mark is clicked or entered. */
  constructor(root, model, { pages = [], onchoose = null, onjoint = null } = {}) {
    this.root = root;
    this.model = model;
    this.pages = pages;
    this.onchoose = onchoose;
    this.onjoint = onjoint;
    this.lit = null;
    this.given = {};
    this.byBody = false;
    this.chosen = 0;
    this.trials = 0;
    this.quickest = Infinity;
    model.parts.forEach((part, index) => Object.assign(part, { number: index + 1, hidden: false, drawn: part.color }));
    this.#layout();
    this.renderer = new Renderer(this.canvas, model.shapes, model.parts);
    this.#measure();
    this.#controls();
    this.#pointer();
    root.classList.add("v-ready");
    root.replaceChildren(this.stage, this.panel);
    this.move({});
    this.reset();
    new ResizeObserver(() => this.request()).observe(this.stage);
    this.canvas.addEventListener("webglcontextlost", () => {
      this.hint.textContent = "The browser has taken the graphics away; reload the page to see the machine again.";
    });
  }

  // ---- layout ------------------------------------------------------------------------------------------------------
  #layout() {
    this.canvas = element("canvas", {
      tabindex: 0,
      role: "img",
      "aria-label": "The machine in three dimensions. Arrow keys turn it, plus and minus zoom, 0 shows all of it.",
    });
    this.overlay = svg("svg", { role: "group", "aria-label": "Marks on the machine" });
    this.marks = new Map();
    this.tip = element("div", { class: "v-tip", hidden: true });
    this.card = element("div", { class: "v-card", role: "status", hidden: true });
    const toggle = (label, change) =>
      element("button", {
        type: "button",
        "aria-pressed": "false",
        onclick: (event) => {
          const on = event.currentTarget.getAttribute("aria-pressed") !== "true";
          event.currentTarget.setAttribute("aria-pressed", on);
          change(on);
        },
      }, label);
    const tools = element(
      "div",
      { class: "v-tools" },
      toggle("By body", (on) => { this.byBody = on; this.#recolor(); }),
      toggle("Joints", (on) => { this.showJoints = on; this.#drawMarks(); }),
      this.model.sensors.length ? toggle("Sensors", (on) => { this.showSensors = on; this.#drawMarks(); }) : null,
      element("button", { type: "button", onclick: () => this.reset() }, "Reset view"),
      element("button", { type: "button", onclick: () => this.#fullscreen() }, "Full screen"),
      element("button", { type: "button", onclick: () => this.save() }, "Save picture"),
    );
    this.hint = element("div", { class: "v-hint" }, matchMedia("(hover: none)").matches
      ? "Drag sideways to turn, two fingers to move and zoom" : "Drag to turn, right-drag to move, click and scroll to zoom");
    const layers = [this.canvas, this.overlay, tools, this.hint, this.card, this.tip];
    this.stage = element("div", { class: "v-stage" }, ...layers);
    this.panel = element("div", { class: "v-panel" });
  }

  #fullscreen() {
    if (document.fullscreenElement) document.exitFullscreen();
    else this.root.requestFullscreen?.();
  }

  /** Hands what is seen over as a PNG file, at twice the screen's pixels. */
  save() {
    this.draw(2);
    // Before the browser shows the frame: the picture is gone after that.
    this.canvas.toBlob((blob) => {
      const link = element("a", { href: URL.createObjectURL(blob), download: "machine.png" });
      link.click();
      URL.revokeObjectURL(link.href);
    });
  }

  #recolor() {
    for (const part of this.model.parts) {
      const color = this.byBody ? this.model.bodies[part.body].color : part.drawn;
      part.color = !this.lit || this.lit.has(part.number) ? color : color.map((value, k) => 0.2 * value + PALE[k]);
    }
    this.request();
  }

  /** Parts (a set of numbers) that are shown through all others, which turn pale; null: none. */
  light(numbers) {
    this.lit = numbers?.size ? numbers : null;
    this.#recolor();
  }

  /** Another state of the same machine: the shapes, what is hidden and the camera stay. */
  update(model) {
    const before = this.model;
    model.parts.forEach((part, index) =>
      Object.assign(part, { number: index + 1, hidden: before.parts[index]?.hidden ?? false, drawn: part.color }),
    );
    this.model = Object.assign(model, { shapes: before.shapes, leftOut: before.leftOut });
    this.#measure();
    this.#fillMove();
    this.#fill();
    this.#recolor();
    const joints = new Set(model.sliders.flatMap((slider) => slider.joints.map(([joint]) => joint)));
    this.move(Object.fromEntries(Object.entries(this.given).filter(([joint]) => joints.has(joint))));
  }

  /** Each part's drawn placement and the corners of its box; the machine's box. */
  #measure() {
    for (const part of this.model.parts) {
      const [a, b, c, d] = [0, 1, 2, 3].map((k) => part.place.slice(3 * k, 3 * k + 3));
      part.rest = [...a, 0, ...b, 0, ...c, 0, ...d, 1];
      const shape = this.model.shapes[part.shape];
      part.corners = [0, 1, 2, 3, 4, 5, 6, 7].map((bits) =>
        moved(part.rest, [0, 1, 2].map((k) => shape.low[k] + ((bits >> k) & 1) * shape.size[k])),
      );
    }
    const { low, high, middle } = boxOf(this.model.parts.flatMap((part) => part.corners));
    this.scene = { middle, radius: 0.5 * Math.hypot(...high.map((value, k) => value - low[k])) };
  }

  // ---- controls ----------------------------------------------------------------------------------------------------
  #controls() {
    this.movePage = element("div", {});
    this.#fillMove();
    this.#tabs([["Move", this.movePage], ["Parts", this.#partList()], ...this.pages]);
  }

  #fillMove() {
    const { sliders, poses } = this.model;
    this.sliders = sliders.map((slider) => this.#slider(slider));
    this.angles = element("dl", { class: "v-angles" });
    const buttons = element(
      "div",
      { class: "v-poses" },
      ...[{ name: "As drawn", at: [] }, ...poses].map((pose) =>
        element("button", { type: "button", onclick: () => this.animate(Object.fromEntries(pose.at)) }, pose.name),
      ),
    );
    const section = (title, ...content) => element("section", {}, element("h3", {}, title), ...content);
    const rows = this.sliders.map((slider) => slider.row);
    const move = this.movePage;
    move.replaceChildren();
    if (rows.length) move.append(section("Actuators", ...rows), section("Poses", buttons));
    const note = element("p", { class: "dim" }, "Heights above the ground; angles of pivots from the drawn pose.");
    if (this.model.readouts.length + this.model.sites.length) move.append(section("How it stands", this.angles, note));
  }

  /** Tabs of the panel; arrow keys go from one to the next. */
  #tabs(pages) {
    const tabs = pages.map(([name, page]) => {
      const tab = element("button", { type: "button", role: "tab", id: `v-tab-${name}` }, name);
      page.setAttribute("role", "tabpanel");
      page.setAttribute("aria-labelledby", tab.id);
      return tab;
    });
    const open = (chosen) =>
      pages.forEach(([, page], index) => {
        page.hidden = index !== chosen;
        tabs[index].setAttribute("aria-selected", index === chosen);
        tabs[index].tabIndex = index === chosen ? 0 : -1;
      });
    tabs.forEach((tab, index) => {
      tab.addEventListener("click", () => open(index));
      tab.addEventListener("keydown", (event) => {
        const way = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
        if (!way) return;
        const next = (index + way + tabs.length) % tabs.length;
        open(next);
        tabs[next].focus();
      });
    });
    open(0);
    this.panel.append(element("div", { class: "v-tabs", role: "tablist" }, ...tabs), ...pages.map(([, page]) => page));
  }

  #slider(slider) {
    const [lower, upper] = slider.range;
    const [from, to] = slider.sign > 0 ? [lower, upper] : [upper, lower];
    const id = `v-${slider.name}`;
    const output = element("output", { for: id });
    const input = element("input", {
      type: "range", id, min: 0, max: STEPS, step: 1,
      oninput: () => this.set(slider.name, from + ((to - from) * input.value) / STEPS),
    });
    const show = (value) => {
      input.value = Math.round((STEPS * (value - from)) / (to - from));
      output.textContent =
        slider.unit === "rad"
          ? degrees(value * slider.sign)
          : slider.extension == null
            ? `${signed(1e3 * value, 0)} mm`
            : `${signed(1e3 * (value + slider.extension), 0)} of ${(1e3 * slider.stroke).toFixed(0)} mm`;
      input.setAttribute("aria-valuetext", output.textContent);
      input.style.setProperty("--share", `${(100 * input.value) / STEPS}%`);
    };
    const label = element("label", { for: id }, slider.title);
    return { ...slider, show, row: element("div", { class: "v-slider" }, label, output, input) };
  }

  #partList() {
    this.search = element("input", {
      type: "search", placeholder: "Search parts, roles, bodies", "aria-label": "Search parts",
      oninput: () => this.#fill(),
    });
    this.list = element("div", { class: "v-list" });
    this.count = element("span", { class: "dim" });
    const all = element("button", { type: "button", onclick: () => this.show(() => true) }, "Show all");
    const tree = element("button", {
      type: "button", "aria-pressed": "false",
      onclick: () => {
        this.byTree = !this.byTree;
        tree.setAttribute("aria-pressed", this.byTree);
        this.#fill();
      },
    }, "CAD tree");
    this.#fill();
    const head = element("div", { class: "v-head" }, this.count, element("span", {}, tree, " ", all));
    return element("section", { class: "v-parts" }, this.search, head, this.list);
  }

  /** The parts that the search leaves, body by body or as the CAD model has them. */
  #fill() {
    const wanted = this.search.value.trim().toLowerCase().split(/\s+/).filter(Boolean);
    const found = this.model.parts.filter((part) => {
      const text = `${part.path} ${part.role} ${this.model.bodies[part.body].name}`.toLowerCase();
      return wanted.every((word) => text.includes(word) || words(text).includes(word));
    });
    const hidden = this.model.parts.filter((part) => part.hidden).length;
    const left = this.model.leftOut ? `, ${this.model.leftOut} small ones not drawn` : "";
    this.count.textContent = `${found.length} parts${hidden ? `, ${hidden} hidden` : ""}${left}`;
    const open = new Set([...this.list.querySelectorAll("details[open]")].map((each) => each.dataset.key));
    const wide = wanted.length > 0 && found.length <= 60;
    const group = (key, label, swatch, parts, fill) => {
      const made = element("details", { "data-key": key });
      const filled = () => made.childElementCount < 2 && made.append(...fill());
      const name = element("span", {}, label, element("span", { class: "dim" }, ` ${parts.length}`));
      made.append(element("summary", {}, swatch, name, this.#eye(label, parts)));
      made.addEventListener("toggle", () => made.open && filled());
      if ((made.open = open.has(key) || wide)) filled();
      return made;
    };
    const under = (parts, depth, above) => {
      const assemblies = new Map();
      const own = [];
      for (const part of parts) {
        const steps = part.path.split("/");
        if (steps.length - 1 <= depth) own.push(part);
        else assemblies.set(steps[depth], [...(assemblies.get(steps[depth]) ?? []), part]);
      }
      const groups = [...assemblies].map(([name, inside]) =>
        group(`${above}/${name}`, name, null, inside, () => under(inside, depth + 1, `${above}/${name}`)),
      );
      return [...groups, ...own.map((part) => this.#row(part))];
    };
    const bodies = () =>
      this.model.bodies.flatMap((body, index) => {
        const parts = found.filter((part) => part.body === index);
        const swatch = element("i", { style: `background:rgb(${body.color})` });
        const rows = () => parts.map((part) => this.#row(part));
        return parts.length ? [group(body.name, words(body.name) || "no part of the machine", swatch, parts, rows)] : [];
      });
    this.list.replaceChildren(...(this.byTree ? under(found, 0, "") : bodies()));
  }

  #row(part) {
    const name = element("button", {
      type: "button", class: "v-name", title: part.path,
      "aria-current": this.lit ? this.lit.has(part.number) : part.number === this.chosen,
      onclick: (event) => this.choose(part.number, event),
    }, part.name);
    return element("div", { class: "v-row" }, name, this.#eye(part.name, [part]));
  }

  #eye(name, parts) {
    const hidden = parts.every((part) => part.hidden);
    return element("button", {
      type: "button", class: "v-eye", "aria-pressed": !hidden, "aria-label": `Show ${name}`,
      title: hidden ? "Show" : "Hide",
      onclick: (event) => {
        event.preventDefault();
        const set = new Set(parts);
        this.show((part) => (set.has(part) ? hidden : !part.hidden));
      },
    }, hidden ? "○" : "●");
  }

  /** Shows the parts that a test holds for, hides all others. */
  show(test) {
    for (const part of this.model.parts) part.hidden = !test(part);
    this.#fill();
    this.#changed();
  }

  /** Chooses a part by its number (0: none) and says what is known of it. */
  choose(number, event = null) {
    if (this.onchoose) return this.onchoose(number, event);
    this.chosen = number;
    const part = this.model.parts[number - 1];
    this.card.hidden = !part;
    if (part) {
      const action = (label, act) => element("button", { type: "button", onclick: act }, label);
      const doubt = part.review ? element("span", { class: "tag review" }, "to review") : null;
      const sure = part.confidence == null ? "" : `, confidence ${part.confidence.toFixed(2)}`;
      const body = this.model.bodies[part.body].name;
      const role = part.role && part.role !== body ? `${words(part.role)} on ` : "";
      this.card.replaceChildren(
        action("×", () => this.choose(0)),
        element("b", {}, part.name),
        element("p", {}, `${role}${words(body)}${sure} `, doubt),
        element("p", { class: "dim v-reason" }, part.reason),
        action("Hide", () => this.show((each) => each !== part && !each.hidden)),
        action("Isolate", () => this.show((each) => each === part)),
        action("Isolate body", () => this.show((each) => each.body === part.body)),
        element("a", { href: `#part=${encodeURIComponent(part.path)}` }, "Link"),
      );
      this.card.firstChild.setAttribute("aria-label", "Close");
    }
    this.#fill();
    this.request();
  }

  // ---- the machine's pose ------------------------------------------------------------------------------------------
  /** Sets a slider by its name to a coordinate of its first joint (metres or radians from the drawn pose). */
  set(name, value) {
    this.animation = null;
    const slider = this.sliders.find((each) => each.name === name);
    this.move({ ...this.given, ...Object.fromEntries(slider.joints.map(([joint, sign]) => [joint, sign * value])) });
  }

  /** Poses the machine: coordinates of independent joints, 0 where none is given. */
  move(given) {
    this.given = given;
    this.pose = poseOf(this.model, given);
    for (const slider of this.sliders) slider.show(given[slider.joints[0][0]] ?? 0);
    const row = (name, value) => [element("div", {}, element("dt", {}, name), element("dd", {}, value))];
    const joints = Object.fromEntries(this.model.joints.map((joint) => [joint.name, joint]));
    this.angles.replaceChildren(
      ...this.model.sites.flatMap((site) => {
        const at = moved(this.pose[site.body], site.at);
        const x = turned(this.pose[site.body], site.x);
        const pitch = Math.atan2(x[2], Math.sign(x[0] || 1) * Math.hypot(x[0], x[1]));
        return row(sentence(site.name), `${at[2].toFixed(2)} m high${site.tilts ? `, ${degrees(pitch)}` : ""}`);
      }),
      ...this.model.readouts.flatMap((name) => {
        const joint = joints[name];
        const angle = coordinateOf(joint, this.pose) - joint.straight;
        return row(`${sentence(joint.child)} to ${words(joint.parent)}`, degrees(angle));
      }),
    );
    this.#changed();
  }

  /** Goes to a pose within a second, at once where motion is unwelcome; the camera keeps all of it in the frame. */
  animate(given) {
    const start = { ...this.given };
    const [from, to] = [this.camera, this.#fitted(poseOf(this.model, given))];
    const names = [...new Set([...Object.keys(start), ...Object.keys(given)])];
    const begin = performance.now();
    const length = matchMedia("(prefers-reduced-motion: reduce)").matches ? 0 : 600;
    const step = (now) => {
      if (this.animation !== step) return;
      const t = length ? Math.min(Math.max((now - begin) / length, 0), 1) : 1;
      const share = t * t * (3 - 2 * t);
      this.camera = {
        ...this.camera,
        target: add(scaled(from.target, 1 - share), scaled(to.target, share)),
        distance: (1 - share) * from.distance + share * to.distance,
      };
      const between = (name) => (1 - share) * (start[name] ?? 0) + share * (given[name] ?? 0);
      this.move(Object.fromEntries(names.map((name) => [name, between(name)])));
      if (t < 1) requestAnimationFrame(step);
      else this.animation = null;
    };
    this.animation = step;
    this.goal = given;
    requestAnimationFrame(step);
  }

  #changed() {
    for (const part of this.model.parts)
      part.place = multiply(this.pose[this.model.bodies[part.body].name] ?? IDENTITY, part.rest);
    this.shadowsOld = true;
    this.request();
  }

  // ---- camera ------------------------------------------------------------------------------------------------------
  get #aspect() {
    return (this.stage.clientWidth || 16) / (this.stage.clientHeight || 9);
  }

  /** Looks at all that is shown, from the front right. */
  reset() {
    this.camera = { ...this.camera, azimuth: -0.75, elevation: 0.3 };
    Object.assign(this.camera, this.#fitted(this.pose));
    this.request();
  }

  /** Looks at these parts (a set of numbers) from where the camera is. */
  focus(numbers) {
    const parts = this.model.parts.filter((part) => numbers.has(part.number));
    if (!parts.length) return;
    const corners = parts.flatMap((part) =>
      part.corners.map((corner) => moved(this.pose[this.model.bodies[part.body].name] ?? IDENTITY, corner)),
    );
    const { low, high, middle } = boxOf(corners);
    const across = Math.hypot(...high.map((value, k) => value - low[k]));
    this.camera = { ...this.camera, target: middle, distance: Math.max(across, 0.12 * this.scene.radius) * 4.5 };
    this.request();
  }

  /** Target and distance from which all shown parts in a pose are seen at the camera's angles. */
  #fitted(pose) {
    const parts = this.model.parts.filter((part) => !part.hidden);
    const corners = (parts.length ? parts : this.model.parts).flatMap((part) =>
      part.corners.map((corner) => moved(pose[this.model.bodies[part.body].name] ?? IDENTITY, corner)),
    );
    const { middle } = boxOf(corners);
    const { back, right, up, slope } = cameraOf({ ...this.camera, target: middle, distance: 1 }, this.#aspect);
    const seen = corners.map((corner) => {
      const offset = add(corner, scaled(middle, -1));
      return [dot(offset, right), dot(offset, up), dot(offset, back)];
    });
    // Aim at the middle of what is seen, then step back until every corner is in the frame.
    const box = boxOf(seen);
    const need = seen.map(([x, y, z]) =>
      z + Math.max(Math.abs(x - box.middle[0]) / this.#aspect, Math.abs(y - box.middle[1])) / slope,
    );
    const target = add(middle, add(scaled(right, box.middle[0]), scaled(up, box.middle[1])));
    return { target, distance: 1.06 * need.reduce((most, value) => Math.max(most, value), 0) };
  }

  /** The hand on the camera ends its own movement. */
  #steady() {
    if (this.animation) this.move(this.goal);
    this.animation = null;
  }

  #orbit(dx, dy) {
    this.#steady();
    this.camera.azimuth -= 0.006 * dx;
    this.camera.elevation = Math.min(Math.max(this.camera.elevation + 0.006 * dy, -1.5), 1.5);
    this.request();
  }

  #pan(dx, dy) {
    this.#steady();
    const { right, up, slope } = cameraOf(this.camera, this.#aspect);
    const metres = (2 * slope * this.camera.distance) / this.stage.clientHeight;
    this.camera.target = add(this.camera.target, add(scaled(right, -dx * metres), scaled(up, dy * metres)));
    this.request();
  }

  /** Zooms by a factor towards a pixel of the stage. */
  #zoom(factor, x, y) {
    const radius = this.scene.radius;
    const distance = Math.min(Math.max(this.camera.distance * factor, 0.05 * radius), 30 * radius);
    const share = 1 - distance / this.camera.distance;
    this.#pan((this.stage.clientWidth / 2 - x) * share, (this.stage.clientHeight / 2 - y) * share);
    this.camera.distance = distance;
  }

  #pointer() {
    const { canvas } = this;
    const down = new Map();
    let travelled = 0;
    const at = (event) => {
      const box = canvas.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      canvas.focus({ preventScroll: true });
      if (!down.size) travelled = 0;
      down.set(event.pointerId, at(event));
      this.tip.hidden = true;
    });
    canvas.addEventListener("pointermove", (event) => {
      const before = down.get(event.pointerId);
      if (!before) return this.#hover(at(event));
      const now = at(event);
      const [dx, dy] = [now[0] - before[0], now[1] - before[1]];
      travelled += Math.hypot(dx, dy);
      if (down.size === 2) {
        const other = [...down].find(([id]) => id !== event.pointerId)[1];
        const apart = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]) || 1;
        this.#pan(dx / 2, dy / 2);
        this.#zoom(apart(before) / apart(now), (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
      } else if (event.buttons & 6 || event.shiftKey) this.#pan(dx, dy);
      else this.#orbit(dx, dy);
      down.set(event.pointerId, now);
    });
    const up = (event) => {
      const was = down.delete(event.pointerId);
      const click = was && event.type === "pointerup" && travelled < 5 && event.button === 0;
      if (click) this.choose(this.pick(...at(event)), event);
    };
    canvas.addEventListener("pointerup", up);
    canvas.addEventListener("pointercancel", up);
    canvas.addEventListener("pointerleave", () => (this.tip.hidden = true));
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("dblclick", () => this.reset());
    const wheel = (event) => {
      // The page keeps scrolling until the view was clicked.
      if (document.activeElement !== canvas && !event.ctrlKey && !document.fullscreenElement) return;
      event.preventDefault();
      this.#zoom(Math.exp(Math.max(-0.5, Math.min(0.5, event.deltaY * 0.0015))), ...at(event));
    };
    canvas.addEventListener("wheel", wheel, { passive: false });
    canvas.addEventListener("keydown", (event) => {
      const middle = [this.stage.clientWidth / 2, this.stage.clientHeight / 2];
      const act = {
        ArrowLeft: () => this.#orbit(25, 0), ArrowRight: () => this.#orbit(-25, 0),
        ArrowUp: () => this.#orbit(0, 25), ArrowDown: () => this.#orbit(0, -25),
        "+": () => this.#zoom(0.85, ...middle), "=": () => this.#zoom(0.85, ...middle),
        "-": () => this.#zoom(1.18, ...middle), 0: () => this.reset(), Escape: () => this.choose(0),
      }[event.key];
      if (!act || event.altKey || event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      act();
    });
  }

  #hover([x, y]) {
    this.over = [x, y];
    if (this.waiting) return;
    const part = this.model.parts[this.pick(x, y) - 1];
    this.#tell(part && `${part.name} · ${words(this.model.bodies[part.body].name)}`, x, y);
  }

  #tell(text, x, y) {
    this.tip.hidden = !text;
    this.tip.textContent = text ?? "";
    this.tip.style.transform = `translate(${x + 14}px, ${y + 16}px)`;
  }

  /** Number of the part at a pixel of the stage, 0: none. */
  pick(x, y) {
    const ratio = this.canvas.width / this.stage.clientWidth;
    return this.renderer.partAt(Math.floor(x * ratio), Math.floor(y * ratio));
  }

  /** What is seen at a pixel of the stage: the part's number and the point, in the part's own frame; null: nothing. */
  surfaceAt(x, y) {
    const part = this.model.parts[this.pick(x, y) - 1];
    if (!part) return null;
    const { eye, back, right, up, slope } = cameraOf(this.camera, this.#aspect, this.scene);
    const across = ((2 * x) / this.stage.clientWidth - 1) * slope * this.#aspect;
    const away = (1 - (2 * y) / this.stage.clientHeight) * slope;
    const local = inverse(part.place);
    const from = moved(local, eye);
    const way = turned(local, add(add(scaled(right, across), scaled(up, away)), scaled(back, -1)));
    const shape = this.model.shapes[part.shape];
    const { points, indices } = decodeMesh(shape);
    const corner = (i) => [0, 1, 2].map((k) => shape.low[k] + (points[3 * i + k] / 65535) * shape.size[k]);
    let nearest = Infinity;
    for (let i = 0; i < indices.length; i += 3) {
      const [a, b, c] = [corner(indices[i]), corner(indices[i + 1]), corner(indices[i + 2])];
      const [ab, ac, offset] = [b, c, from].map((p) => add(p, scaled(a, -1)));
      const side = cross(way, ac);
      const volume = dot(ab, side);
      if (!volume) continue;
      const u = dot(offset, side) / volume;
      const turn = cross(offset, ab);
      const v = dot(way, turn) / volume;
      const t = dot(ac, turn) / volume;
      if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < nearest) nearest = t;
    }
    return nearest < Infinity ? { number: part.number, part: part.path, point: add(from, scaled(way, nearest)) } : null;
  }

  /** Axes that are shown whatever else is: of a joint by its name, or `{number, point, direction}` of a part's frame. */
  showAxes(axes) {
    this.axes = axes;
    this.#drawMarks();
  }

  /** Pixel of the stage where a point of the machine frame is seen; null behind the camera. */
  project(point) {
    const m = cameraOf(this.camera, this.#aspect, this.scene).matrix;
    const depth = m[3] * point[0] + m[7] * point[1] + m[11] * point[2] + m[15];
    if (depth <= 0) return null;
    const [x, y] = moved(m, point);
    return [(0.5 + (0.5 * x) / depth) * this.stage.clientWidth, (0.5 - (0.5 * y) / depth) * this.stage.clientHeight];
  }

  // ---- drawing on demand -------------------------------------------------------------------------------------------
  /** Draws with the next frame, and once more, finer, when nothing has changed for a moment. */
  request() {
    clearTimeout(this.resting);
    if (this.waiting) return;
    this.waiting = requestAnimationFrame(() => {
      this.waiting = 0;
      this.draw(1);
      if (devicePixelRatio < 2 && this.quickest < SLOW) this.resting = setTimeout(() => this.draw(2), 140);
    });
  }

  draw(fine) {
    const start = performance.now();
    const ratio = devicePixelRatio || 1;
    const { clientWidth, clientHeight } = this.stage;
    const [width, height] = [clientWidth, clientHeight].map((size) => Math.max(1, Math.round(size * ratio)));
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    const camera = cameraOf(this.camera, this.#aspect, this.scene);
    const chosen = this.lit ?? new Set([this.chosen]);
    this.renderer.draw(this.model.parts, camera, this.scene, { fine, chosen, moved: this.shadowsOld });
    this.shadowsOld = false;
    if (fine === 1 && this.trials < 3) {
      // Reading a pixel waits for the frame: where coarse ones are slow (no graphics card), fine ones are left out.
      this.renderer.partAt(0, 0);
      this.quickest = Math.min(this.quickest, performance.now() - start);
      this.trials++;
    }
    this.#drawMarks();
  }

  /** Marks over the picture. They are kept from frame to frame, so that one that has the focus keeps it. */
  #drawMarks() {
    const old = this.marks;
    this.marks = new Map();
    this.kept = old;
    if (this.showSensors) this.#drawSensors();
    if (this.showJoints) this.#drawJoints();
    for (const [index, axis] of (this.axes ?? []).entries()) this.#drawAxis(index, axis);
    for (const [key, mark] of old) if (!this.marks.has(key)) mark.group.remove();
  }

  /** A group that tells what it is under the pointer, when clicked, and when it has the focus: `at` says where, and
   * `told` what; `shapes` are its children, by name. With the name of a `joint` it also chooses that, where a page has
   * something to say of joints (`onjoint`). */
  #mark(key, kind, shapes, at, told, joint = null) {
    const mark = this.kept.get(key) ?? { shapes: shapes(), group: svg("g", { class: kind, tabindex: 0, role: "img" }) };
    if (!mark.group.parentNode) {
      const tell = () => this.#tell(mark.told(), ...mark.at);
      const hush = () => (this.tip.hidden = true);
      for (const event of ["pointerenter", "click", "focus"]) mark.group.addEventListener(event, tell);
      for (const event of ["pointerleave", "blur"]) mark.group.addEventListener(event, hush);
      mark.group.addEventListener("keydown", (event) => {
        // Such a key is the mark's alone, no answer to a page's question.
        if (event.key === "Enter" || event.key === " ") (event.preventDefault(), event.stopPropagation(), tell(), mark.act());
        else if (event.key === "Escape") hush();
      });
      mark.group.addEventListener("click", () => mark.act());
      mark.group.append(...Object.values(mark.shapes));
      this.overlay.append(mark.group);
    }
    Object.assign(mark, { at, told, act: () => joint && this.onjoint?.(joint) });
    mark.group.setAttribute("aria-label", told());
    if (mark.group === document.activeElement && !this.tip.hidden) this.#tell(told(), ...at);
    this.marks.set(key, mark);
    return mark.shapes;
  }

  /** Sensors over the picture, with what they see; they move with their bodies. */
  #drawSensors() {
    for (const [index, sensor] of this.model.sensors.entries()) {
      const pose = this.pose[sensor.body];
      const spot = pose && this.project(moved(pose, sensor.at));
      if (!spot) continue;
      const shapes = this.#mark(`sensor ${index}`, `v-sensor${sensor.views.length ? " v-looks" : ""}`, () => ({
        ...sensor.views.map(([kind]) => svg("polygon", { class: `view ${kind}` })),
        spot: svg("circle", { r: 5 }),
      }), spot, () => `${words(sensor.name)} · ${words(sensor.type)}`);
      for (const [number, [, outline]] of sensor.views.entries()) {
        const points = [];
        for (let i = 0; i < outline.length; i += 3) points.push(this.project(moved(pose, outline.slice(i, i + 3))));
        // An outline that reaches behind the camera has no place in the picture.
        const whole = points.every((point) => point);
        change(shapes[number], { points: whole ? points.map((p) => p.map(tenth).join(",")).join(" ") : "" });
      }
      change(shapes.spot, { cx: spot[0], cy: spot[1] });
    }
  }

  /** An arrow on the ground under the machine: where its front is. */
  #drawAhead() {
    const { middle, radius } = this.scene;
    const reach = (share) => this.project([middle[0] + share * radius, middle[1], 0]);
    const [a, b, l, r] = [reach(-0.4), reach(0.85), ...[-0.08, 0.08].map((y) => this.project([middle[0] + 0.71 * radius, middle[1] + y * radius, 0]))];
    if (!a || !b || !l || !r) return;
    const { line, head, label } = this.#mark("ahead", "v-axis v-ahead", () => ({ line: svg("line"), head: svg("polyline"), label: svg("text") }), b, () => "Its front is there");
    change(line, { x1: a[0], y1: a[1], x2: b[0], y2: b[1] });
    change(head, { points: [l, b, r].map((p) => p.map(tenth).join(",")).join(" ") });
    // Where the arrow leaves the picture its word stays.
    const { clientWidth, clientHeight } = this.stage;
    change(label, { x: Math.max(4, Math.min(b[0] + 8, clientWidth - 46)), y: Math.max(16, Math.min(b[1] + 18, clientHeight - 34)) });
    label.textContent = "front";
  }

  #drawAxis(index, axis) {
    if (axis.ahead) return this.#drawAhead();
    const joint = this.model.joints.find((each) => each.name === axis);
    const place = joint ? this.pose[joint.parent] : this.model.parts[axis.number - 1]?.place;
    if (!place) return;
    const middle = moved(place, joint ? joint.anchor : axis.point);
    const way = scaled(unit(turned(place, joint ? joint.axis : axis.direction)), 0.16 * this.scene.radius);
    const [a, b, m] = [add(middle, way), add(middle, scaled(way, -1)), middle].map((point) => this.project(point));
    if (!a || !b || !m) return;
    const kind = `v-axis${joint ? "" : " v-meant"}`;
    const told = () => (joint ? `${joint.name} · ${joint.type}` : "The axis that was pointed at");
    const { line, spot, head } = this.#mark(`axis ${index} ${kind}`, kind, () => ({
      line: svg("line"), spot: svg("circle", { r: 5 }), head: svg("circle", { r: 3 }),
    }), m, told, joint?.name);
    change(line, { x1: a[0], y1: a[1], x2: b[0], y2: b[1] });
    change(spot, { cx: m[0], cy: m[1] });
    change(head, { cx: a[0], cy: a[1] });
  }

  /** Joint axes over the picture: filled marks for joints of the tree, hollow ones where a loop is cut. */
  #drawJoints() {
    for (const [index, joint] of this.model.joints.entries()) {
      const pose = this.pose[joint.parent];
      if (!pose) continue;
      const reach = 0.06 * this.scene.radius;
      const middle = moved(pose, joint.anchor);
      const axis = scaled(turned(pose, joint.axis), reach);
      const [a, b, m] = [add(middle, axis), add(middle, scaled(axis, -1)), middle].map((point) => this.project(point));
      if (!a || !b || !m) continue;
      const told = () => {
        const value = coordinateOf(joint, this.pose);
        const shown = joint.type === "prismatic" ? `${signed(1e3 * value, 0)} mm` : degrees(value);
        const now = value == null ? "" : `, ${shown}`;
        return `${index + 1} ${joint.name} · ${joint.type}${joint.cut ? ", cut" : ""}${now}`;
      };
      const slides = joint.type === "prismatic";
      const { line, spot } = this.#mark(`joint ${index}`, `v-joint v-${joint.type}${joint.cut ? " v-cut" : ""}`, () => ({
        line: svg("line"), spot: slides ? svg("rect", { width: 9, height: 9 }) : svg("circle", { r: 5 }),
      }), m, told, joint.name);
      change(line, { x1: a[0], y1: a[1], x2: b[0], y2: b[1] });
      change(spot, slides ? { x: m[0] - 4.5, y: m[1] - 4.5 } : { cx: m[0], cy: m[1] });
    }
  }
}
