/** What can be found by its words: roles, parts and joints, patterns, what can be said of the whole machine. */

import { words } from "../viewer/dom.ts";
import type { Finding, Row } from "./finder.ts";
import { counted } from "./questions.ts";
import { asked } from "./server.ts";
import type { Pattern } from "./state.ts";
import type { Studio } from "./studio.ts";

export const roles = (studio: Studio): Finding => ({
  label: "Role of these parts",
  rows: studio.state.roles.map((role) => ({ words: role.words, name: role.name, take: () => studio.assign(role.name) })),
  none: "No role of that name. A part without one of its own, such as a cab, has its body's.",
});

export const ofWhole = (studio: Studio): Finding => ({
  label: "Of the whole machine: its front, a variant, what is not drawn",
  rows: studio.state.machineSaid.map((one) => ({ words: one.words, name: one.answer, take: () => studio.whole(one.answer, null) })),
  none: "Nothing of that name can be said of the whole machine.",
});

/** Parts by their names and those of their assemblies, and joints. */
export function named(studio: Studio): Finding {
  const parts = studio.viewer.model.parts.filter((part) => !part.hidden).map((part): Row => ({
    words: part.path, name: part.path.split("/").at(-1)!, number: part.number, take: () => studio.select([part.number]),
  }));
  const joints = studio.state.joints.map((joint): Row => ({
    words: `${joint.title} · joint`, name: joint.name, take: () => studio.choosesJoint(joint.name),
  }));
  return { label: "Name of a part, an assembly or a joint", rows: [...parts, ...joints], none: "No part or joint of that name." };
}

/** Patterns over the CAD tree that fit some parts, or one that is written. */
export function patterns(studio: Studio, parts: string[]): Finding {
  const rows = async (body: unknown): Promise<Row[]> => {
    const found = (await asked<{ patterns: Pattern[] }>("patterns", body)).patterns;
    return found.filter((one) => one.parts.length || one.ruled).map((one) => ({ words: patternWords(one), name: one.pattern, take: () => studio.rule(one) }));
  };
  return {
    label: "A pattern, such as HITCH/* or *BOLT*", rows: rows({ parts }), typed: async (pattern) => (await rows({ pattern }))[0],
    none: "No part and no assembly is named so. As much of a path as you like; * stands for any text.",
  };
}

export function patternWords({ pattern, parts, ruled, role }: Pattern): string {
  return `${pattern} · ${counted(parts.length)}${ruled ? ` · ${words(role ?? "") || "no part of the machine"}` : ""}`;
}
