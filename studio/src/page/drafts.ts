/** Fields of the card: what a person writes stays until it is sent or given up, whatever else becomes known. */

import { element } from "../viewer/dom.ts";

/** What is written and not sent, by what it is about. */
export type Drafts = Map<string, string>;

/** A form of one field. `send` gives whether what was written was taken, or null where it is nothing yet; `again` shows
 * the page anew. */
export function fieldOf(
  drafts: Drafts, about: string, { placeholder, label }: { placeholder: string; label: string },
  send: (text: string) => Promise<boolean> | null, again: () => void,
): HTMLFormElement {
  const input = element("input", { type: "text", placeholder, "aria-label": label, autocomplete: "off" });
  input.value = drafts.get(about) ?? "";
  input.addEventListener("input", () => drafts.set(about, input.value));
  input.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    event.stopPropagation();
    drafts.delete(about);
    input.value = "";
    input.blur();
    again();
  });
  const form = element("form", {}, input, element("button", { type: "submit" }, "Set"));
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    const text = input.value.trim();
    input.blur(); // what comes next is no more of it
    drafts.delete(about);
    const restore = () => text && !drafts.has(about) && drafts.set(about, text);
    const sent = send(text);
    if (sent) void sent.then((taken) => taken || (restore(), again()));
    else {
      restore();
      input.focus();
    }
  });
  return form;
}

/** Whether a person is writing in a part of the page: nothing there may be taken away. */
export function writing(place: HTMLElement): boolean {
  const { activeElement } = document;
  return activeElement instanceof HTMLInputElement && place.contains(activeElement);
}
