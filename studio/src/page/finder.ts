/** One of some rows is found by its words. */

import { button, element } from "../viewer/dom.ts";

/** So many rows of what was found are shown at a time. */
const LISTED = 100;

export interface Row {
  words: string;
  name: string;
  /** Of a part. */
  number?: number;
  take: () => unknown;
}

export interface Finding {
  label: string;
  /** What is said where nothing is found. */
  none: string;
  rows: Row[] | Promise<Row[]>;
  /** Makes one more row of what is written, where it means something. */
  typed?: (text: string) => Promise<Row | undefined>;
}

/** Rows that have every word of a search. Who types a whole name means that one, not the first that has the words too. */
export function foundRows(rows: readonly Row[], search: string): Row[] {
  const wanted = search.trim().toLowerCase().split(/\s+/).filter(Boolean);
  const whole = wanted.join(" ");
  const rank = ({ words, name }: Row) =>
    [words.toLowerCase(), name.toLowerCase()].includes(whole) ? 0 : words.toLowerCase().startsWith(whole) ? 1 : 2;
  return rows.filter(({ name, words }) => wanted.every((word) => `${name} ${words}`.toLowerCase().includes(word)))
    .sort((one, other) => rank(one) - rank(other));
}

export class Finder {
  private finding: Finding = { label: "", none: "", rows: [] };
  private rows: Row[] = [];
  private found: Row[] = [];
  private row = 0;
  /** What the server has not answered yet: the rows, or what is written. */
  private pending: Promise<unknown> | null = null;

  /** `selects` hears of parts that are taken several at a time, and whether they come to those that are selected. */
  constructor(
    private readonly dialog: HTMLDialogElement, private readonly field: HTMLInputElement, private readonly list: HTMLElement,
    private readonly selects: (numbers: number[], more: boolean) => void,
  ) {
    field.addEventListener("input", () => this.search());
    field.addEventListener("keydown", (event) => this.key(event));
  }

  /** Opens at once, so that no letter that is typed is taken for a key of the page; rows may follow. */
  async open(finding: Finding): Promise<void> {
    this.finding = finding;
    this.field.value = "";
    this.field.placeholder = finding.label;
    this.field.setAttribute("aria-label", finding.label);
    this.dialog.setAttribute("aria-label", finding.label);
    this.rows = [];
    this.found = [];
    const coming = Promise.resolve(finding.rows);
    const later = finding.rows instanceof Promise;
    if (later) {
      this.pending = coming;
      this.list.replaceChildren(element("li", { class: "dim" }, "Looking …"));
    } else {
      this.rows = finding.rows as Row[];
      this.search();
    }
    this.dialog.showModal();
    this.field.focus();
    if (!later) return;
    try {
      const rows = await coming;
      if (finding !== this.finding) return;
      this.rows = rows;
      this.search();
    } catch (error) {
      if (finding === this.finding) this.shut();
      throw error;
    }
  }

  private search(): void {
    const { finding } = this;
    const text = this.field.value.trim();
    this.found = foundRows(this.rows, text);
    this.row = 0;
    this.show();
    this.pending = finding.typed && text ? this.typed(finding, text) : null;
  }

  /** What is written is the first of what is found, where it means something. */
  private async typed(finding: Finding, text: string): Promise<void> {
    const row = await finding.typed?.(text).catch(() => undefined);
    if (!row || finding !== this.finding || this.field.value.trim() !== text) return;
    this.found = [row, ...this.found.filter(({ name }) => name !== row.name)];
    this.show();
  }

  private show(): void {
    const none = element("li", { class: "dim" }, this.finding.none);
    const from = Math.max(0, Math.min(this.row - LISTED / 2, this.found.length - LISTED));
    const rows = this.found.slice(from, from + LISTED)
      .map(({ words }, index) => element("li", {}, button(words, () => this.take(from + index), { "aria-selected": from + index === this.row })));
    const more = this.found.length - rows.length;
    this.list.replaceChildren(...(rows.length ? rows : [none]), ...(more > 0 ? [element("li", { class: "dim" }, `and ${more} more`)] : []));
    this.list.querySelector("[aria-selected=true]")?.scrollIntoView({ block: "nearest" });
  }

  private take(index: number): void {
    const row = this.found[index];
    this.shut();
    row?.take();
  }

  private shut(): void {
    this.finding = { ...this.finding };
    this.pending = null;
    this.dialog.close();
    this.field.blur(); // else it keeps the focus until the next frame, and the next key is lost in it
  }

  /** Enter, once all that was asked for is there. */
  private async enter(several: boolean, more: boolean): Promise<void> {
    const { finding } = this;
    while (this.pending) {
      const { pending } = this;
      await pending.catch(() => null);
      await Promise.resolve(); // who waited for the same before has put it into the list
      if (finding !== this.finding) return;
      if (pending === this.pending) this.pending = null;
    }
    const numbers = (more ? [this.found[this.row]] : this.found).map((row) => row?.number).filter((number) => number != null);
    if (!(several || more) || !numbers.length) return this.take(this.row);
    this.shut();
    this.selects(numbers, more);
  }

  private key(event: KeyboardEvent): void {
    if (event.key === "Escape") {
      event.preventDefault(); // else the first one only empties the field
      this.shut();
    }
    if (event.key === "Enter") {
      event.preventDefault();
      void this.enter(event.shiftKey, event.altKey);
    }
    const way = ({ ArrowDown: 1, ArrowUp: -1 } as Record<string, number>)[event.key];
    if (!way || !this.found.length) return;
    event.preventDefault();
    this.row = (this.row + way + this.found.length) % this.found.length;
    this.show();
  }
}
