/** The 3D view: its layout, what is shown, and what is known of the part that was clicked. */

import { type Ball, type Camera, cameraOf, fitted, seenAt, type View, wayThrough } from "./camera.ts";
import { button, element, still, svg, words } from "./dom.ts";
import { listen } from "./gestures.ts";
import { type Axis, Marks } from "./marks.ts";
import { met } from "./meshes.ts";
import type { Model, Part, PartEntry } from "./model.ts";
import { moveSections, type Slider, sliderOf, standing } from "./move.ts";
import { PartList } from "./parts.ts";
import { type Given, type Pose, poseOf } from "./pose.ts";
import { Renderer } from "./renderer.ts";
import { tabs } from "./tabs.ts";
import { add, boxOf, IDENTITY, moved, multiply, scaled, type Vector } from "./vectors.ts";

const SLOW = 150; // milliseconds for a frame
const PALE = [172, 174, 176]; // four fifths of what parts that are not asked for turn to

export interface Options {
  /** More tabs of the panel. */
  pages?: [string, HTMLElement][];
  /** Takes the place of the card. */
  onchoose?: ((number: number, event: MouseEvent | null) => unknown) | null;
  /** Hears of a joint whose mark is clicked or entered. */
  onjoint?: ((name: string) => unknown) | null;
}

/** A place that was clicked: the part's number and path, and the point in the part's own frame. */
export interface Hit {
  number: number;
  part: string;
  point: number[];
}

export class Viewer {
  model: Model;
  /** Numbers of the parts that are shown through all others. */
  lit: ReadonlySet<number> | null = null;
  /** Coordinates of independent joints. */
  given: Given = {};
  pose: Pose = {};
  chosen = 0;
  showJoints = false;
  showSensors = false;
  axes: readonly Axis[] = [];
  sliders: Slider[] = [];
  scene: Ball = { middle: [0, 0, 0], radius: 1 };
  camera: View = { target: [0, 0, 0], azimuth: -0.75, elevation: 0.3, distance: 1 };
  readonly canvas: HTMLCanvasElement;
  readonly overlay: SVGElement;
  readonly tip = element("div", { class: "v-tip", hidden: true });
  readonly stage: HTMLElement;
  readonly renderer: Renderer;
  readonly onchoose: Options["onchoose"];
  readonly onjoint: ((name: string) => unknown) | null;
  private readonly card = element("div", { class: "v-card", role: "status", hidden: true });
  private readonly hint: HTMLElement;
  private readonly movePage = element("div", {});
  private angles = element("dl", { class: "v-angles" });
  private readonly list: PartList;
  private readonly marks: Marks;
  private byBody = false;
  private shadowsOld = true;
  private partsOld = true;
  private waiting = 0;
  private resting: number | undefined;
  private trials = 0;
  private quickest = Infinity;
  private animation: ((now: number) => void) | null = null;
  private goal: Given = {};

  constructor(private readonly root: HTMLElement, model: Model<PartEntry>, { pages = [], onchoose = null, onjoint = null }: Options = {}) {
    this.onchoose = onchoose;
    this.onjoint = onjoint;
    this.model = prepared(model);
    this.canvas = element("canvas", {
      tabindex: 0,
      role: "img",
      "aria-label": "The machine in three dimensions. Arrow keys turn it, plus and minus zoom, 0 shows all of it.",
    });
    this.overlay = svg("svg", { role: "group", "aria-label": "Marks on the machine" });
    this.hint = element("div", { class: "v-hint" }, matchMedia("(hover: none)").matches
      ? "Drag sideways to turn, two fingers to move and zoom" : "Drag to turn, right-drag to move, click and scroll to zoom");
    this.stage = element("div", { class: "v-stage" }, this.canvas, this.overlay, this.tools(), this.hint, this.card, this.tip);
    this.renderer = new Renderer(this.canvas, this.model.shapes, this.model.parts);
    this.marks = new Marks(this);
    this.list = new PartList(this);
    this.measure();
    this.fillMove();
    const panel = element("div", { class: "v-panel" }, ...tabs([["Move", this.movePage], ["Parts", this.list.page], ...pages]));
    listen(this);
    this.listenToGraphics();
    const before = [...root.childNodes];
    root.classList.add("v-ready");
    root.replaceChildren(this.stage, panel);
    this.move({});
    this.reset();
    try {
      this.draw(1);
    } catch (error) {
      // What was there instead of the view stays.
      root.classList.remove("v-ready");
      root.replaceChildren(...before);
      throw error;
    }
    new ResizeObserver(() => this.request()).observe(this.stage);
  }

