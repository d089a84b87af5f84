import { describe, expect, it } from "vitest";
import type { Joint } from "../src/viewer/model.ts";
import { coordinateOf, interpolated, poseOf, treeOrder } from "../src/viewer/pose.ts";
import { IDENTITY, inverse, moved, multiply, rotation } from "../src/viewer/vectors.ts";

const joint = (name: string, type: string, parent: string, child: string, more: Partial<Joint> = {}): Joint => ({
  name, type, parent, child, anchor: [0, 0, 0], axis: [0, 1, 0], cut: false, free: false, straight: 0, ...more,
});
const close = (found: readonly number[], wanted: readonly number[]) => found.forEach((value, k) => expect(value).toBeCloseTo(wanted[k], 9));

describe("placements", () => {
  it("are undone by their inverse, mirrored and scaled ones too", () => {
    const m = multiply(rotation([Math.cos(0.4), 0, 0, Math.sin(0.4)], [1, 2, 3]), [-2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0.5, 0, 4, 5, 6, 1]);
    close(multiply(m, inverse(m)), IDENTITY);
  });

  it("turn about a point, which stays", () => {
    const m = rotation([Math.cos(0.3), Math.sin(0.3), 0, 0], [1, 2, 3]);
    close(moved(m, [1, 2, 3]), [1, 2, 3]);
    close(moved(m, [1, 3, 3]), [1, 2 + Math.cos(0.6), 3 + Math.sin(0.6)]);
  });
});

describe("a pose", () => {
  it("goes from parents to children, in whatever order joints are listed", () => {
    const model = { root: "a", tables: [], joints: [joint("low", "revolute", "b", "c"), joint("cut", "spherical", "c", "a", { cut: true }), joint("top", "revolute", "a", "b")] };
    expect(treeOrder(model).map((each) => each.name)).toEqual(["top", "low"]);
  });

  it("turns, slides and adds up", () => {
    const model = {
      root: "frame", tables: [],
      joints: [joint("boom", "revolute", "frame", "arm", { anchor: [1, 0, 0] }), joint("slide", "prismatic", "arm", "rod", { axis: [1, 0, 0] })],
    };
    const pose = poseOf(model, { boom: -Math.PI / 2, slide: 0.5 });
    close(moved(pose.arm, [2, 0, 0]), [1, 0, 1]);
    close(moved(pose.rod, [2, 0, 0]), [1, 0, 1.5]);
    expect(coordinateOf(model.joints[0], pose)).toBeCloseTo(-Math.PI / 2, 9);
    expect(coordinateOf(model.joints[1], pose)).toBeCloseTo(0.5, 9);
    expect(coordinateOf(joint("ball", "spherical", "frame", "arm"), pose)).toBeNull();
  });

  it("takes dependent joints from the table of their driver, quaternions too", () => {
    const model = {
      root: "a", joints: [joint("in", "prismatic", "a", "b"), joint("out", "revolute", "a", "c"), joint("ball", "spherical", "a", "d")],
      tables: [{ drivers: ["in"], axes: [[0, 3, 4]] as [number, number, number][], dependent: ["out", "ball"],
        values: [0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 2, 1, 0, 0, 0, 3, 1, 0, 0, 0].map(Number) }],
    };
    const pose = poseOf(model, { in: 1.5 });
    expect(coordinateOf(model.joints[1], pose)).toBeCloseTo(1.5, 9);
    close(pose.d, IDENTITY);
  });
});

describe("a table", () => {
  const axes: [number, number, number][] = [[-1, 2, 7], [0, 1, 5]];
  const polynomial = (x: number, y: number) => x ** 3 - 2 * x * y + y ** 2;
  const values = Array.from({ length: 7 }, (_, i) => Array.from({ length: 5 }, (_, j) => polynomial(-1 + i / 2, j / 4))).flat();
  const table = { drivers: ["x", "y"], axes, dependent: ["z"], values };

  it("is exact for cubics, between nodes too", () => {
    for (const [x, y] of [[-1, 0], [0.3, 0.7], [1.99, 0.01], [2, 1]]) expect(interpolated(table, { x, y })[0]).toBeCloseTo(polynomial(x, y), 9);
  });

  it("stays at its ends beyond them, and takes 0 for what is not given", () => {
    expect(interpolated(table, { x: 9, y: -9 })[0]).toBeCloseTo(polynomial(2, 0), 9);
    expect(interpolated(table, {})[0]).toBeCloseTo(polynomial(0, 0), 9);
  });
});
