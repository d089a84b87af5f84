/** Meshes for the graphics card: unpacked, joined to one, and the table that says where each part of it is. */

import type { Part, PartEntry, Shape } from "./model.ts";
import { add, cross, dot, inverse, type Matrix, moved, scaled, turned, type Vector } from "./vectors.ts";

export interface Mesh {
  /** Three to a point, 0 … 65535 across the shape's box. */
  points: Uint16Array;
  indices: Uint16Array | Uint32Array;
  /** Two to a point: the octahedron unfolded. */
  normals: Int8Array;
}

/** Unpacks a quantised mesh: positions are planes of differences, indices differences. */
export function decodeMesh(shape: Shape): Mesh {
  const count = shape.points.length / 3;
  const points = new Uint16Array(3 * count);
  for (let k = 0; k < 3; k++)
    for (let i = 0, value = 0; i < count; i++) {
      value = (value + shape.points[k * count + i]) & 65535;
      points[3 * i + k] = value;
    }
  const wide = shape.indices instanceof Int32Array;
  const indices = new (wide ? Uint32Array : Uint16Array)(shape.indices.length);
  for (let i = 0, value = 0; i < indices.length; i++) indices[i] = value = value + shape.indices[i];
  const normals = new Int8Array(2 * count);
  if (shape.normals)
    for (let i = 0; i < count; i++) {
      normals[2 * i] = shape.normals[i];
      normals[2 * i + 1] = shape.normals[count + i];
    }
  return { points, indices, normals };
}

/** All parts as one mesh, in rows of four bytes, as graphics cards like them: four to a point and a normal, two to a
 * part's place in the list, which every point of it knows. */
export interface Joined {
  points: Uint16Array;
  normals: Int8Array;
  owner: Uint16Array;
  indices: Uint32Array;
}

export function joined(shapes: readonly Shape[], parts: readonly Pick<PartEntry, "shape">[]): Joined {
  const meshes = new Map([...new Set(parts.map((part) => part.shape))].map((n) => [n, decodeMesh(shapes[n])]));
  const each = parts.map((part) => meshes.get(part.shape)!);
  const count = each.reduce((total, mesh) => total + mesh.points.length / 3, 0);
  const points = new Uint16Array(4 * count);
  const normals = new Int8Array(4 * count);
  const owner = new Uint16Array(2 * count);
  const indices = new Uint32Array(each.reduce((total, mesh) => total + mesh.indices.length, 0));
  let [vertex, corner] = [0, 0];
  each.forEach((mesh, number) => {
    for (let i = 0; i < mesh.indices.length; i++) indices[corner++] = vertex + mesh.indices[i];
    for (let i = 0; i < mesh.points.length / 3; i++, vertex++) {
      for (let k = 0; k < 3; k++) points[4 * vertex + k] = mesh.points[3 * i + k];
      for (let k = 0; k < 2; k++) normals[4 * vertex + k] = mesh.normals[2 * i + k];
      owner[2 * vertex] = number;
    }
  });
  return { points, normals, owner, indices };
}

/** Of a part in the table: three rows of where it is, three of how its normals turn, its colour and whether it is round,
 * its number and whether it is seen and chosen. */
export const TEXELS = 8;
/** Texels in a row of the table. */
export const WIDTH = 1024;

/** Writes where a part is, and how its normals turn (up to length: by the matrix's cofactors, so that mirrors and scales
 * are right), into a table of numbers: the part's place after its shape's box. */
export function writePlace(table: Float32Array, k: number, place: Matrix, { low, size }: Pick<Shape, "low" | "size">): void {
  for (let row = 0; row < 3; row++) {
    let middle = place[12 + row];
    for (let column = 0; column < 3; column++) {
      const value = place[4 * column + row];
      middle += value * low[column];
      table[k + 4 * row + column] = value * size[column];
      const [r1, r2, c1, c2] = [(row + 1) % 3, (row + 2) % 3, (column + 1) % 3, (column + 2) % 3];
      table[k + 12 + 4 * row + column] =
        place[4 * c1 + r1] * place[4 * c2 + r2] - place[4 * c1 + r2] * place[4 * c2 + r1];
    }
    table[k + 4 * row + 3] = middle;
  }
}

/** Writes all that is said of a part. */
export function writePart(table: Float32Array, index: number, part: Part, shape: Shape, chosen: boolean): void {
  const k = 4 * TEXELS * index;
  writePlace(table, k, part.place, shape);
  for (let c = 0; c < 3; c++) table[k + 24 + c] = (part.color[c] / 255) ** 2.2;
  table[k + 27] = shape.normals ? 1 : 0;
  table[k + 28] = (part.number & 255) / 255;
  table[k + 29] = (part.number >> 8) / 255;
  table[k + 30] = part.hidden ? 0 : 1;
  table[k + 31] = chosen ? 1 : 0;
}

/** Where a ray of the machine frame meets a part first, in the part's own frame; null: nowhere. */
export function met(part: Pick<Part, "place">, shape: Shape, eye: Vector, way: Vector): number[] | null {
  const local = inverse(part.place);
  const from = moved(local, eye);
  const along = turned(local, way);
  const { points, indices } = decodeMesh(shape);
  const corner = (i: number) => [0, 1, 2].map((k) => shape.low[k] + (points[3 * i + k] / 65535) * shape.size[k]);
  let nearest = Infinity;
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [corner(indices[i]), corner(indices[i + 1]), corner(indices[i + 2])];
    const [ab, ac, offset] = [b, c, from].map((p) => add(p, scaled(a, -1)));
    const side = cross(along, ac);
    const volume = dot(ab, side);
    if (!volume) continue;
    const u = dot(offset, side) / volume;
    const turn = cross(offset, ab);
    const v = dot(along, turn) / volume;
    const t = dot(ac, turn) / volume;
    if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < nearest) nearest = t;
  }
  return nearest < Infinity ? add(from, scaled(along, nearest)) : null;
}