  // ---- layout ------------------------------------------------------------------------------------------------------
  private tools(): HTMLElement {
    const toggle = (label: string, change: (on: boolean) => void) => {
      const made = button(label, () => {
        const on = made.getAttribute("aria-pressed") !== "true";
        made.setAttribute("aria-pressed", String(on));
        change(on);
      }, { "aria-pressed": "false" });
      return made;
    };
    return element(
      "div",
      { class: "v-tools" },
      toggle("By body", (on) => { this.byBody = on; this.recolor(); }),
      toggle("Joints", (on) => { this.showJoints = on; this.drawMarks(); }),
      this.model.sensors.length ? toggle("Sensors", (on) => { this.showSensors = on; this.drawMarks(); }) : null,
      button("Reset view", () => this.reset()),
      button("Full screen", () => { void (document.fullscreenElement ? document.exitFullscreen() : this.root.requestFullscreen?.()); }),
      button("Save picture", () => this.save()),
    );
  }

  private listenToGraphics(): void {
    const hint = this.hint.textContent;
    this.canvas.addEventListener("webglcontextlost", () => {
      this.hint.textContent = "The browser has taken the graphics away; reload the page if it does not give them back.";
    });
    this.canvas.addEventListener("webglcontextrestored", () => {
      this.hint.textContent = hint;
      this.shadowsOld = true;
      this.request();
    });
  }

  /** Hands what is seen over as a PNG file, at twice the screen's pixels. */
  save(): void {
    this.draw(2);
    // Before the browser shows the frame: the picture is gone after that.
    this.canvas.toBlob((blob) => {
      if (!blob) return;
      const link = element("a", { href: URL.createObjectURL(blob), download: "machine.png" });
      link.click();
      URL.revokeObjectURL(link.href);
    });
  }

  private recolor(): void {
    for (const part of this.model.parts) {
      const color = this.byBody ? this.model.bodies[part.body].color : part.drawn;
      part.color = !this.lit || this.lit.has(part.number) ? color : color.map((value, k) => 0.2 * value + PALE[k]);
    }
    this.partsOld = true;
    this.request();
  }

  /** Parts (a set of numbers) that are shown through all others, which turn pale; null: none. */
  light(numbers: ReadonlySet<number> | null): void {
    this.lit = numbers?.size ? numbers : null;
    this.recolor();
  }

  /** Another state of the same machine: the shapes, what is hidden and the camera stay. */
  update(model: Model<PartEntry>): void {
    const before = this.model;
    this.model = Object.assign(prepared(model, before.parts), { shapes: before.shapes, leftOut: before.leftOut });
    this.measure();
    this.fillMove();
    this.list.fill();
    this.recolor();
    const joints = new Set(this.model.sliders.flatMap((slider) => slider.joints.map(([joint]) => joint)));
    this.move(Object.fromEntries(Object.entries(this.given).filter(([joint]) => joints.has(joint))));
  }

