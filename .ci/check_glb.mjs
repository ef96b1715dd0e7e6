// glTF files as Khronos's validator sees them: no error and no warning.
//
// Usage: node check_glb.mjs FOLDER_OF_NODE_MODULES FILE.glb...
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

const [modules, ...paths] = process.argv.slice(2);
const validator = createRequire(join(modules, "here.js"))("gltf-validator");
let faults = 0;
for (const path of paths) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(path)));
  const { numErrors, numWarnings, messages } = report.issues;
  faults += numErrors + numWarnings;
  for (const { severity, code, message, pointer } of messages.filter((m) => m.severity < 2)) {
    console.log(`${path}: ${severity} ${code} ${message} ${pointer ?? ""}`);
  }
  console.log(`${path}: ${numErrors} errors, ${numWarnings} warnings, ${report.info.animationCount} animations`);
}
process.exit(faults === 0 && paths.length > 0 ? 0 : 1);
