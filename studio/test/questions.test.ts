import { describe, expect, it } from "vitest";
import { foundRows } from "../src/page/finder.ts";
import { limitsWith, turnedRound } from "../src/page/joints.ts";
import { amount, around, opened, stepped, unsolved } from "../src/page/questions.ts";
import type { Question } from "../src/page/state.ts";
import { wayToMove } from "../src/page/wiggle.ts";
import { reading } from "../src/viewer/move.ts";

const question = (key: string, more: Partial<Question> = {}): Question => ({
  kind: "parts", key, title: key, reason: "", parts: [], candidates: [], known: [], page: null, file: "", yes: "", absent: "", ...more,
});

describe("the question that is asked", () => {
  const all = ["a", "b", "c"].map((key) => question(key));

  it("stays before the reader whatever comes or goes before it", () => {
    expect(opened(all, new Map(), "c", 0)).toMatchObject({ at: 2 });
    expect(opened(all, new Map([["a", 5]]), "c", 2)).toMatchObject({ at: 1, questions: [{ key: "b" }, { key: "c" }] });
  });

  it("is followed by the one that takes its place, at the end by the last", () => {
    expect(opened(all, new Map([["b", Infinity]]), "b", 1)).toMatchObject({ at: 1 });
    expect(opened(all, new Map([["c", Infinity]]), "c", 2)).toMatchObject({ at: 1 });
    expect(opened([], new Map(), undefined, 4)).toEqual({ at: 0, questions: [] });
  });

  it("is not asked again until what was answered is solved", () => {
    expect([...unsolved(new Map([["a", 3], ["b", 4], ["c", Infinity]]), 3).keys()]).toEqual(["b", "c"]);
  });

  it("says what it is about", () => {
    expect(amount(question("x", { parts: ["p"] }))).toBe("1 part");
    expect(amount(question("x", { parts: ["p", "q"] }))).toBe("2 parts");
    expect(amount(question("x", { kind: "role" }))).toBe("missing");
  });
});

describe("the assembly around parts", () => {
  const all = ["M/A/x", "M/A/y", "M/B/C/z", "M/B/w", "M/B2/v"];

  it("is the smallest that holds more", () => {
    expect(around(["M/A/x"], all)).toEqual(["M/A/x", "M/A/y"]);
    expect(around(["M/B/C/z"], all)).toEqual(["M/B/C/z", "M/B/w"]);
    expect(around(["M/A/x", "M/A/y"], all)).toEqual(all);
  });

  it("is none around all of them, or around a part of no assembly", () => {
    expect(around(all, all)).toBeNull();
    expect(around(["loose"], ["loose", "other"])).toBeNull();
  });
});

it("parts are stepped through, around the end", () => {
  expect(stepped([2, 5, 9], new Set(), 1)).toBe(2);
  expect(stepped([2, 5, 9], new Set(), -1)).toBe(9);
  expect(stepped([2, 5, 9], new Set([5]), 1)).toBe(9);
  expect(stepped([2, 5, 9], new Set([9]), 1)).toBe(2);
  expect(stepped([2, 5, 9], new Set([2, 5]), -1)).toBe(9);
});

it("who types a whole name means that one", () => {
  const rows = ["Boom cylinder", "Arm, boom", "Boom"].map((words) => ({ words, name: words.toLowerCase(), take: () => null }));
  expect(foundRows(rows, " boom ").map((row) => row.words)).toEqual(["Boom", "Boom cylinder", "Arm, boom"]);
  expect(foundRows(rows, "cyl BOOM").map((row) => row.words)).toEqual(["Boom cylinder"]);
  expect(foundRows(rows, "bucket")).toEqual([]);
});

describe("a joint", () => {
  it("is turned round as it was given, else as it was found", () => {
    expect(turnedRound({ entry: {}, axis: { anchor: [1, 2, 3], axis: [0, 1, 0] } })).toEqual({ anchor: [1, 2, 3], axis: [-0, -1, -0] });
    expect(turnedRound({ entry: { through: ["a", "b", "c"] }, axis: { axis: [1, 0, 0] } })).toEqual({ through: ["b", "a", "c"] });
    expect(turnedRound({ entry: { Limit: [0, 1] }, axis: {} })).toBeNull();
  });

  it("has its stop where it is, in degrees or metres, beside the one that is known", () => {
    const joint = { type: "revolute", began: Math.PI / 6, entry: {}, limits: [-Math.PI / 6, null] as [number, null] };
    expect(limitsWith(joint, 1, Math.PI / 3)).toEqual([0, 90]);
    expect(limitsWith({ ...joint, type: "prismatic", began: 0.2, entry: { Limit: [0.1, 0.9] } }, 0, 0.1)).toEqual([0.3, 0.9].map((value) => expect.closeTo(value, 5)));
  });
});

it("what moves the asked body and little else is moved", () => {
  const joint = (name: string, parent: string, child: string) => ({
    name, parent, child, type: "revolute", anchor: [0, 0, 0], axis: [0, 1, 0], cut: false, free: false, straight: 0,
  });
  const slider = (name: string) => ({
    name, title: name, unit: "rad", range: [-0.2, 1] as [number, number], sign: 1, joints: [[name, 1]] as [string, number][], extension: null, stroke: null,
  });
  const model = { root: "frame", tables: [], joints: [joint("boom", "frame", "boom"), joint("bucket", "boom", "bucket")], sliders: [slider("boom"), slider("bucket")] };
  expect(wayToMove(model, new Set(["bucket"]))).toEqual({ bucket: 0.35 });
  expect(wayToMove(model, new Set(["boom"]))).toEqual({ boom: 0.35 });
  expect(wayToMove(model, new Set(["frame"]))).toBeNull();
});

it("a slider reads as a person says it", () => {
  expect(reading({ unit: "rad", sign: -1, extension: null, stroke: null }, Math.PI / 6)).toBe("−30.0°");
  expect(reading({ unit: "m", sign: 1, extension: null, stroke: null }, 0.1234)).toBe("123 mm");
  expect(reading({ unit: "m", sign: 1, extension: 0.2, stroke: 0.5 }, 0.1)).toBe("300 of 500 mm");
});
