/** The view in the report's page. */

import { element } from "./viewer/dom.ts";
import { unpack } from "./viewer/model.ts";
import { moved } from "./viewer/vectors.ts";
import { Viewer } from "./viewer/viewer.ts";

const place = document.getElementById("viewer")!;
const caption = document.getElementById("viewer-caption")!;

/** Links between what is told and the machine: `#part=…`, `#joint=…` and `#value=…` lead to what they name, and every
 * place of a finding, joint and part of the lists is such a link. */
function link(viewer: Viewer): void {
  const numbers = new Map(viewer.model.parts.flatMap((part): [string, number][] => [[part.name, part.number], [part.path, part.number]]));
  const joints = new Set(viewer.model.joints.map((joint) => joint.name));
  const all = (kind: string) => [...document.querySelectorAll<HTMLElement>(`[data-${kind}]`)];
  const row = (kind: string, name: string) => all(kind).find((each) => each.dataset[kind] === name);
  const reveal = (target: HTMLElement) => {
    for (let each: HTMLElement | null = target; each; each = each.parentElement) if (each instanceof HTMLDetailsElement) each.open = true;
    target.scrollIntoView({ block: "center" });
    target.classList.add("told");
    setTimeout(() => target.classList.remove("told"), 2500);
  };
  const follow = () => {
    const [kind, name = ""] = decodeURIComponent(location.hash.slice(1)).split(/=(.*)/s);
    const number = numbers.get(name);
    const named = { value: row("value", name), row: row("joint", name) }[kind];
    if (kind === "part" && number) {
      viewer.choose(number);
      viewer.focus(new Set([number]));
      place.scrollIntoView({ block: "center" });
    } else if (kind === "joint" && joints.has(name)) {
      viewer.showAxes([name]);
      place.scrollIntoView({ block: "center" });
    } else if (named) reveal(named);
  };
  const linked = (cell: Element, kind: string, name: string) => {
    const made = element("a", { href: `#${kind}=${encodeURIComponent(name)}` });
    made.append(...cell.childNodes);
    cell.replaceChildren(made);
  };
  for (const cell of document.querySelectorAll("td.where")) {
    const name = cell.textContent.trim();
    if (numbers.has(name)) linked(cell, "part", name);
    else if (joints.has(name)) linked(cell, "joint", name);
    else if (row("value", name)) linked(cell, "value", name);
  }
  for (const each of all("joint")) if (joints.has(each.dataset.joint!)) linked(each.firstElementChild!, "joint", each.dataset.joint!);
  for (const each of all("part")) if (numbers.has(each.dataset.part!)) linked(each, "part", each.dataset.part!);
  addEventListener("hashchange", follow);
  follow();
}

async function open(): Promise<void> {
  if (!("DecompressionStream" in window)) throw new Error("no DecompressionStream");
  const packed = atob(document.getElementById("viewer-data")!.textContent.trim());
  const viewer = new Viewer(place, await unpack(Uint8Array.from(packed, (letter) => letter.charCodeAt(0))));
  caption.textContent = "The machine as built: move it, turn it, click a part.";
  Object.assign(window, { yellowiron: Object.assign(viewer, { moved }) });
  link(viewer);
}

open().catch((error: Error) => {
  caption.textContent = `As drawn in the CAD model. The 3D view needs a browser with WebGL2 (${error.message}).`;
});
