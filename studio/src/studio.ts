/** The studio's page. */

import { by, Studio } from "./page/studio.ts";
import { packing } from "./page/server.ts";
import { element } from "./viewer/dom.ts";
import { Viewer } from "./viewer/viewer.ts";

async function open(): Promise<void> {
  const page = (id: string) => element("div", { class: "t-list", id });
  const [shapes, model] = await Promise.all([packing("shapes"), packing("machine")]);
  let studio: Studio | null = null;
  const viewer = new Viewer(by("viewer"), Object.assign(model, { shapes: shapes.shapes, leftOut: shapes.leftOut }), {
    pages: [["Joints", page("joints")], ["Values", page("values")], ["History", page("history")]],
    onchoose: (number, event) => studio?.choose(number, event),
    onjoint: (name) => studio && !studio.aim && studio.choosesJoint(name),
  });
  studio = new Studio(viewer, model.version);
  Object.assign(window, { yellowiron: studio });
  studio.listen();
  await studio.load();
}

open().catch((error: Error) => {
  by("viewer").replaceChildren(element("p", { class: "t-wait" }, `The studio cannot be shown here: ${error.message}.`));
});
