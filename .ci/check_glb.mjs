// A GLB by Khronos's validator: no error and no warning.
//
// Usage: node check_glb.mjs FILE.glb
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";

const require = createRequire(process.env.NODE_TOOLS + "/");
const validator = require("gltf-validator");
const report = await validator.validateBytes(new Uint8Array(readFileSync(process.argv[2])));
const { numErrors, numWarnings, messages } = report.issues;
console.log(`${numErrors} errors, ${numWarnings} warnings, ${report.info.totalTriangleCount} triangles`);
if (numErrors || numWarnings || !report.info.totalTriangleCount) {
  console.log(JSON.stringify(messages.slice(0, 10), null, 1));
  process.exit(1);
}
