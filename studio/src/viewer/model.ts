/** The machine as the page gets it: what Python's `report.html.packing` and `report.html.viewer` write. */

import type { Matrix, Vector } from "./vectors.ts";

export interface Joint {
  name: string;
  type: string;
  parent: string;
  child: string;
  anchor: Vector;
  axis: Vector;
  cut: boolean;
  free: boolean;
  /** Coordinate at which its bodies stand straight. */
  straight: number;
}

/** Coordinates of dependent joints over those of their drivers, on an even grid. */
export interface PoseTable {
  drivers: string[];
  /** First node, last node and count of each driver's axis. */
  axes: [number, number, number][];
  dependent: string[];
  values: ArrayLike<number>;
}

export interface SliderEntry {
  name: string;
  title: string;
  unit: string;
  range: [number, number];
  sign: number;
  joints: [string, number][];
  extension: number | null;
  stroke: number | null;
}

export interface Sensor {
  name: string;
  type: string;
  body: string;
  at: Vector;
  views: [string, number[]][];
}

export interface Site {
  name: string;
  body: string;
  at: Vector;
  x: Vector;
  tilts: boolean;
}

/** A mesh quantised to its own box. */
export interface Shape {
  low: Vector;
  size: Vector;
  points: Uint16Array;
  indices: Uint16Array | Int32Array;
  normals: Int8Array | null;
}

export interface Body {
  name: string;
  color: number[];
}

export interface PartEntry {
  name: string;
  path: string;
  shape: number;
  place: number[];
  color: number[];
  body: number;
  role: string;
  confidence: number | null;
  reason: string;
  review: boolean;
}

/** A part on the screen: `number` counts from 1, `place` is where it is now, `rest` where it was drawn. */
export interface Part extends PartEntry {
  number: number;
  hidden: boolean;
  drawn: number[];
  rest: Matrix;
  corners: Vector[];
}

export interface Model<P = Part> {
  root: string;
  bodies: Body[];
  joints: Joint[];
  tables: PoseTable[];
  sliders: SliderEntry[];
  readouts: string[];
  sensors: Sensor[];
  sites: Site[];
  poses: { name: string; at: [string, number][] }[];
  parts: P[];
  shapes: Shape[];
  leftOut: number;
  version: number;
}

type Entry = [keyof typeof KINDS, number, number];
const KINDS = { f32: Float32Array, i32: Int32Array, u16: Uint16Array, i8: Int8Array };

/** A JSON header and the arrays that its entries point to: [length, header, binary]. */
export function unpacked(buffer: ArrayBuffer): Model<PartEntry> {
  const length = new DataView(buffer).getUint32(0, true);
  const model = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const array = ([kind, offset, count]: Entry) => new KINDS[kind](buffer, 4 + length + offset, count);
  for (const table of model.tables) table.values = array(table.values);
  for (const shape of model.shapes)
    for (const key of ["points", "indices", "normals"]) shape[key] = shape[key] && array(shape[key]);
  return model;
}

/** The same from its gzip. */
export async function unpack(bytes: Uint8Array<ArrayBuffer>): Promise<Model<PartEntry>> {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return unpacked(await new Response(stream).arrayBuffer());
}
