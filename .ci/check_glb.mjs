// glTF files as Khronos's validator sees them: no error, no warning, and something to see.
//
// Usage: NODE_TOOLS=FOLDER node check_glb.mjs FILE.glb...
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const paths = process.argv.slice(2);
const validator = createRequire(process.env.NODE_TOOLS + "/")("gltf-validator");
let faults = 0;
for (const path of paths) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(path)));
  const { numErrors, numWarnings, messages } = report.issues;
  const { animationCount, totalTriangleCount } = report.info;
  faults += numErrors + numWarnings + (totalTriangleCount ? 0 : 1);
  for (const { severity, code, message, pointer } of messages.filter((m) => m.severity < 2)) {
    console.log(`${path}: ${severity} ${code} ${message} ${pointer ?? ""}`);
  }
  console.log(
    `${path}: ${numErrors} errors, ${numWarnings} warnings, ` +
      `${totalTriangleCount} triangles, ${animationCount} animations`,
  );
}
process.exit(faults === 0 && paths.length > 0 ? 0 : 1);
