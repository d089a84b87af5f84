// Drawing with plain WebGL2: sun with shadow, sky light, a ground with a metre grid, lines where parts or creases meet.

const SUN = unit([0.35, -0.7, 1.0]);
const FIELD = (20 * Math.PI) / 180;
const SHADOW = 2048;

const COMMON = `#version 300 es
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
const PART_VERTEX = `${COMMON}
layout(location = 0) in vec3 position; layout(location = 1) in vec2 normal;
uniform mat4 view, place; uniform mat3 turn; uniform vec3 low, size;
out vec3 at, facing;
void main() {
  vec4 p = place * vec4(low + position * size, 1.0);
  at = p.xyz; facing = turn * unfold(normal); gl_Position = view * p;
}`;
const PART_FRAGMENT = `${COMMON}${LIT}
in vec3 at, facing; uniform vec3 albedo; uniform vec2 id; uniform bool rounded;
void main() {
  vec3 n = rounded ? normalize(facing) : normalize(cross(dFdx(at), dFdy(at)));
  if (dot(n, at - eye) > 0.0) n = -n;
  color = vec4(display(shaded(albedo, at, n)), 1.0);
  label = vec4(id, fold(n) * 0.5 + 0.5);
}`;
const GROUND_VERTEX = `${COMMON}
uniform mat4 view; uniform vec3 middle; uniform float reach; out vec3 at;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  at = vec3(middle.xy + corner * reach, 0.0); gl_Position = view * vec4(at, 1.0);
}`;
const GROUND_FRAGMENT = `${COMMON}${LIT}
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
const SHADOW_VERTEX = `${COMMON}
layout(location = 0) in vec3 position; uniform mat4 view, place; uniform vec3 low, size;
void main() { gl_Position = view * (place * vec4(low + position * size, 1.0)); }`;
const SHADOW_FRAGMENT = `${COMMON} void main() {}`;
const CHOSEN_FRAGMENT = `${COMMON} out vec4 pixel; void main() { pixel = vec4(0.10, 0.45, 0.95, 0.5); }`;
const SCREEN_VERTEX = `${COMMON}
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }`;
const SCREEN_FRAGMENT = `${COMMON}
uniform sampler2D colors, labels; uniform int fine; uniform float ink; out vec4 pixel;
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
    vec3 c = texelFetch(colors, p, 0).rgb;
    sum += edge ? c * ink : c;
  }
  pixel = vec4(sum / float(fine * fine), 1.0);
}`;

/** Decodes a quantised mesh (see viewer.py) into arrays for the GPU. */
function decodeMesh(shape) {
  const count = shape.points.length / 3;
  const points = new Uint16Array(3 * count);
  for (let k = 0; k < 3; k++)
    for (let i = 0, value = 0; i < count; i++) {
      value = (value + shape.points[k * count + i]) & 65535;
      points[3 * i + k] = value;
    }
  const wide = shape.indices instanceof Int32Array;
  const indices = new (wide ? Uint32Array : Uint16Array)(shape.indices.length);
  for (let i = 0, value = 0; i < indices.length; i++) indices[i] = value = value + shape.indices[i];
  const normals = new Int8Array(2 * count);
  if (shape.normals) for (let i = 0; i < count; i++) {
    normals[2 * i] = shape.normals[i];
    normals[2 * i + 1] = shape.normals[count + i];
  }
  return { points, indices, normals };
}

/** How normals turn (up to length) where points go by a matrix: its cofactors, so that mirrors and scales are right. */
function normalMatrix(m) {
  const [a, b, c] = [0, 4, 8].map((k) => m.slice(k, k + 3));
  return [...cross(b, c), ...cross(c, a), ...cross(a, b)];
}