  /** Each part's drawn placement and the corners of its box; the machine's box. */
  private measure(): void {
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

  private fillMove(): void {
    this.sliders = this.model.sliders.map((slider) => sliderOf(slider, (name, value) => this.set(name, value)));
    this.angles = element("dl", { class: "v-angles" });
    this.movePage.replaceChildren(...moveSections(this.model, this.sliders, this.angles, (given) => this.animate(given)));
  }

  // ---- parts -------------------------------------------------------------------------------------------------------
  /** Shows the parts that a test holds for, hides all others. */
  show(test: (part: Part) => boolean): void {
    for (const part of this.model.parts) part.hidden = !test(part);
    this.list.fill();
    this.changed();
  }

  /** Chooses a part by its number (0: none) and says what is known of it. */
  choose(number: number, event: MouseEvent | null = null): unknown {
    if (this.onchoose) return this.onchoose(number, event);
    this.chosen = number;
    this.partsOld = true;
    const part = this.model.parts[number - 1];
    this.card.hidden = !part;
    if (part) {
      const doubt = part.review ? element("span", { class: "tag review" }, "to review") : null;
      const sure = part.confidence == null ? "" : `, confidence ${part.confidence.toFixed(2)}`;
      const body = this.model.bodies[part.body].name;
      const role = part.role && part.role !== body ? `${words(part.role)} on ` : "";
      this.card.replaceChildren(
        button("×", () => this.choose(0), { "aria-label": "Close" }),
        element("b", {}, part.name),
        element("p", {}, `${role}${words(body)}${sure} `, doubt),
        element("p", { class: "dim v-reason" }, part.reason),
        button("Hide", () => this.show((each) => each !== part && !each.hidden)),
        button("Isolate", () => this.show((each) => each === part)),
        button("Isolate body", () => this.show((each) => each.body === part.body)),
        element("a", { href: `#part=${encodeURIComponent(part.path)}` }, "Link"),
      );
    }
    this.list.fill();
    return this.request();
  }

  // ---- the machine's pose ------------------------------------------------------------------------------------------
  /** Sets a slider by its name to a coordinate of its first joint (metres or radians from the drawn pose). */
  set(name: string, value: number): void {
    this.animation = null;
    const slider = this.sliders.find((each) => each.name === name);
    this.move({ ...this.given, ...Object.fromEntries((slider?.joints ?? []).map(([joint, sign]) => [joint, sign * value])) });
  }

  /** Poses the machine: coordinates of independent joints, 0 where none is given. */
  move(given: Given): void {
    this.given = given;
    this.pose = poseOf(this.model, given);
    for (const slider of this.sliders) slider.show(given[slider.joints[0][0]] ?? 0);
    this.angles.replaceChildren(...standing(this.model, this.pose).map(([name, value]) =>
      element("div", {}, element("dt", {}, name), element("dd", {}, value))));
    this.changed();
  }

  /** Goes to a pose within a second, at once where motion is unwelcome; the camera keeps all of it in the frame. */
  animate(given: Given): void {
    const start = { ...this.given };
    const [from, to] = [this.camera, this.fitted(poseOf(this.model, given))];
    const names = [...new Set([...Object.keys(start), ...Object.keys(given)])];
    const begin = performance.now();
    const length = still() ? 0 : 600;
    const step = (now: number) => {
      if (this.animation !== step) return;
      const t = length ? Math.min(Math.max((now - begin) / length, 0), 1) : 1;
      const share = t * t * (3 - 2 * t);
      this.camera = {
        ...this.camera,
        target: add(scaled(from.target, 1 - share), scaled(to.target, share)),
        distance: (1 - share) * from.distance + share * to.distance,
      };
      const between = (name: string) => (1 - share) * (start[name] ?? 0) + share * (given[name] ?? 0);
      this.move(Object.fromEntries(names.map((name) => [name, between(name)])));
      if (t < 1) requestAnimationFrame(step);
      else this.animation = null;
    };
    this.animation = step;
    this.goal = given;
    requestAnimationFrame(step);
  }

  private changed(): void {
    for (const part of this.model.parts) part.place = multiply(this.bodyPlace(part, this.pose), part.rest);
    this.shadowsOld = this.partsOld = true;
    this.request();
  }

  private bodyPlace(part: Part, pose: Pose) {
    return pose[this.model.bodies[part.body].name] ?? IDENTITY;
  }

  // ---- camera ------------------------------------------------------------------------------------------------------
  get aspect(): number {
    return (this.stage.clientWidth || 16) / (this.stage.clientHeight || 9);
  }

  private seen(): Camera {
    return cameraOf(this.camera, this.aspect, this.scene);
  }

  /** Looks at all that is shown, from the front right. */
  reset(): void {
    this.camera = { ...this.camera, azimuth: -0.75, elevation: 0.3 };
    Object.assign(this.camera, this.fitted(this.pose));
    this.request();
  }

  /** Looks at these parts (a set of numbers) from where the camera is. */
  focus(numbers: ReadonlySet<number>): void {
    const parts = this.model.parts.filter((part) => numbers.has(part.number));
    if (!parts.length) return;
    const { low, high, middle } = boxOf(this.corners(parts, this.pose));
    const across = Math.hypot(...high.map((value, k) => value - low[k]));
    this.camera = { ...this.camera, target: middle, distance: Math.max(across, 0.12 * this.scene.radius) * 4.5 };
    this.request();
  }

  private corners(parts: readonly Part[], pose: Pose): Vector[] {
    return parts.flatMap((part) => part.corners.map((corner) => moved(this.bodyPlace(part, pose), corner)));
  }

  /** Target and distance from which all shown parts in a pose are seen at the camera's angles. */
  private fitted(pose: Pose): Pick<View, "target" | "distance"> {
    const parts = this.model.parts.filter((part) => !part.hidden);
    return fitted(this.corners(parts.length ? parts : this.model.parts, pose), this.camera, this.aspect);
  }

  /** The hand on the camera ends its own movement. */
  private steady(): void {
    if (this.animation) this.move(this.goal);
    this.animation = null;
  }

  orbit(dx: number, dy: number): void {
    this.steady();
    this.camera.azimuth -= 0.006 * dx;
    this.camera.elevation = Math.min(Math.max(this.camera.elevation + 0.006 * dy, -1.5), 1.5);
    this.request();
  }

  pan(dx: number, dy: number): void {
    this.steady();
    const { right, up, slope } = cameraOf(this.camera, this.aspect);
    const metres = (2 * slope * this.camera.distance) / this.stage.clientHeight;
    this.camera.target = add(this.camera.target, add(scaled(right, -dx * metres), scaled(up, dy * metres)));
    this.request();
  }

  zoom(factor: number, x: number, y: number): void {
    const { radius } = this.scene;
    const distance = Math.min(Math.max(this.camera.distance * factor, 0.05 * radius), 30 * radius);
    const share = 1 - distance / this.camera.distance;
    this.pan((this.stage.clientWidth / 2 - x) * share, (this.stage.clientHeight / 2 - y) * share);
    this.camera.distance = distance;
  }

  hover(x: number, y: number): void {
    if (this.waiting) return;
    const part = this.model.parts[this.pick(x, y) - 1];
    this.tell(part && `${part.name} · ${words(this.model.bodies[part.body].name)}`, x, y);
  }

  tell(text: string | null | undefined, x: number, y: number): void {
    this.tip.hidden = !text;
    this.tip.textContent = text ?? "";
    this.tip.style.transform = `translate(${x + 14}px, ${y + 16}px)`;
  }

  /** Number of the part at a pixel of the stage, 0: none. */
  pick(x: number, y: number): number {
    const ratio = this.canvas.width / this.stage.clientWidth;
    return this.renderer.partAt(Math.floor(x * ratio), Math.floor(y * ratio));
  }

  /** What is seen at a pixel of the stage; null: nothing. */
  surfaceAt(x: number, y: number): Hit | null {
    const part = this.model.parts[this.pick(x, y) - 1];
    if (!part) return null;
    const camera = this.seen();
    const { clientWidth, clientHeight } = this.stage;
    const way = wayThrough(camera, this.aspect, (2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight);
    const point = met(part, this.model.shapes[part.shape], camera.eye, way);
    return point && { number: part.number, part: part.path, point };
  }

  /** Axes that are shown whatever else is. */
  showAxes(axes: readonly Axis[]): void {
    this.axes = axes;
    this.drawMarks();
  }

  /** Pixel of the stage where a point of the machine frame is seen; null behind the camera. */
  project(point: Vector): [number, number] | null {
    const at = seenAt(this.seen().matrix, point);
    return at && [(0.5 + 0.5 * at[0]) * this.stage.clientWidth, (0.5 - 0.5 * at[1]) * this.stage.clientHeight];
  }

  // ---- drawing on demand -------------------------------------------------------------------------------------------
  /** Draws with the next frame, and once more, finer, when nothing has changed for a moment. */
  request(): void {
    clearTimeout(this.resting);
    if (this.waiting) return;
    this.waiting = requestAnimationFrame(() => {
      this.waiting = 0;
      this.draw(1);
      if (devicePixelRatio < 2 && this.quickest < SLOW) this.resting = window.setTimeout(() => this.draw(2), 140);
    });
  }

  draw(fine: number): void {
    const start = performance.now();
    const ratio = devicePixelRatio || 1;
    const { clientWidth, clientHeight } = this.stage;
    const [width, height] = [clientWidth, clientHeight].map((size) => Math.max(1, Math.round(size * ratio)));
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    const chosen = this.lit ?? new Set(this.chosen ? [this.chosen] : []);
    this.renderer.draw(this.model.parts, this.seen(), this.scene, { fine, chosen, moved: this.shadowsOld, same: !this.partsOld });
    this.shadowsOld = this.partsOld = false;
    if (fine === 1 && this.trials < 3) {
      // Reading a pixel waits for the frame: where coarse ones are slow (no graphics card), fine ones are left out.
      this.renderer.partAt(0, 0);
      this.quickest = Math.min(this.quickest, performance.now() - start);
      this.trials++;
    }
    this.drawMarks();
  }

  private drawMarks(): void {
    this.marks.draw({ joints: this.showJoints, sensors: this.showSensors, axes: this.axes });
  }
}

/** Parts with what is kept of each on the screen. */
function prepared(model: Model<PartEntry>, before: readonly Part[] = []): Model {
  const parts = model.parts.map((part, index): Part => ({
    ...part, number: index + 1, hidden: before[index]?.hidden ?? false, drawn: part.color, rest: IDENTITY, corners: [],
  }));
  return { ...model, parts };
}
