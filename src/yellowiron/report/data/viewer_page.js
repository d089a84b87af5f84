// The view in the report's page.

/** Links between what is told and the machine: `#part=…`, `#joint=…` and `#value=…` lead to what they name, and every
 * place of a finding, joint and part of the lists is such a link. */
function link(viewer) {
  const numbers = new Map(viewer.model.parts.flatMap((part) => [[part.name, part.number], [part.path, part.number]]));
  const row = (kind, name) => [...document.querySelectorAll(`[data-${kind}]`)].find((each) => each.dataset[kind] === name);
  const reveal = (target) => {
    for (let each = target; each; each = each.parentElement) if (each.tagName === "DETAILS") each.open = true;
    target.scrollIntoView({ block: "center" });
    target.classList.add("told");
    setTimeout(() => target.classList.remove("told"), 2500);
  };
  const follow = () => {
    const [kind, name] = decodeURIComponent(location.hash.slice(1)).split(/=(.*)/s);
    if (kind === "part" && numbers.has(name)) {
      viewer.choose(numbers.get(name));
      viewer.focus(new Set([numbers.get(name)]));
      place.scrollIntoView({ block: "center" });
    } else if (kind === "joint" && viewer.model.joints.some((joint) => joint.name === name)) {
      viewer.showAxes([name]);
      place.scrollIntoView({ block: "center" });
    } else if (kind === "value" && row("value", name)) reveal(row("value", name));
    else if (kind === "row" && row("joint", name)) reveal(row("joint", name));
  };
  const joints = new Set(viewer.model.joints.map((joint) => joint.name));
  const linked = (cell, hash) => {
    const made = element("a", { href: `#${hash}` });
    made.append(...cell.childNodes);
    cell.replaceChildren(made);
  };
  for (const cell of document.querySelectorAll("td.where")) {
    const name = cell.textContent.trim();
    if (numbers.has(name)) linked(cell, `part=${encodeURIComponent(name)}`);
    else if (joints.has(name)) linked(cell, `joint=${encodeURIComponent(name)}`);
    else if (row("value", name)) linked(cell, `value=${encodeURIComponent(name)}`);
  }
  for (const each of document.querySelectorAll("[data-joint]"))
    if (joints.has(each.dataset.joint)) linked(each.firstElementChild, `joint=${encodeURIComponent(each.dataset.joint)}`);
  for (const each of document.querySelectorAll("[data-part]"))
    if (numbers.has(each.dataset.part)) linked(each, `part=${encodeURIComponent(each.dataset.part)}`);
  addEventListener("hashchange", follow);
  follow();
}

const place = document.getElementById("viewer");
try {
  if (!("DecompressionStream" in window)) throw new Error("no DecompressionStream");
  const packed = atob(document.getElementById("viewer-data").textContent.trim());
  const viewer = new Viewer(place, await unpack(Uint8Array.from(packed, (letter) => letter.charCodeAt(0))));
  document.getElementById("viewer-caption").textContent = "The machine as built: move it, turn it, click a part.";
  window.yellowiron = Object.assign(viewer, { moved });
  link(viewer);
} catch (error) {
  document.getElementById("viewer-caption").textContent =
    `As drawn in the CAD model. The 3D view needs a browser with WebGL2 (${error.message}).`;
}