class Renderer {
  /** Throws where WebGL2 is missing. */
  constructor(canvas, shapes) {
    // A preserved picture survives printing, screenshots and tabs in the background without being drawn again.
    const gl = canvas.getContext("webgl2", { antialias: false, alpha: false, preserveDrawingBuffer: true });
    if (!gl) throw new Error("no WebGL2");
    this.gl = gl;
    this.canvas = canvas;
    this.programs = {
      part: this.#program(PART_VERTEX, PART_FRAGMENT),
      ground: this.#program(GROUND_VERTEX, GROUND_FRAGMENT),
      shadow: this.#program(SHADOW_VERTEX, SHADOW_FRAGMENT),
      chosen: this.#program(SHADOW_VERTEX, CHOSEN_FRAGMENT),
      screen: this.#program(SCREEN_VERTEX, SCREEN_FRAGMENT),
    };
    this.shapes = shapes.map((shape) => this.#upload(shape));
    this.empty = gl.createVertexArray();
    this.shadowMap = this.#texture(gl.DEPTH_COMPONENT24, SHADOW, SHADOW, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
    this.shadowTarget = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowTarget);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, this.shadowMap, 0);
    gl.drawBuffers([gl.NONE]);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
  }

  #program(vertex, fragment) {
    const gl = this.gl;
    const program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    const at = {};
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
      const { name } = gl.getActiveUniform(program, i);
      at[name] = gl.getUniformLocation(program, name);
    }
    return { program, at };
  }

  #upload(shape) {
    const gl = this.gl;
    const { points, indices, normals } = decodeMesh(shape);
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    const fill = (target, data) => {
      gl.bindBuffer(target, gl.createBuffer());
      gl.bufferData(target, data, gl.STATIC_DRAW);
    };
    fill(gl.ARRAY_BUFFER, points);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.UNSIGNED_SHORT, true, 0, 0);
    fill(gl.ARRAY_BUFFER, normals);
    gl.enableVertexAttribArray(1);
    gl.vertexAttribPointer(1, 2, gl.BYTE, true, 0, 0);
    fill(gl.ELEMENT_ARRAY_BUFFER, indices);
    gl.bindVertexArray(null);
    const type = indices instanceof Uint32Array ? gl.UNSIGNED_INT : gl.UNSIGNED_SHORT;
    return { array, type, count: indices.length, rounded: !!shape.normals, low: shape.low, size: shape.size };
  }

  #texture(format, width, height, filter) {
    const gl = this.gl;
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, filter);
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T])
      gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
    return texture;
  }

  /** The offscreen target: colours and, beside them, part numbers and normals; made anew when the size changes. */
  #target(width, height) {
    const gl = this.gl;
    if (this.target?.width === width && this.target?.height === height) return this.target;
    if (this.target) {
      [this.target.colors, this.target.labels].forEach((texture) => gl.deleteTexture(texture));
      gl.deleteRenderbuffer(this.target.depth);
      gl.deleteFramebuffer(this.target.buffer);
    }
    const [colors, labels] = [0, 1].map(() => this.#texture(gl.RGBA8, width, height, gl.NEAREST));
    const buffer = gl.createFramebuffer();
    const depth = gl.createRenderbuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, buffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, colors, 0);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT1, gl.TEXTURE_2D, labels, 0);
    gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, width, height);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
    gl.drawBuffers([gl.COLOR_ATTACHMENT0, gl.COLOR_ATTACHMENT1]);
    this.target = { width, height, colors, labels, buffer, depth };
    return this.target;
  }

  /**
   * Draws parts `{shape, place, color, number, hidden}` (colour in display bytes, number from 1) with a camera of
   * `cameraOf`; `fine` pixels in a row make one on the screen; `chosen` is a set of parts' numbers; `moved`: cast shadows anew.
   */
  draw(parts, camera, scene, { fine, chosen, moved: changed }) {
    const gl = this.gl;
    const visible = parts.filter((part) => !part.hidden);
    const { width, height } = this.canvas;
    if (changed || !this.sunView) this.#shadows(visible, scene);
    const target = this.#target(width * fine, height * fine);
    const { part, ground, screen } = this.programs;
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.buffer);
    gl.viewport(0, 0, target.width, target.height);
    const sky = [0.85, 0.89, 0.93];
    gl.clearBufferfv(gl.COLOR, 0, [...sky.map((value) => value ** (1 / 2.2)), 1]);
    gl.clearBufferfv(gl.COLOR, 1, [0, 0, 0.5, 0.5]);
    gl.clearBufferfv(gl.DEPTH, 0, [1]);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.shadowMap);
    const light = ({ program, at }) => {
      gl.useProgram(program);
      gl.uniformMatrix4fv(at.view, false, camera.matrix);
      gl.uniformMatrix4fv(at.sunView, false, this.sunView);
      gl.uniform3fv(at.sun, SUN);
      if (at.eye) gl.uniform3fv(at.eye, camera.eye);
      if (at.sky) gl.uniform3fv(at.sky, sky);
      gl.uniform1i(at.shadow, 0);
    };
    light(part);
    this.#each(visible, part.at, (each, shape) => {
      gl.uniform3fv(part.at.albedo, each.color.map((value) => (value / 255) ** 2.2));
      gl.uniform2f(part.at.id, (each.number & 255) / 255, (each.number >> 8) / 255);
      gl.uniform1i(part.at.rounded, shape.rounded ? 1 : 0);
      gl.uniformMatrix3fv(part.at.turn, false, normalMatrix(each.place));
    });
    if (camera.eye[2] > 0) {
      light(ground);
      gl.uniform3fv(ground.at.middle, scene.middle);
      gl.uniform1f(ground.at.reach, 3.2 * scene.radius);
      gl.bindVertexArray(this.empty);
      gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    gl.useProgram(screen.program);
    [target.colors, target.labels].forEach((texture, unitNumber) => {
      gl.activeTexture(gl.TEXTURE0 + unitNumber);
      gl.bindTexture(gl.TEXTURE_2D, texture);
    });
    gl.uniform1i(screen.at.colors, 0);
    gl.uniform1i(screen.at.labels, 1);
    gl.uniform1i(screen.at.fine, fine);
    gl.uniform1f(screen.at.ink, fine > 1 ? 0.48 : 0.68);
    gl.disable(gl.DEPTH_TEST);
    gl.bindVertexArray(this.empty);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.enable(gl.DEPTH_TEST);
    this.fine = fine;
    this.#mark(visible.filter((each) => chosen.has(each.number)), camera);
  }

  /** Tints parts through all that is in front of them: their own depth first, then their colour once. */
  #mark(parts, camera) {
    const gl = this.gl;
    const { program, at } = this.programs.chosen;
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.useProgram(program);
    gl.uniformMatrix4fv(at.view, false, camera.matrix);
    gl.colorMask(false, false, false, false);
    this.#each(parts, at);
    gl.colorMask(true, true, true, true);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    this.#each(parts, at);
    gl.disable(gl.BLEND);
  }

  #each(parts, at, before) {
    const gl = this.gl;
    for (const each of parts) {
      const shape = this.shapes[each.shape];
      gl.uniformMatrix4fv(at.place, false, each.place);
      gl.uniform3fv(at.low, shape.low);
      gl.uniform3fv(at.size, shape.size);
      before?.(each, shape);
      gl.bindVertexArray(shape.array);
      gl.drawElements(gl.TRIANGLES, shape.count, shape.type, 0);
    }
  }

  #shadows(parts, scene) {
    const gl = this.gl;
    const { program, at } = this.programs.shadow;
    const right = unit(cross([0, 0, 1], SUN));
    const up = cross(SUN, right);
    const reach = 1.3 * scene.radius;
    this.sunView = [];
    for (let k = 0; k < 3; k++) this.sunView.push(right[k] / reach, up[k] / reach, -SUN[k] / (2 * reach), 0);
    const back = [right, up, scaled(SUN, -0.5)].map((row) => -dot(row, scene.middle) / reach);
    this.sunView.push(...back, 1);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowTarget);
    gl.viewport(0, 0, SHADOW, SHADOW);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.useProgram(program);
    gl.uniformMatrix4fv(at.view, false, this.sunView);
    this.#each(parts, at);
  }

  /** Number of the part at a pixel of the canvas (from the top left), 0: none. */
  partAt(x, y) {
    const gl = this.gl;
    if (!this.target) return 0;
    const bytes = new Uint8Array(4);
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.target.buffer);
    gl.readBuffer(gl.COLOR_ATTACHMENT1);
    gl.readPixels(x * this.fine, this.target.height - 1 - y * this.fine, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    // The browser shows the canvas from the framebuffer that is bound for reading.
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, null);
    return bytes[0] + 256 * bytes[1];
  }
}

