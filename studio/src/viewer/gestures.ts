/** What hands do to the picture: pointers, fingers, the wheel, keys. */

export interface Moved {
  readonly canvas: HTMLCanvasElement;
  readonly stage: HTMLElement;
  readonly tip: HTMLElement;
  orbit(dx: number, dy: number): void;
  pan(dx: number, dy: number): void;
  /** Zooms by a factor towards a pixel of the stage. */
  zoom(factor: number, x: number, y: number): void;
  reset(): void;
  hover(x: number, y: number): void;
  pick(x: number, y: number): number;
  choose(number: number, event?: MouseEvent | null): unknown;
}

type Point = [number, number];

export function listen(view: Moved): void {
  const { canvas } = view;
  const at = (event: MouseEvent): Point => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  pointers(view, at);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("dblclick", () => view.reset());
  const wheel = (event: WheelEvent) => {
    // The page keeps scrolling until the view was clicked.
    if (document.activeElement !== canvas && !event.ctrlKey && !document.fullscreenElement) return;
    event.preventDefault();
    view.zoom(Math.exp(Math.max(-0.5, Math.min(0.5, event.deltaY * 0.0015))), ...at(event));
  };
  canvas.addEventListener("wheel", wheel, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    const middle: Point = [view.stage.clientWidth / 2, view.stage.clientHeight / 2];
    const acts: Record<string, () => unknown> = {
      ArrowLeft: () => view.orbit(25, 0), ArrowRight: () => view.orbit(-25, 0),
      ArrowUp: () => view.orbit(0, 25), ArrowDown: () => view.orbit(0, -25),
      "+": () => view.zoom(0.85, ...middle), "=": () => view.zoom(0.85, ...middle),
      "-": () => view.zoom(1.18, ...middle), 0: () => view.reset(), Escape: () => view.choose(0),
    };
    const act = acts[event.key];
    if (!act || event.altKey || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    act();
  });
}

function pointers(view: Moved, at: (event: MouseEvent) => Point): void {
  const { canvas } = view;
  const down = new Map<number, Point>();
  let travelled = 0;
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    canvas.focus({ preventScroll: true });
    if (!down.size) travelled = 0;
    down.set(event.pointerId, at(event));
    view.tip.hidden = true;
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = down.get(event.pointerId);
    if (!before) return view.hover(...at(event));
    const now = at(event);
    const [dx, dy] = [now[0] - before[0], now[1] - before[1]];
    travelled += Math.hypot(dx, dy);
    const other = down.size === 2 ? [...down].find(([id]) => id !== event.pointerId)?.[1] : undefined;
    if (other) {
      const apart = (p: Point) => Math.hypot(p[0] - other[0], p[1] - other[1]) || 1;
      view.pan(dx / 2, dy / 2);
      view.zoom(apart(before) / apart(now), (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
    } else if (event.buttons & 6 || event.shiftKey) view.pan(dx, dy);
    else view.orbit(dx, dy);
    down.set(event.pointerId, now);
  });
  const up = (event: PointerEvent) => {
    const was = down.delete(event.pointerId);
    const click = was && event.type === "pointerup" && travelled < 5 && event.button === 0;
    if (click) view.choose(view.pick(...at(event)), event);
  };
  canvas.addEventListener("pointerup", up);
  canvas.addEventListener("pointercancel", up);
  canvas.addEventListener("pointerleave", () => (view.tip.hidden = true));
}
