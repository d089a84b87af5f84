/** What moves the machine: sliders of actuators, poses, and how it then stands. */

import { button, degrees, element, millimetres, sentence, signed, words } from "./dom.ts";
import type { Model, SliderEntry } from "./model.ts";
import { coordinateOf, type Given, type Pose } from "./pose.ts";
import { moved, turned } from "./vectors.ts";

const STEPS = 400; // of a slider

export interface Slider extends SliderEntry {
  row: HTMLElement;
  show(value: number): void;
}

/** What a slider says of a coordinate. */
export function reading(slider: Pick<SliderEntry, "unit" | "sign" | "extension" | "stroke">, value: number): string {
  if (slider.unit === "rad") return degrees(value * slider.sign);
  if (slider.extension == null) return millimetres(value);
  return `${signed(1e3 * (value + slider.extension), 0)} of ${(1e3 * (slider.stroke ?? 0)).toFixed(0)} mm`;
}

export function sliderOf(slider: SliderEntry, set: (name: string, value: number) => void): Slider {
  const [lower, upper] = slider.range;
  const [from, to] = slider.sign > 0 ? [lower, upper] : [upper, lower];
  const id = `v-${slider.name}`;
  const output = element("output", { for: id });
  const input: HTMLInputElement = element("input", {
    type: "range", id, min: 0, max: STEPS, step: 1,
    oninput: () => set(slider.name, from + ((to - from) * input.valueAsNumber) / STEPS),
  });
  const show = (value: number) => {
    input.value = String(Math.round((STEPS * (value - from)) / (to - from)));
    output.textContent = reading(slider, value);
    input.setAttribute("aria-valuetext", output.textContent);
    input.style.setProperty("--share", `${(100 * input.valueAsNumber) / STEPS}%`);
  };
  const label = element("label", { for: id }, slider.title);
  return { ...slider, show, row: element("div", { class: "v-slider" }, label, output, input) };
}

/** What the tab shows: sliders, buttons of poses, and a place for how the machine stands. */
export function moveSections({ poses, readouts, sites }: Model, sliders: readonly Slider[], angles: HTMLElement, animate: (given: Given) => void): HTMLElement[] {
  const section = (title: string, ...content: HTMLElement[]) => element("section", {}, element("h3", {}, title), ...content);
  const buttons = [{ name: "As drawn", at: [] }, ...poses].map((pose) => button(pose.name, () => animate(Object.fromEntries(pose.at))));
  const made = sliders.length
    ? [section("Actuators", ...sliders.map((slider) => slider.row)), section("Poses", element("div", { class: "v-poses" }, ...buttons))]
    : [];
  const note = element("p", { class: "dim" }, "Heights above the ground; angles of pivots from the drawn pose.");
  return readouts.length + sites.length ? [...made, section("How it stands", angles, note)] : made;
}

/** How the machine stands in a pose: names and what is read there. */
export function standing({ sites, readouts, joints }: Pick<Model, "sites" | "readouts" | "joints">, pose: Pose): [string, string][] {
  const heights = sites.map((site): [string, string] => {
    const at = moved(pose[site.body], site.at);
    const x = turned(pose[site.body], site.x);
    const pitch = Math.atan2(x[2], Math.sign(x[0] || 1) * Math.hypot(x[0], x[1]));
    return [sentence(site.name), `${at[2].toFixed(2)} m high${site.tilts ? `, ${degrees(pitch)}` : ""}`];
  });
  const angles = readouts.flatMap((name): [string, string][] => {
    const joint = joints.find((each) => each.name === name);
    const angle = joint && coordinateOf(joint, pose);
    return joint && angle != null ? [[`${sentence(joint.child)} to ${words(joint.parent)}`, degrees(angle - joint.straight)]] : [];
  });
  return [...heights, ...angles];
}
