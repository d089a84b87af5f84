/** Marks over the picture: joints, sensors, axes. They are kept from frame to frame, so that one that has the focus keeps
 * it. */

import { change, degrees, millimetres, svg, words } from "./dom.ts";
import type { Joint, Model } from "./model.ts";
import { coordinateOf, type Pose } from "./pose.ts";
import { add, moved, scaled, turned, unit, type Vector } from "./vectors.ts";
import type { Ball } from "./camera.ts";

/** An axis that is shown whatever else is: a joint's, by its name, or a line of a part's own frame; or the arrow on the
 * ground that shows where the front is. */
export type Axis = string | { number: number; point: Vector; direction: Vector } | { ahead: true };

/** What marks need of the view. */
export interface Marked {
  readonly model: Model;
  readonly pose: Pose;
  readonly scene: Ball;
  readonly overlay: SVGElement;
  readonly stage: HTMLElement;
  readonly tip: HTMLElement;
  readonly onjoint: ((name: string) => unknown) | null;
  project(point: Vector): [number, number] | null;
  tell(text: string | null | undefined, x: number, y: number): void;
}

export interface Wanted {
  joints: boolean;
  sensors: boolean;
  axes: readonly Axis[];
}

interface Mark {
  group: SVGElement;
  shapes: Record<string, SVGElement>;
  at: Vector;
  told: () => string;
  act: () => unknown;
}

const tenth = (value: number): string => value.toFixed(1);
const outlined = (points: readonly Vector[]): string => points.map((p) => p.map(tenth).join(",")).join(" ");

export class Marks {
  private marks = new Map<string, Mark>();
  private kept = new Map<string, Mark>();

  constructor(private readonly view: Marked) {}

  draw({ joints, sensors, axes }: Wanted): void {
    this.kept = this.marks;
    this.marks = new Map();
    if (sensors) this.sensors();
    if (joints) this.joints();
    axes.forEach((axis, index) => this.axis(index, axis));
    for (const [key, mark] of this.kept) if (!this.marks.has(key)) mark.group.remove();
  }

  /** A group that tells what it is under the pointer, when clicked, and when it has the focus: `at` says where, and
   * `told` what; `shapes` are its children, by name. With the name of a `joint` it also chooses that, where a page has
   * something to say of joints (`onjoint`). */
  private mark(key: string, kind: string, shapes: () => Record<string, SVGElement>, at: Vector, told: () => string, joint: string | null = null): Record<string, SVGElement> {
    const { view } = this;
    const act = () => joint && view.onjoint?.(joint);
    let mark = this.kept.get(key);
    if (mark) Object.assign(mark, { at, told, act });
    else mark = this.made({ shapes: shapes(), group: svg("g", { class: kind, tabindex: 0, role: "img" }), at, told, act });
    mark.group.setAttribute("aria-label", told());
    if (mark.group === document.activeElement && !view.tip.hidden) view.tell(told(), at[0], at[1]);
    this.marks.set(key, mark);
    return mark.shapes;
  }

  private made(mark: Mark): Mark {
    const { view } = this;
    const tell = () => view.tell(mark.told(), mark.at[0], mark.at[1]);
    const hush = () => (view.tip.hidden = true);
    for (const event of ["pointerenter", "click", "focus"]) mark.group.addEventListener(event, tell);
    for (const event of ["pointerleave", "blur"]) mark.group.addEventListener(event, hush);
    mark.group.addEventListener("keydown", (event) => {
      // Such a key is the mark's alone, no answer to a page's question.
      if (event.key === "Enter" || event.key === " ") {
        event.preventDefault();
        event.stopPropagation();
        tell();
        mark.act();
      } else if (event.key === "Escape") hush();
    });
    mark.group.addEventListener("click", () => mark.act());
    mark.group.append(...Object.values(mark.shapes));
    view.overlay.append(mark.group);
    return mark;
  }

  /** Sensors, with what they see; they move with their bodies. */
  private sensors(): void {
    const { view } = this;
    for (const [index, sensor] of view.model.sensors.entries()) {
      const pose = view.pose[sensor.body];
      const spot = pose && view.project(moved(pose, sensor.at));
      if (!spot) continue;
      const shapes = this.mark(`sensor ${index}`, `v-sensor${sensor.views.length ? " v-looks" : ""}`, () => ({
        ...Object.fromEntries(sensor.views.map(([kind], number) => [number, svg("polygon", { class: `view ${kind}` })])),
        spot: svg("circle", { r: 5 }),
      }), spot, () => `${words(sensor.name)} · ${words(sensor.type)}`);
      for (const [number, [, outline]] of sensor.views.entries()) {
        const points: ([number, number] | null)[] = [];
        for (let i = 0; i < outline.length; i += 3) points.push(view.project(moved(pose, outline.slice(i, i + 3))));
        // An outline that reaches behind the camera has no place in the picture.
        const whole = points.filter((point) => point != null);
        change(shapes[number], { points: whole.length === points.length ? outlined(whole) : "" });
      }
      change(shapes.spot, { cx: spot[0], cy: spot[1] });
    }
  }

