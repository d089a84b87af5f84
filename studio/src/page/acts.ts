/** What a key does. */

import type { Act } from "./keys.ts";
import type { Studio } from "./studio.ts";

export function act(studio: Studio, meant: Act): unknown {
  switch (meant.act) {
    case "next": return studio.go(studio.at + 1);
    case "before": return studio.go(studio.at - 1);
    case "none": return studio.none();
    case "overall": return studio.overall();
    case "find": return studio.find();
    case "search": return studio.search();
    case "assembly": return studio.assembly();
    case "rules": return studio.rules();
    case "mirror": return studio.mirrored();
    case "isolate": return studio.isolate();
    case "focus": return studio.viewer.focus(studio.shown);
    case "wiggle": return studio.wiggle();
    case "build": return studio.build();
    case "keys": return studio.keys();
    case "undo": case "redo": return studio.say(meant.act, {});
    case "yes": return studio.yes();
    case "point": return studio.point();
    case "reverse": return studio.reverse();
    case "step": return studio.step(meant.way);
    case "stop": return studio.stop(meant.end);
    case "answer": return studio.answer(meant.index);
    case "nothing": return studio.nothing();
  }
}