/** A camera that looks at a target from an azimuth, elevation and distance; `matrix` takes the world to clip space.
 * The scene's ball bounds what is near. */
function cameraOf({ target, azimuth, elevation, distance }, aspect, scene = { middle: target, radius: 1 }) {
  const { middle, radius } = scene;
  const level = Math.cos(elevation);
  const back = [level * Math.cos(azimuth), level * Math.sin(azimuth), Math.sin(elevation)];
  const right = [-Math.sin(azimuth), Math.cos(azimuth), 0];
  const up = cross(back, right);
  const eye = add(target, scaled(back, distance));
  const slope = Math.tan(FIELD / 2);
  const away = Math.hypot(...add(eye, scaled(middle, -1)));
  const far = away + 8 * radius;
  const near = Math.max(away - 1.8 * radius, 0.004 * distance);
  const depth = [(far + near) / (near - far), (2 * far * near) / (near - far)];
  const rows = [scaled(right, 1 / (slope * aspect)), scaled(up, 1 / slope), scaled(back, depth[0]), scaled(back, -1)];
  const ends = rows.map((row) => -dot(row, eye));
  ends[2] += depth[1];
  const matrix = [0, 1, 2].flatMap((k) => rows.map((row) => row[k])).concat(ends);
  return { eye, back, right, up, slope, matrix };
}
