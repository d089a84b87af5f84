/** What a question is about moves by itself, a little and back. */

import { still } from "../viewer/dom.ts";
import type { Model } from "../viewer/model.ts";
import { type Given, type Pose, poseOf } from "../viewer/pose.ts";
import { IDENTITY } from "../viewer/vectors.ts";
import type { Viewer } from "../viewer/viewer.ts";

const LENGTH = 1600; // milliseconds
const turnedAway = (pose: Pose, body: string): boolean => pose[body]?.some((value, k) => Math.abs(value - IDENTITY[k]) > 1e-4) ?? false;

/** Of the ways to move a machine, that which moves some of these bodies and as little else as can be; null: none. */
export function wayToMove(model: Pick<Model, "root" | "joints" | "tables" | "sliders">, bodies: ReadonlySet<string>): Given | null {
  const ways = model.sliders.map((slider) => {
    const [low, high] = slider.range;
    const far = (high > -low ? high : low) * 0.35;
    const given = Object.fromEntries(slider.joints.map(([joint, sign]) => [joint, sign * far]));
    const pose = poseOf(model, given);
    const away = Object.keys(pose).filter((body) => turnedAway(pose, body));
    return { given, away };
  });
  const moving = ways.filter(({ away }) => away.some((body) => bodies.has(body))).sort((a, b) => a.away.length - b.away.length);
  return moving.length ? moving[0].given : null;
}

/** Gives what moves the bodies of some parts (their numbers); who wants no movement sees none. */
export function wiggler(viewer: Viewer): (numbers: ReadonlySet<number>) => void {
  let wiggling: ((now: number) => void) | null = null;
  return (numbers) => {
    if (still()) return;
    const { model } = viewer;
    const given = wayToMove(model, new Set([...numbers].map((number) => model.bodies[model.parts[number - 1].body].name)));
    if (!given) return;
    const begin = performance.now();
    const step = (now: number) => {
      if (wiggling !== step) return;
      const t = Math.min((now - begin) / LENGTH, 1);
      const share = Math.sin(Math.PI * t) ** 2;
      viewer.move(Object.fromEntries(Object.entries(given).map(([joint, value]) => [joint, share * value])));
      if (t < 1) requestAnimationFrame(step);
      else wiggling = null;
    };
    wiggling = step;
    requestAnimationFrame(step);
  };
}