  /** An arrow on the ground under the machine: where its front is. */
  private ahead(): void {
    const { view } = this;
    const { middle, radius } = view.scene;
    const reach = (x: number, y = 0) => view.project([middle[0] + x * radius, middle[1] + y * radius, 0]);
    const [a, b, l, r] = [reach(-0.4), reach(0.85), reach(0.71, -0.08), reach(0.71, 0.08)];
    if (!a || !b || !l || !r) return;
    const shapes = () => ({ line: svg("line"), head: svg("polyline"), label: svg("text") });
    const { line, head, label } = this.mark("ahead", "v-axis v-ahead", shapes, b, () => "Its front is there");
    change(line, { x1: a[0], y1: a[1], x2: b[0], y2: b[1] });
    change(head, { points: outlined([l, b, r]) });
    // Where the arrow leaves the picture its word stays.
    const { clientWidth, clientHeight } = view.stage;
    change(label, { x: Math.max(4, Math.min(b[0] + 8, clientWidth - 46)), y: Math.max(16, Math.min(b[1] + 18, clientHeight - 34)) });
    label.textContent = "front";
  }

  private axis(index: number, axis: Axis): void {
    const { view } = this;
    if (typeof axis !== "string" && "ahead" in axis) return this.ahead();
    const joint = typeof axis === "string" ? view.model.joints.find((each) => each.name === axis) : undefined;
    if (typeof axis === "string" && !joint) return;
    const line = joint ? { point: joint.anchor, direction: joint.axis } : (axis as { number: number; point: Vector; direction: Vector });
    const place = joint ? view.pose[joint.parent] : view.model.parts[(axis as { number: number }).number - 1]?.place;
    if (!place) return;
    const middle = moved(place, line.point);
    const way = scaled(unit(turned(place, line.direction)), 0.16 * view.scene.radius);
    const [a, b, m] = [add(middle, way), add(middle, scaled(way, -1)), middle].map((point) => view.project(point));
    if (!a || !b || !m) return;
    const kind = `v-axis${joint ? "" : " v-meant"}`;
    const told = () => (joint ? `${joint.name} · ${joint.type}` : "The axis that was pointed at");
    const shapes = this.mark(`axis ${index} ${kind}`, kind, () => ({
      line: svg("line"), spot: svg("circle", { r: 5 }), head: svg("circle", { r: 3 }),
    }), m, told, joint?.name);
    change(shapes.line, { x1: a[0], y1: a[1], x2: b[0], y2: b[1] });
    change(shapes.spot, { cx: m[0], cy: m[1] });
    change(shapes.head, { cx: a[0], cy: a[1] });
  }

  /** Joint axes: filled marks for joints of the tree, hollow ones where a loop is cut. */
  private joints(): void {
    const { view } = this;
    for (const [index, joint] of view.model.joints.entries()) {
      const pose = view.pose[joint.parent];
      if (!pose) continue;
      const middle = moved(pose, joint.anchor);
      const axis = scaled(turned(pose, joint.axis), 0.06 * view.scene.radius);
      const [a, b, m] = [add(middle, axis), add(middle, scaled(axis, -1)), middle].map((point) => view.project(point));
      if (!a || !b || !m) continue;
      const slides = joint.type === "prismatic";
      const { line, spot } = this.mark(`joint ${index}`, `v-joint v-${joint.type}${joint.cut ? " v-cut" : ""}`, () => ({
        line: svg("line"), spot: slides ? svg("rect", { width: 9, height: 9 }) : svg("circle", { r: 5 }),
      }), m, () => `${index + 1} ${told(joint, view.pose)}`, joint.name);
      change(line, { x1: a[0], y1: a[1], x2: b[0], y2: b[1] });
      change(spot, slides ? { x: m[0] - 4.5, y: m[1] - 4.5 } : { cx: m[0], cy: m[1] });
    }
  }
}

function told(joint: Joint, pose: Pose): string {
  const value = coordinateOf(joint, pose);
  const now = value == null ? "" : `, ${joint.type === "prismatic" ? millimetres(value) : degrees(value)}`;
  return `${joint.name} · ${joint.type}${joint.cut ? ", cut" : ""}${now}`;
}
