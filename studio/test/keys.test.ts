import { expect, it } from "vitest";
import { KEYS, meaning } from "../src/page/keys.ts";

const press = (key: string, shiftKey = false) => meaning({ key, shiftKey });

it("letters mean the same with Shift held or Caps Lock on, but for those with two meanings", () => {
  expect(press("B", true)).toEqual(press("b"));
  expect(press("u")).toEqual({ act: "undo" });
  expect(press("U", true)).toEqual({ act: "redo" });
  expect(press("N", true)).toEqual({ act: "step", way: -1 });
  expect(press("n")).toEqual({ act: "step", way: 1 });
});

it("digits are answers, from 1", () => {
  expect(press("1")).toEqual({ act: "answer", index: 0 });
  expect(press("9")).toEqual({ act: "answer", index: 8 });
  expect(press("0")).toBeNull();
});

it("every key that the page lists does something, and what it does not list does nothing", () => {
  const named: Record<string, string> = { "⏎": "Enter", Esc: "Escape" };
  const listed = KEYS.flatMap(([keys]) => (keys === "1 – 9" ? ["1", "9"] : keys.split(", ").map((key) => key.replace("⇧", ""))));
  for (const key of listed) expect(press(named[key] ?? key), key).not.toBeNull();
  for (const key of ["q", "z", "F5", "Tab", " ", "constructor", "toString"]) expect(press(key), key).toBeNull();
});
