import { expect, it } from "vitest";
import { cameraOf, fitted, seenAt, wayThrough } from "../src/viewer/camera.ts";
import { add, scaled } from "../src/viewer/vectors.ts";

const view = { azimuth: -0.75, elevation: 0.3 };
const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((bits) => [0, 1, 2].map((k) => ((bits >> k) & 1) * [6, 2, 3][k]));

it("all corners are in the picture, and some are near its edge", () => {
  for (const aspect of [0.6, 1, 2.2]) {
    const { matrix } = cameraOf({ ...view, ...fitted(corners, view, aspect) }, aspect);
    const seen = corners.map((corner) => seenAt(matrix, corner)!.map(Math.abs)).flat();
    expect(Math.max(...seen)).toBeLessThan(1);
    expect(Math.max(...seen)).toBeGreaterThan(0.75);
  }
});

it("the way through where a point is seen leads to it", () => {
  const camera = cameraOf({ ...view, target: [1, 2, 3], distance: 20 }, 1.5);
  const point = [2, 1, 4];
  const [x, y] = seenAt(camera.matrix, point)!;
  const way = wayThrough(camera, 1.5, x, y);
  const far = (point[0] - camera.eye[0]) / way[0];
  add(camera.eye, scaled(way, far)).forEach((value, k) => expect(value).toBeCloseTo(point[k], 9));
});

it("what is behind the camera is nowhere", () => {
  const camera = cameraOf({ ...view, target: [0, 0, 0], distance: 20 }, 1.5);
  expect(seenAt(camera.matrix, add(camera.eye, camera.back))).toBeNull();
});
