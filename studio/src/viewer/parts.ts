/** The list of parts: those that a search leaves, body by body or as the CAD model has them. */

import { button, element, words } from "./dom.ts";
import type { Model, Part } from "./model.ts";

export interface Listing {
  readonly model: Model;
  readonly lit: ReadonlySet<number> | null;
  readonly chosen: number;
  show(test: (part: Part) => boolean): void;
  choose(number: number, event: MouseEvent | null): unknown;
}

/** Parts that have every word of a search in their path, role or body. */
export function foundParts({ parts, bodies }: Pick<Model, "parts" | "bodies">, search: string): Part[] {
  const wanted = search.trim().toLowerCase().split(/\s+/).filter(Boolean);
  return parts.filter((part) => {
    const text = `${part.path} ${part.role} ${bodies[part.body].name}`.toLowerCase();
    return wanted.every((word) => text.includes(word) || words(text).includes(word));
  });
}

export class PartList {
  readonly page: HTMLElement;
  private readonly search: HTMLInputElement;
  private readonly list = element("div", { class: "v-list" });
  private readonly count = element("span", { class: "dim" });
  private byTree = false;

  constructor(private readonly view: Listing) {
    this.search = element("input", {
      type: "search", placeholder: "Search parts, roles, bodies", "aria-label": "Search parts", oninput: () => this.fill(),
    });
    const all = button("Show all", () => view.show(() => true));
    const tree = button("CAD tree", () => {
      this.byTree = !this.byTree;
      tree.setAttribute("aria-pressed", String(this.byTree));
      this.fill();
    }, { "aria-pressed": "false" });
    this.fill();
    const head = element("div", { class: "v-head" }, this.count, element("span", {}, tree, " ", all));
    this.page = element("section", { class: "v-parts" }, this.search, head, this.list);
  }

  fill(): void {
    const { model } = this.view;
    const found = foundParts(model, this.search.value);
    const hidden = model.parts.filter((part) => part.hidden).length;
    const left = model.leftOut ? `, ${model.leftOut} small ones not drawn` : "";
    this.count.textContent = `${found.length} parts${hidden ? `, ${hidden} hidden` : ""}${left}`;
    const open = new Set([...this.list.querySelectorAll<HTMLElement>("details[open]")].map((each) => each.dataset.key));
    const wide = this.search.value.trim() !== "" && found.length <= 60;
    const group = (key: string, label: string, swatch: HTMLElement | null, parts: Part[], fill: () => HTMLElement[]) => {
      const made = element("details", { "data-key": key });
      const filled = () => made.childElementCount < 2 && made.append(...fill());
      const name = element("span", {}, label, element("span", { class: "dim" }, ` ${parts.length}`));
      made.append(element("summary", {}, swatch, name, this.eye(label, parts)));
      made.addEventListener("toggle", () => made.open && filled());
      if ((made.open = open.has(key) || wide)) filled();
      return made;
    };
    const under = (parts: Part[], depth: number, above: string): HTMLElement[] => {
      const assemblies = new Map<string, Part[]>();
      const own: Part[] = [];
      for (const part of parts) {
        const steps = part.path.split("/");
        if (steps.length - 1 <= depth) own.push(part);
        else assemblies.set(steps[depth], [...(assemblies.get(steps[depth]) ?? []), part]);
      }
      const groups = [...assemblies].map(([name, inside]) =>
        group(`${above}/${name}`, name, null, inside, () => under(inside, depth + 1, `${above}/${name}`)),
      );
      return [...groups, ...own.map((part) => this.row(part))];
    };
    const bodies = () =>
      model.bodies.flatMap((body, index) => {
        const parts = found.filter((part) => part.body === index);
        const swatch = element("i", { style: `background:rgb(${body.color})` });
        const rows = () => parts.map((part) => this.row(part));
        return parts.length ? [group(body.name, words(body.name) || "no part of the machine", swatch, parts, rows)] : [];
      });
    this.list.replaceChildren(...(this.byTree ? under(found, 0, "") : bodies()));
  }

  private row(part: Part): HTMLElement {
    const { view } = this;
    const name = button(part.name, (event) => view.choose(part.number, event), {
      class: "v-name", title: part.path, "aria-current": view.lit ? view.lit.has(part.number) : part.number === view.chosen,
    });
    return element("div", { class: "v-row" }, name, this.eye(part.name, [part]));
  }

  private eye(name: string, parts: Part[]): HTMLElement {
    const hidden = parts.every((part) => part.hidden);
    return button(hidden ? "○" : "●", (event) => {
      event.preventDefault();
      const set = new Set(parts);
      this.view.show((part) => (set.has(part) ? hidden : !part.hidden));
    }, { class: "v-eye", "aria-pressed": !hidden, "aria-label": `Show ${name}`, title: hidden ? "Show" : "Hide" });
  }
}
