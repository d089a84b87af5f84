/** Drawing with three.js: all parts are one mesh and one call, moved and coloured by a texture. */

import {
  BufferAttribute, BufferGeometry, Camera as Standing, DataTexture, DepthFormat, DepthTexture, DoubleSide, FloatType, GLSL3, IntType,
  LessEqualCompare, LinearFilter, Matrix4, Mesh, NearestFilter, NoBlending, NormalBlending, RawShaderMaterial, RedFormat, RGBAFormat, Scene,
  type ShaderMaterialParameters, UnsignedIntType, Vector3, WebGLRenderer, WebGLRenderTarget,
} from "three";
import type { Ball, Camera } from "./camera.ts";
import { joined, TEXELS, WIDTH, writePart } from "./meshes.ts";
import type { Part, PartEntry, Shape } from "./model.ts";
import * as shaders from "./shaders.ts";
import { cross, dot, scaled, unit } from "./vectors.ts";

const SUN = unit([0.35, -0.7, 1.0]);
const SKY = [0.85, 0.89, 0.93];

export interface How {
  /** So many pixels in a row make one on the screen. */
  fine: number;
  /** Numbers of the parts that are tinted through all that is in front of them. */
  chosen: ReadonlySet<number>;
  /** Something moved: shadows are cast anew. */
  moved: boolean;
  /** What is said of the parts is as it was: where they are, their colours, which are seen and chosen. */
  same: boolean;
}

/** Three corners without coordinates: the shader knows where they are. */
function triangle(): BufferGeometry {
  const made = new BufferGeometry();
  made.setDrawRange(0, 3);
  return made;
}

function sceneOf(...meshes: Mesh[]): Scene {
  const scene = new Scene();
  scene.matrixWorldAutoUpdate = false;
  for (const mesh of meshes) mesh.frustumCulled = false; // the shaders alone know where things are
  scene.add(...meshes);
  return scene;
}

export class Renderer {
  /** For who counts its calls. */
  readonly gl: WebGL2RenderingContext;
  /** All parts; `count` of corners. */
  readonly mesh: { geometry: BufferGeometry; count: number };
  private readonly three: WebGLRenderer;
  private readonly camera = new Standing();
  private readonly table: DataTexture;
  private readonly numbers: Float32Array;
  private readonly shadow: WebGLRenderTarget;
  private readonly ground: Mesh;
  private readonly scenes: { world: Scene; shadow: Scene; chosen: Scene; screen: Scene };
  /** What all shaders are told. */
  private readonly told;
  private target: WebGLRenderTarget | null = null;
  private fine = 1;
  private lighted = false;

  /** Of parts that stay in their order. Throws where WebGL2 is missing. */
  constructor(private readonly canvas: HTMLCanvasElement, private readonly shapes: readonly Shape[], parts: readonly Pick<PartEntry, "shape">[]) {
    // A preserved picture survives printing, screenshots and tabs in the background without being drawn again.
    const gl = canvas.getContext("webgl2", { antialias: false, alpha: false, preserveDrawingBuffer: true });
    if (!gl) throw new Error("no WebGL2");
    this.gl = gl;
    this.three = new WebGLRenderer({ canvas, context: gl });
    this.three.autoClear = false;
    this.three.sortObjects = false;
    this.three.debug.onShaderError = (_, program) => {
      throw new Error(gl.getProgramInfoLog(program) || "the graphics card takes no program");
    };

    const { points, normals, owner, indices } = joined(shapes, parts);
    const geometry = new BufferGeometry();
    const part = new BufferAttribute(owner, 2);
    part.gpuType = IntType;
    geometry.setAttribute("position", new BufferAttribute(points, 4, true));
    geometry.setAttribute("normal", new BufferAttribute(normals, 4, true));
    geometry.setAttribute("part", part);
    geometry.setIndex(new BufferAttribute(indices, 1));
    this.mesh = { geometry, count: indices.length };
    const height = Math.max(1, Math.ceil((parts.length * TEXELS) / WIDTH));
    this.numbers = new Float32Array(4 * WIDTH * height);
    this.table = new DataTexture(this.numbers, WIDTH, height, RGBAFormat, FloatType);

    const depth = new DepthTexture(shaders.SHADOW, shaders.SHADOW, UnsignedIntType);
    Object.assign(depth, { format: DepthFormat, compareFunction: LessEqualCompare, minFilter: LinearFilter, magFilter: LinearFilter });
    // Its colours are one byte a pixel, and are not written.
    this.shadow = new WebGLRenderTarget(shaders.SHADOW, shaders.SHADOW, { depthTexture: depth, format: RedFormat });

    this.told = {
      table: { value: this.table }, view: { value: new Matrix4() }, sunView: { value: new Matrix4() }, shadow: { value: depth },
      sun: { value: new Vector3(...SUN) }, sky: { value: new Vector3(...SKY) }, eye: { value: new Vector3() },
      middle: { value: new Vector3() }, reach: { value: 1 }, colors: { value: null as unknown }, labels: { value: null as unknown },
      fine: { value: 1 }, ink: { value: 1 },
    };
    const all = (vertexShader: string, fragmentShader: string, how: ShaderMaterialParameters = {}) =>
      new Mesh(geometry, this.material(vertexShader, fragmentShader, how));
    const { told } = this;
    const sunlit = this.material(shaders.SHADOW_VERTEX, shaders.SHADOW_FRAGMENT, { colorWrite: false });
    sunlit.uniforms = { ...told, view: told.sunView };
    this.ground = new Mesh(triangle(), this.material(shaders.GROUND_VERTEX, shaders.GROUND_FRAGMENT));
    this.scenes = {
      shadow: sceneOf(new Mesh(geometry, sunlit)),
      world: sceneOf(all(shaders.PART_VERTEX, shaders.PART_FRAGMENT), this.ground),
      screen: sceneOf(new Mesh(triangle(), this.material(shaders.SCREEN_VERTEX, shaders.SCREEN_FRAGMENT, { depthTest: false, depthWrite: false }))),
      // Their own depth first, then their colour once.
      chosen: sceneOf(
        all(shaders.CHOSEN_VERTEX, shaders.CHOSEN_FRAGMENT, { colorWrite: false }),
        all(shaders.CHOSEN_VERTEX, shaders.CHOSEN_FRAGMENT, { transparent: true, blending: NormalBlending }),
      ),
    };
  }

