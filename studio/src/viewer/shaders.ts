/** What the graphics card runs: sun with shadow, sky light, a ground with a metre grid, lines where parts or creases meet. */

import { TEXELS, WIDTH } from "./meshes.ts";

/** Pixels of the shadow's picture, each way. */
export const SHADOW = 2048;

const COMMON = `
precision highp float; precision highp int; precision highp sampler2DShadow;
vec3 display(vec3 linear) { return pow(clamp(linear, 0.0, 1.0), vec3(1.0 / 2.2)); }
vec2 sign1(vec2 v) { return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0); }
vec3 unfold(vec2 e) {
  vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * sign1(n.xy);
  return normalize(n);
}
vec2 fold(vec3 n) {
  n /= abs(n.x) + abs(n.y) + abs(n.z);
  return n.z >= 0.0 ? n.xy : (1.0 - abs(n.yx)) * sign1(n.xy);
}
`;
const LIT = `
uniform sampler2DShadow shadow; uniform mat4 sunView; uniform vec3 sun, eye, sky;
float lit(vec3 at, vec3 n) {
  vec3 p = (sunView * vec4(at + n * 0.02, 1.0)).xyz * 0.5 + 0.5;
  if (any(lessThan(p, vec3(0.0))) || any(greaterThan(p, vec3(1.0)))) return 1.0;
  float sum = 0.0;
  for (int i = -1; i <= 1; i++) for (int j = -1; j <= 1; j++)
    sum += texture(shadow, vec3(p.xy + 1.4 * vec2(i, j) / ${SHADOW.toFixed(1)}, p.z - 0.0006));
  return sum / 9.0;
}
vec3 shaded(vec3 albedo, vec3 at, vec3 n) {
  float direct = max(dot(n, sun), 0.0);
  return albedo * (0.22 + 0.24 * (0.5 + 0.5 * n.z) + 0.62 * (direct > 0.0 ? direct * lit(at, n) : 0.0));
}
layout(location = 0) out vec4 color; layout(location = 1) out vec4 label;
`;
// A point knows the number of its part, of which a row of texels says the rest (`meshes.writePart`).
const PLACED = `${COMMON}
in vec3 position; in vec2 normal; in uint part;
uniform highp sampler2D table; uniform mat4 view;
vec4 told(int k) { int n = int(part) * ${TEXELS} + k; return texelFetch(table, ivec2(n % ${WIDTH}, n / ${WIDTH}), 0); }
vec3 placed() { vec4 p = vec4(position, 1.0); return vec3(dot(told(0), p), dot(told(1), p), dot(told(2), p)); }
const vec4 NOWHERE = vec4(2.0, 2.0, 2.0, 1.0);
`;
export const PART_VERTEX = `${PLACED}
out vec3 at, facing; flat out vec4 paint; flat out vec2 id;
void main() {
  at = placed();
  vec3 n = unfold(normal);
  facing = vec3(dot(told(3).xyz, n), dot(told(4).xyz, n), dot(told(5).xyz, n));
  paint = told(6);
  vec4 mine = told(7);
  id = mine.xy;
  gl_Position = mine.z > 0.5 ? view * vec4(at, 1.0) : NOWHERE;
}`;
export const PART_FRAGMENT = `${COMMON}${LIT}
in vec3 at, facing; flat in vec4 paint; flat in vec2 id;
void main() {
  vec3 n = paint.w > 0.5 ? normalize(facing) : normalize(cross(dFdx(at), dFdy(at)));
  if (dot(n, at - eye) > 0.0) n = -n;
  color = vec4(display(shaded(paint.rgb, at, n)), 1.0);
  label = vec4(id, fold(n) * 0.5 + 0.5);
}`;
// One triangle around the ground's square.
export const GROUND_VERTEX = `${COMMON}
uniform mat4 view; uniform vec3 middle; uniform float reach; out vec3 at;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;
  at = vec3(middle.xy + corner * reach, 0.0); gl_Position = view * vec4(at, 1.0);
}`;
export const GROUND_FRAGMENT = `${COMMON}${LIT}
in vec3 at; uniform vec3 middle; uniform float reach;
float lines(vec2 p, float width) {
  vec2 w = fwidth(p);
  vec2 near = abs(fract(p - 0.5) - 0.5) / w;
  return (1.0 - clamp(min(near.x, near.y) - width, 0.0, 1.0)) * clamp(0.5 / max(w.x, w.y), 0.0, 1.0);
}
void main() {
  vec3 ground = shaded(vec3(0.78, 0.77, 0.74), at, vec3(0.0, 0.0, 1.0));
  ground *= 1.0 - 0.12 * lines(at.xy, 0.0) - 0.10 * lines(at.xy / 5.0, 0.3);
  float away = clamp(distance(at.xy, middle.xy) / reach, 0.0, 1.0);
  color = vec4(display(mix(ground, sky, away * away * (3.0 - 2.0 * away))), 1.0); label = vec4(0.0, 0.0, 0.5, 0.5);
}`;
export const SHADOW_VERTEX = `${PLACED}
void main() { gl_Position = told(7).z > 0.5 ? view * vec4(placed(), 1.0) : NOWHERE; }`;
export const SHADOW_FRAGMENT = `${COMMON} out vec4 pixel; void main() { pixel = vec4(1.0); }`;
export const CHOSEN_VERTEX = `${PLACED}
void main() { gl_Position = told(7).z > 0.5 && told(7).w > 0.5 ? view * vec4(placed(), 1.0) : NOWHERE; }`;
export const CHOSEN_FRAGMENT = `${COMMON} out vec4 pixel; void main() { pixel = vec4(0.10, 0.45, 0.95, 0.5); }`;
export const SCREEN_VERTEX = `${COMMON}
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }`;
// The picture begins as nothing at all: where it still is, there is the sky.
export const SCREEN_FRAGMENT = `${COMMON}
uniform sampler2D colors, labels; uniform int fine; uniform float ink; uniform vec3 sky; out vec4 pixel;
bool differ(vec4 a, vec4 b) {
  bool seen = a.x + a.y > 0.0 && b.x + b.y > 0.0;
  return a.xy != b.xy || (seen && dot(unfold(a.zw * 2.0 - 1.0), unfold(b.zw * 2.0 - 1.0)) < 0.82);
}
void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * fine, last = textureSize(labels, 0) - 1;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < fine; i++) for (int j = 0; j < fine; j++) {
    ivec2 p = first + ivec2(i, j);
    vec4 here = texelFetch(labels, p, 0);
    bool edge = differ(here, texelFetch(labels, min(p + ivec2(1, 0), last), 0))
      || differ(here, texelFetch(labels, min(p + ivec2(0, 1), last), 0));
    vec4 found = texelFetch(colors, p, 0);
    vec3 c = found.a > 0.0 ? found.rgb : display(sky);
    sum += edge ? c * ink : c;
  }
  pixel = vec4(sum / float(fine * fine), 1.0);
}`;
