import { describe, expect, it } from "vitest";
import { decodeMesh, joined, met, TEXELS, WIDTH, writePart, writePlace } from "../src/viewer/meshes.ts";
import { type Part, type Shape, unpacked } from "../src/viewer/model.ts";
import { IDENTITY } from "../src/viewer/vectors.ts";

/** A triangle: (0, 0, 0), (2, 0, 0), (0, 4, 0) in a box of 2 × 4 × 1; the planes are differences. */
const triangle = (indices: Shape["indices"] = Uint16Array.from([0, 1, 1])): Shape => ({
  low: [0, 0, 0], size: [2, 4, 1],
  points: Uint16Array.from([0, 65535, 1, 0, 0, 65535, 0, 0, 0]),
  indices,
  normals: Int8Array.from([1, 2, 3, -4, -5, -6]),
});
const part = (more: Partial<Part> = {}): Part => ({
  name: "p", path: "M/p", shape: 0, place: [...IDENTITY], color: [255, 0, 0], body: 0, role: "", confidence: null, reason: "", review: false,
  number: 258, hidden: false, drawn: [255, 0, 0], rest: IDENTITY, corners: [], ...more,
});

describe("a packed mesh", () => {
  it("is unpacked plane by plane, around the end of 16 bits", () => {
    const mesh = decodeMesh(triangle());
    expect([...mesh.points]).toEqual([0, 0, 0, 65535, 0, 0, 0, 65535, 0]);
    expect([...mesh.indices]).toEqual([0, 1, 2]);
    expect([...mesh.normals]).toEqual([1, -4, 2, -5, 3, -6]);
  });

  it("has wide indices where it is large", () => {
    const mesh = decodeMesh({ ...triangle(Int32Array.from([70000, -69999, 1])), normals: null });
    expect([...mesh.indices]).toEqual([70000, 1, 2]);
    expect([...mesh.normals]).toEqual([0, 0, 0, 0, 0, 0]);
  });

  it("is joined with others to one, each point knowing its part", () => {
    const all = joined([triangle(), triangle()], [{ shape: 1 }, { shape: 0 }, { shape: 1 }]);
    expect([...all.indices]).toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8]);
    expect([...all.owner].filter((_, k) => k % 2 === 0)).toEqual([0, 0, 0, 1, 1, 1, 2, 2, 2]);
    expect([...all.points.slice(4, 8)]).toEqual([65535, 0, 0, 0]);
  });
});

describe("the table of parts", () => {
  it("says where a part is after its shape's box, and how its normals turn", () => {
    const table = new Float32Array(4 * TEXELS);
    // x → y, y → -x, then moved; the box begins at 1.
    writePlace(table, 0, [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1], { low: [1, 0, 0], size: [2, 4, 1] });
    expect([...table.slice(0, 12)]).toEqual([0, -4, 0, 5, 2, 0, 0, 7, 0, 0, 1, 7]);
    expect([...table.slice(12, 24)].map((value) => value + 0)).toEqual([0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0]);
  });

  it("has the number in two bytes, and whether it is seen and chosen", () => {
    const table = new Float32Array(4 * WIDTH);
    writePart(table, 3, part({ hidden: true }), triangle(), true);
    const mine = [...table.slice(4 * (3 * TEXELS + 6), 4 * (3 * TEXELS + 8))];
    expect(mine.slice(0, 4)).toEqual([1, 0, 0, 1]);
    expect(mine.slice(4, 6).map((value) => Math.round(255 * value))).toEqual([2, 1]);
    expect(mine.slice(6)).toEqual([0, 1]);
  });
});

describe("a ray", () => {
  const place = [...IDENTITY.slice(0, 12), 10, 0, 0, 1];

  it("meets a part in the part's own frame", () => {
    const point = met({ place }, triangle(), [10.5, 0.5, 3], [0, 0, -1]);
    expect(point!.map((value) => value.toFixed(6))).toEqual(["0.500000", "0.500000", "0.000000"]);
  });

  it("misses what it passes by, and what is behind", () => {
    expect(met({ place }, triangle(), [0.5, 0.5, 3], [0, 0, -1])).toBeNull();
    expect(met({ place }, triangle(), [10.5, 0.5, 3], [0, 0, 1])).toBeNull();
  });
});

describe("a packed machine", () => {
  it("is a header and arrays that it points to", () => {
    const head = { tables: [{ values: ["f32", 0, 2] }], shapes: [{ points: ["u16", 8, 3], indices: ["u16", 16, 3], normals: null }] };
    let text = JSON.stringify(head);
    text += " ".repeat((8 - ((4 + text.length) % 8)) % 8);
    const bytes = new Uint8Array(4 + text.length + 24);
    const view = new DataView(bytes.buffer);
    view.setUint32(0, text.length, true);
    bytes.set(new TextEncoder().encode(text), 4);
    [1.5, -2].forEach((value, k) => view.setFloat32(4 + text.length + 4 * k, value, true));
    [7, 8, 9].forEach((value, k) => view.setUint16(4 + text.length + 8 + 2 * k, value, true));
    [0, 1, 1].forEach((value, k) => view.setUint16(4 + text.length + 16 + 2 * k, value, true));
    const model = unpacked(bytes.buffer);
    expect([...(model.tables[0].values as Float32Array)]).toEqual([1.5, -2]);
    expect([...model.shapes[0].points]).toEqual([7, 8, 9]);
    expect(model.shapes[0].normals).toBeNull();
  });
});