  private material(vertexShader: string, fragmentShader: string, how: ShaderMaterialParameters = {}): RawShaderMaterial {
    return new RawShaderMaterial({
      glslVersion: GLSL3, vertexShader, fragmentShader, uniforms: this.told, side: DoubleSide, blending: NoBlending, ...how,
    });
  }

  /** The picture to come: colours and, beside them, part numbers and normals; made anew when the size changes. */
  private sized(width: number, height: number): WebGLRenderTarget {
    if (this.target?.width === width && this.target.height === height) return this.target;
    this.target?.dispose();
    this.target = new WebGLRenderTarget(width, height, { count: 2, minFilter: NearestFilter, magFilter: NearestFilter, generateMipmaps: false });
    [this.told.colors.value, this.told.labels.value] = this.target.textures;
    return this.target;
  }

  private render(scene: Scene, target: WebGLRenderTarget | null): void {
    this.three.setRenderTarget(target);
    this.three.render(scene, this.camera);
  }

  /** Draws parts with a camera; the ball is the machine's. */
  draw(parts: readonly Part[], camera: Camera, ball: Ball, { fine, chosen, moved, same }: How): void {
    const { told, three } = this;
    const { width, height } = this.canvas;
    three.setViewport(0, 0, width, height);
    three.setClearColor(0x000000, 0); // each time: a context that comes back has forgotten
    if (!same) {
      parts.forEach((part, index) => writePart(this.numbers, index, part, this.shapes[part.shape], chosen.has(part.number)));
      this.table.needsUpdate = true;
    }
    if (moved || !this.lighted) this.castShadows(ball);
    const target = this.sized(width * fine, height * fine);
    told.view.value.fromArray(camera.matrix);
    told.eye.value.fromArray(camera.eye);
    told.middle.value.fromArray(ball.middle);
    told.reach.value = 3.2 * ball.radius;
    told.fine.value = this.fine = fine;
    told.ink.value = fine > 1 ? 0.48 : 0.68;
    this.ground.visible = camera.eye[2] > 0;
    three.setRenderTarget(target);
    three.clear();
    this.render(this.scenes.world, target);
    this.render(this.scenes.screen, null);
    if (!chosen.size) return;
    three.clearDepth();
    this.render(this.scenes.chosen, null);
  }

  private castShadows({ middle, radius }: Ball): void {
    const right = unit(cross([0, 0, 1], SUN));
    const up = cross(SUN, right);
    const reach = 1.3 * radius;
    const across = [0, 1, 2].flatMap((k) => [right[k] / reach, up[k] / reach, -SUN[k] / (2 * reach), 0]);
    const back = [right, up, scaled(SUN, -0.5)].map((row) => -dot(row, middle) / reach);
    this.told.sunView.value.fromArray([...across, ...back, 1]);
    this.three.setRenderTarget(this.shadow);
    this.three.clear();
    this.render(this.scenes.shadow, this.shadow);
    this.lighted = true;
  }

  /** Number of the part at a pixel of the canvas (from the top left), 0: none. */
  partAt(x: number, y: number): number {
    if (!this.target) return 0;
    const bytes = new Uint8Array(4);
    this.three.readRenderTargetPixels(this.target, x * this.fine, this.target.height - 1 - y * this.fine, 1, 1, bytes, undefined, 1);
    return bytes[0] + 256 * bytes[1];
  }
}
