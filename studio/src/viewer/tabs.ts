/** Tabs of a panel; arrow keys go from one to the next. */

import { element } from "./dom.ts";

export function tabs(pages: readonly [string, HTMLElement][]): HTMLElement[] {
  const made = pages.map(([name, page]) => {
    const tab = element("button", { type: "button", role: "tab", id: `v-tab-${name}` }, name);
    page.setAttribute("role", "tabpanel");
    page.setAttribute("aria-labelledby", tab.id);
    return tab;
  });
  const open = (chosen: number) =>
    pages.forEach(([, page], index) => {
      page.hidden = index !== chosen;
      made[index].setAttribute("aria-selected", String(index === chosen));
      made[index].tabIndex = index === chosen ? 0 : -1;
    });
  made.forEach((tab, index) => {
    tab.addEventListener("click", () => open(index));
    tab.addEventListener("keydown", (event) => {
      const way = ({ ArrowLeft: -1, ArrowRight: 1 } as Record<string, number>)[event.key];
      if (!way) return;
      const next = (index + way + made.length) % made.length;
      open(next);
      made[next].focus();
    });
  });
  open(0);
  return [element("div", { class: "v-tabs", role: "tablist" }, ...made), ...pages.map(([, page]) => page)];
}
