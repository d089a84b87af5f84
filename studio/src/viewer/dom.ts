/** Elements and words. */

type Value = string | number | boolean | null | undefined | ((event: never) => unknown);
export type Attributes = Record<string, Value>;

/** An element: `element("button", {class: "x", onclick: …}, child, "text")`. */
export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K, attributes: Attributes = {}, ...children: (Node | string | null)[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") made.addEventListener(name.slice(2), value as EventListener);
    // What a role says is "true" or "false"; other attributes are there or not.
    else if (name.startsWith("aria-") && value != null) made.setAttribute(name, String(value));
    else if (value !== false && value != null) made.setAttribute(name, value === true ? "" : String(value));
  }
  made.append(...children.filter((child) => child != null));
  return made;
}

export function svg(tag: string, attributes: Record<string, string | number> = {}): SVGElement {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag) as SVGElement;
  change(made, attributes);
  return made;
}

export function change(made: Element, attributes: Record<string, string | number>): void {
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
}

export const button = (label: string, onclick: (event: MouseEvent) => unknown, attributes: Attributes = {}): HTMLButtonElement =>
  element("button", { type: "button", onclick, ...attributes }, label);

export const words = (name: string): string => name.replaceAll("_", " ");
export const sentence = (name: string): string => words(name).replace(/^./, (letter) => letter.toUpperCase());
export const signed = (value: number, digits: number): string =>
  (value < -0.5 * 10 ** -digits ? "−" : "") + Math.abs(value).toFixed(digits);
export const degrees = (radians: number): string => `${signed((radians * 180) / Math.PI, 1)}°`;
export const millimetres = (metres: number): string => `${signed(1e3 * metres, 0)} mm`;
/** Whether a person wants no movement. */
export const still = (): boolean => matchMedia("(prefers-reduced-motion: reduce)").matches;
