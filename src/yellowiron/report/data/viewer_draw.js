// Drawing with plain WebGL2: sun with shadow, sky light, a ground with a metre grid, lines where parts or creases meet.

const SUN = unit([0.35, -0.7, 1.0]);
const FIELD = (20 * Math.PI) / 180;
const SHADOW = 2048;
const TABLE = 2; // the texture unit of what is said of the parts

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
// All parts are one mesh: a vertex knows the number of its part, of which a row of texels says where it is (three rows of
// a matrix), how its normals turn (three), its colour and whether it is round, its number, whether it is seen and chosen.
const TEXELS = 8;
const WIDTH = 1024;
const PLACED = `${COMMON}
layout(location = 0) in vec3 position; layout(location = 1) in vec2 normal; layout(location = 2) in uint part;
uniform highp sampler2D table; uniform mat4 view;
vec4 told(int k) { int n = int(part) * ${TEXELS} + k; return texelFetch(table, ivec2(n % ${WIDTH}, n / ${WIDTH}), 0); }
vec3 placed() { vec4 p = vec4(position, 1.0); return vec3(dot(told(0), p), dot(told(1), p), dot(told(2), p)); }
const vec4 NOWHERE = vec4(2.0, 2.0, 2.0, 1.0);
`;
const PART_VERTEX = `${PLACED}
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
const PART_FRAGMENT = `${COMMON}${LIT}
in vec3 at, facing; flat in vec4 paint; flat in vec2 id;
void main() {
  vec3 n = paint.w > 0.5 ? normalize(facing) : normalize(cross(dFdx(at), dFdy(at)));
  if (dot(n, at - eye) > 0.0) n = -n;
  color = vec4(display(shaded(paint.rgb, at, n)), 1.0);
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
const SHADOW_VERTEX = `${PLACED}
void main() { gl_Position = told(7).z > 0.5 ? view * vec4(placed(), 1.0) : NOWHERE; }`;
const CHOSEN_VERTEX = `${PLACED}
void main() { gl_Position = told(7).z > 0.5 && told(7).w > 0.5 ? view * vec4(placed(), 1.0) : NOWHERE; }`;
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

/** Writes where a part is, and how its normals turn (up to length: by the matrix's cofactors, so that mirrors and scales
 * are right), into a table of numbers: the part's place (16, column-major) after its shape's box. */
function writePlace(table, k, place, { low, size }) {
  for (let row = 0; row < 3; row++) {
    let middle = place[12 + row];
    for (let column = 0; column < 3; column++) {
      const value = place[4 * column + row];
      middle += value * low[column];
      table[k + 4 * row + column] = value * size[column];
      const [r1, r2, c1, c2] = [(row + 1) % 3, (row + 2) % 3, (column + 1) % 3, (column + 2) % 3];
      table[k + 12 + 4 * row + column] =
        place[4 * c1 + r1] * place[4 * c2 + r2] - place[4 * c1 + r2] * place[4 * c2 + r1];
    }
    table[k + 4 * row + 3] = middle;
  }
}

class Renderer {
  /** Of parts `{shape}`, which stay in their order. Throws where WebGL2 is missing. */
  constructor(canvas, shapes, parts) {
    // A preserved picture survives printing, screenshots and tabs in the background without being drawn again.
    const gl = canvas.getContext("webgl2", { antialias: false, alpha: false, preserveDrawingBuffer: true });
    if (!gl) throw new Error("no WebGL2");
    this.gl = gl;
    this.canvas = canvas;
    this.programs = {
      part: this.#program(PART_VERTEX, PART_FRAGMENT),
      ground: this.#program(GROUND_VERTEX, GROUND_FRAGMENT),
      shadow: this.#program(SHADOW_VERTEX, SHADOW_FRAGMENT),
      chosen: this.#program(CHOSEN_VERTEX, CHOSEN_FRAGMENT),
      screen: this.#program(SCREEN_VERTEX, SCREEN_FRAGMENT),
    };
    this.shapes = shapes;
    this.#upload(shapes, parts);
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

  /** One mesh of all parts, and the table of what is said of each. */
  #upload(shapes, parts) {
    const gl = this.gl;
    const meshes = new Map([...new Set(parts.map((part) => part.shape))].map((n) => [n, decodeMesh(shapes[n])]));
    const sum = (count) => parts.reduce((total, part) => total + count(meshes.get(part.shape)), 0);
    const count = sum((mesh) => mesh.points.length / 3);
    const [points, normals, owner] = [new Uint16Array(4 * count), new Int8Array(4 * count), new Uint16Array(2 * count)];
    const indices = new Uint32Array(sum((mesh) => mesh.indices.length));
    let [vertex, corner] = [0, 0];
    parts.forEach((part, number) => {
      const mesh = meshes.get(part.shape);
      for (let i = 0; i < mesh.indices.length; i++) indices[corner++] = vertex + mesh.indices[i];
      for (let i = 0; i < mesh.points.length / 3; i++, vertex++) {
        // Rows of four, and of two, as graphics cards like them.
        for (let k = 0; k < 3; k++) points[4 * vertex + k] = mesh.points[3 * i + k];
        for (let k = 0; k < 2; k++) normals[4 * vertex + k] = mesh.normals[2 * i + k];
        owner[2 * vertex] = number;
      }
    });
    this.mesh = { array: gl.createVertexArray(), count: indices.length };
    gl.bindVertexArray(this.mesh.array);
    const fill = (target, data) => {
      gl.bindBuffer(target, gl.createBuffer());
      gl.bufferData(target, data, gl.STATIC_DRAW);
    };
    fill(gl.ARRAY_BUFFER, points);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.UNSIGNED_SHORT, true, 8, 0);
    fill(gl.ARRAY_BUFFER, normals);
    gl.enableVertexAttribArray(1);
    gl.vertexAttribPointer(1, 2, gl.BYTE, true, 4, 0);
    fill(gl.ARRAY_BUFFER, owner);
    gl.enableVertexAttribArray(2);
    gl.vertexAttribIPointer(2, 1, gl.UNSIGNED_SHORT, 4, 0);
    fill(gl.ELEMENT_ARRAY_BUFFER, indices);
    gl.bindVertexArray(null);
    const height = Math.max(1, Math.ceil((parts.length * TEXELS) / WIDTH));
    this.table = { numbers: new Float32Array(4 * WIDTH * height), height };
    this.table.texture = this.#texture(gl.RGBA32F, WIDTH, height, gl.NEAREST);
  }

  /** Says of every part where it is, how it looks, whether it is seen and chosen. */
  #tell(parts, chosen) {
    const gl = this.gl;
    const { numbers, texture, height } = this.table;
    parts.forEach((part, index) => {
      const k = 4 * TEXELS * index;
      const shape = this.shapes[part.shape];
      writePlace(numbers, k, part.place, shape);
      for (let c = 0; c < 3; c++) numbers[k + 24 + c] = (part.color[c] / 255) ** 2.2;
      numbers[k + 27] = shape.normals ? 1 : 0;
      numbers[k + 28] = (part.number & 255) / 255;
      numbers[k + 29] = (part.number >> 8) / 255;
      numbers[k + 30] = part.hidden ? 0 : 1;
      numbers[k + 31] = chosen.has(part.number) ? 1 : 0;
    });
    gl.activeTexture(gl.TEXTURE0 + TABLE);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, WIDTH, height, gl.RGBA, gl.FLOAT, numbers);
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
    const { width, height } = this.canvas;
    this.#tell(parts, chosen);
    if (changed || !this.sunView) this.#shadows(scene);
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
    this.#all(part.at);
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
    if (chosen.size) this.#mark(camera);
  }

  /** Tints parts through all that is in front of them: their own depth first, then their colour once. */
  #mark(camera) {
    const gl = this.gl;
    const { program, at } = this.programs.chosen;
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.useProgram(program);
    gl.uniformMatrix4fv(at.view, false, camera.matrix);
    gl.colorMask(false, false, false, false);
    this.#all(at);
    gl.colorMask(true, true, true, true);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    this.#all(at);
    gl.disable(gl.BLEND);
  }

  /** All parts, in one call. */
  #all(at) {
    const gl = this.gl;
    gl.activeTexture(gl.TEXTURE0 + TABLE);
    gl.bindTexture(gl.TEXTURE_2D, this.table.texture);
    gl.uniform1i(at.table, TABLE);
    gl.bindVertexArray(this.mesh.array);
    gl.drawElements(gl.TRIANGLES, this.mesh.count, gl.UNSIGNED_INT, 0);
  }

  #shadows(scene) {
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
    this.#all(at);
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
