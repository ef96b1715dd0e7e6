// SVGs rendered by resvg against our own PNGs of the same sheets, which stand beside them.
//
// Usage: node check_svg.mjs FILE.svg...
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";

const require = createRequire(process.env.NODE_TOOLS + "/");
const { Resvg } = require("@resvg/resvg-js");
const { PNG } = require("pngjs");

// Of 255, over the whole page, and share of pixels that differ by more than a quarter. All samples have
// at most 0.008 and none; eleven tabs whose areas covered their letters made 0.4 and 0.0025.
const MOST_MEAN = 0.05;
const MOST_SHARE = 0.00005;

const svgPaths = process.argv.slice(2);
if (svgPaths.length === 0) throw new Error("no files");
for (const svgPath of svgPaths) {
  const ours = PNG.sync.read(readFileSync(svgPath.replace(/svg$/, "png")));
  const options = { background: "white", fitTo: { mode: "width", value: ours.width }, font: { loadSystemFonts: false } };
  const theirs = new Resvg(readFileSync(svgPath, "utf8"), options).render();
  // Each use of this property copies all pixels.
  const { pixels } = theirs;
  if (Math.abs(theirs.height - ours.height) > 1) {
    throw new Error(`${svgPath}: ${theirs.width} x ${theirs.height} pixels, our PNG has ${ours.width} x ${ours.height}`);
  }
  let sum = 0;
  let far = 0;
  let ink = 0;
  const count = ours.width * Math.min(ours.height, theirs.height);
  for (let at = 0; at < 4 * count; at += 4) {
    const alpha = ours.data[at + 3] / 255;
    let difference = 0;
    for (let c = 0; c < 3; c++) {
      const own = ours.data[at + c] * alpha + 255 * (1 - alpha);
      difference = Math.max(difference, Math.abs(own - pixels[at + c]));
      ink += c === 0 && own < 200;
    }
    sum += difference;
    far += difference > 64;
  }
  const [mean, share] = [sum / count, far / count];
  console.log(`${svgPath}: mean difference ${mean.toFixed(3)} of 255, ${(100 * share).toFixed(3)}% far, ${ink} dark pixels`);
  if (ink < 100 || mean > MOST_MEAN || share > MOST_SHARE) throw new Error(`${svgPath}: the pictures differ`);
}
