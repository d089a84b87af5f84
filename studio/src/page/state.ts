/** What the server says of a review: see `studio/server.py`, `questions.py` and `joints.py`. */

import type { Vector } from "../viewer/vectors.ts";

export interface Candidate {
  answer: string;
  words: string;
}

export interface Question {
  kind: "machine" | "parts" | "role" | "value" | "joint";
  key: string;
  title: string;
  reason: string;
  parts: string[];
  candidates: Candidate[];
  known: string[];
  page: number | null;
  file: string;
  yes: string;
  absent: string;
}

/** What a person says of a joint. */
export interface JointEntry {
  anchor?: Vector;
  axis?: Vector;
  through?: unknown[];
  joint_type?: string;
  Body?: string[];
  Limit?: (number | null)[];
}

export interface JointState {
  name: string;
  title: string;
  type: string;
  bodies: [string, string];
  known: "found" | "guess" | "given" | "none";
  reason: string;
  entry: JointEntry;
  axis: JointEntry;
  others: [string, string][];
  began: number;
  limits: [number | null, number | null];
}

export interface SheetValue {
  name: string;
  value: number | null;
  unit: string;
  status: string;
  source: string;
  page: number | null;
  file: string;
}

export interface State {
  version: number;
  /** How much was said, and how much of that the machine follows from. */
  said: number;
  solved: number;
  machine: string;
  file: string;
  verdict: string;
  causes: { words: string }[];
  tally: string;
  questions: Question[];
  joints: JointState[];
  history: { words: string; by: string; date: string; holds: boolean }[];
  remarks: string[];
  machineSaid: Candidate[];
  roles: { name: string; words: string; body: string }[];
  values: SheetValue[];
  build: { state: "none" | "running" | "ready" | "short" | "failed"; lines: string[]; command: string };
}

/** An axis that was found where someone pointed. */
export interface FoundAxis {
  part: string;
  point: Vector;
  direction: Vector;
  entry: JointEntry;
  words: string;
}

export interface Pattern {
  pattern: string;
  parts: string[];
  ruled: boolean;
  role: string | null;
}
