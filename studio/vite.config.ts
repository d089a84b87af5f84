// Two bundles, each one script that loads nothing else: `--mode report` and `--mode studio`.
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { defineConfig, type Plugin } from "vite";

const three = fileURLToPath(new URL("node_modules/three/src/Three.js", import.meta.url));
const licence = readFileSync(new URL("node_modules/three/LICENSE", import.meta.url), "utf8").trim();

/** three.js' own shaders, a quarter of its size: all of ours are in `shaders.ts`. */
const ownShaders: Plugin = {
  name: "own-shaders",
  enforce: "pre",
  resolveId: (id) => (id.endsWith("/ShaderChunk.js") ? "\0no-shaders" : id === "three" ? three : null),
  load: (id) => (id === "\0no-shaders" ? "export const ShaderChunk = {};" : null),
};

export default defineConfig(({ mode }) => ({
  plugins: [ownShaders],
  logLevel: "warn",
  build: {
    target: "es2022",
    outDir: `dist/${mode}`,
    lib: { entry: `src/${mode}.ts`, formats: ["iife"], name: "yellowironPage", fileName: () => "bundle.js" },
    rolldownOptions: { output: { postBanner: `/*!\nthree.js, ${licence}\n*/`, comments: { legal: false } } },
  },
}));
