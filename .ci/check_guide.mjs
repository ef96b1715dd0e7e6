// Opens a guide as a reader would: walks all steps, ticks, reloads, moves the slider, swipes.
// No message on the console, no error, no request to anything but the file itself.
// check_guide.mjs GUIDE.html [FOLDER FOR PICTURES]
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";
import { resolve } from "node:path";

const require = createRequire(`${process.env.NODE_TOOLS}/`);
const puppeteer = require("puppeteer-core");
const [file, pictures] = process.argv.slice(2);
const address = pathToFileURL(resolve(file)).href;
const faults = [];
const expect = (holds, what) => { if (!holds) faults.push(what); };

const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM || "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"],
});
const page = await browser.newPage();
page.on("console", (message) => faults.push(`console: ${message.text()}`));
page.on("pageerror", (error) => faults.push(`error: ${error.message}`));
page.on("request", (request) => {
  if (request.url().split("#")[0] !== address) faults.push(`request: ${request.url().slice(0, 200)}`);
});
const shown = () => page.$$eval("main > .page:not([hidden])", (pages) => pages.map((p) => p.id));
// A link or a swipe is answered a little after the event: whether it is so within two seconds.
const soon = async (isSo) => {
  for (let k = 0; k < 40; k += 1) {
    if (isSo((await shown()).join())) return true;
    await new Promise((done) => setTimeout(done, 50));
  }
  return false;
};
const overflow = () => page.evaluate(() => document.documentElement.scrollWidth - innerWidth);

for (const [name, width, height] of [["phone", 390, 844], ["desktop", 1280, 800]]) {
  const isPhone = name === "phone";
  await page.setViewport({ width, height, isMobile: isPhone, hasTouch: isPhone, deviceScaleFactor: 1 });
  await page.goto(address);
  await page.evaluate(() => localStorage.clear());
  await page.goto("about:blank");
  await page.goto(address);
  expect((await shown()).join() === "cover", `${name}: the cover comes first`);
  expect((await page.evaluate(() => scrollY)) === 0, `${name}: the title is seen first`);
  const count = await page.$$eval(".step", (steps) => steps.length);
  expect(count > 0, "there are steps");
  const ids = await page.$$eval("main > .page", (pages) => pages.map((p) => p.id));
  for (const id of ids) {
    expect((await shown()).join() === id, `${name}: ${id} is shown alone`);
    expect((await overflow()) <= 0, `${name}: ${id} is ${await overflow()} px too wide`);
    const faint = await page.$$eval(`#${id} svg`, (all) => all.filter((s) => s.getBoundingClientRect().width < 20).length);
    expect(faint === 0, `${name}: ${id} has ${faint} pictures without a size`);
    if (pictures && ["cover", "parts", "step-1", "step-2", "step-4", `step-${count}`].includes(id)) {
      await page.screenshot({ path: `${pictures}/${name}-${id}.png`, fullPage: true });
    }
    if (id !== ids.at(-1)) await (ids.indexOf(id) % 2 ? page.keyboard.press("ArrowRight") : page.click("#next"));
  }
  await page.click("#next");
  expect(await page.$eval("#next", (b) => b.disabled), "there is nothing after the last page");
  // Turned by the button, which ticks, and by a key, which does not.
  const done = await page.$$eval(".tick input:checked", (all) => all.map((t) => t.dataset.step));
  expect(done.includes(String(count)) && done.length < count, `${name}: ${done} are ticked`);
  await page.keyboard.press("Home");
  expect((await shown()).join() === "cover", "Home leads to the cover");
  await page.keyboard.press("ArrowLeft");
  expect((await shown()).join() === "cover", "there is nothing before the cover");
}

// The keys that scroll a page do not turn it.
for (const key of ["PageDown", "PageUp"]) {
  await page.goto(`${address}#step-2`);
  await page.reload();
  expect((await page.evaluate(() => scrollY)) === 0, "a step begins with its title");
  await page.keyboard.press(key);
  expect((await shown()).join() === "step-2", `${key} does not turn the page`);
}
// The browser's back button turns the pages back.
await page.keyboard.press("ArrowRight");
await page.keyboard.press("ArrowRight");
await page.goBack();
expect(await soon((id) => id === "step-3"), "back leads to the page before");

// A reader goes on where they stopped, and the contents say how far each chapter is.
await page.evaluate(() => localStorage.clear());
await page.goto(`${address}#step-1`);
await page.reload();
await page.click("#next");
expect((await shown()).join() === "step-2", "one click ticks a step and turns the page");
await page.goto(`${address}#cover`);
await page.reload();
expect((await page.$eval("#resume", (link) => link.textContent)).includes("2"), "the cover leads to step 2");
await page.click("#resume");
expect(await soon((id) => id === "step-2"), "the reader goes on at step 2");
await new Promise((done) => setTimeout(done, 100));
expect((await page.evaluate(() => scrollY)) === 0, "a link leads to the title of a step");
const chapters = await page.$$eval("nav .progress", (all) => all.map((chapter) => chapter.textContent));
expect(chapters[0].includes("1") && chapters.every((text) => text !== ""), `progress of the chapters: ${chapters}`);
await page.evaluate(() => localStorage.clear());

// The slider shows every frame.
await page.goto(`${address}#cover`);
await page.reload();
const frames = await page.$eval("#cover input[type=range]", (range) => Number(range.max) + 1);
await page.focus("#cover input[type=range]");
await page.keyboard.press("End");
const last = await page.$eval("#cover .slider use", (use) => use.getAttribute("href"));
expect(last === `#frame-${frames - 1}`, `the slider ends at ${last}`);
expect(await page.$(last) !== null, `${last} exists`);
await page.keyboard.press("ArrowLeft");
const before = await page.$eval("#cover .slider use", (use) => use.getAttribute("href"));
expect(before === `#frame-${frames - 2}`, `one step back is ${before}`);

// Ticks stay, by keyboard and by click.
await page.goto(`${address}#step-1`);
await page.reload();
expect((await shown()).join() === "step-1", "the address leads to a step");
await page.focus("#step-1 .tick input");
await page.keyboard.press("Space");
await page.click("#next");
await page.click("#step-2 .tick");
await page.reload();
const ticked = await page.$$eval(".tick input:checked", (all) => all.map((t) => t.dataset.step));
expect(ticked.join() === "1,2", `after a reload ${ticked} are ticked`);
const counts = (await page.$eval("#where", (w) => w.textContent)).match(/\d+/g) ?? [];
const tickable = await page.$$eval(".tick input", (all) => all.length);
expect(counts.map(Number).sort((a, b) => a - b).join() === `2,${tickable}`, `the count is kept: ${counts}`);
expect((await shown()).join() === "step-2", "the reader stays at a step");

// Contents, and a swipe.
await page.setViewport({ width: 390, height: 844, isMobile: true, hasTouch: true });
await page.goto(`${address}#cover`);
await page.reload();
await page.click("nav summary");
await page.click("nav li:last-child a");
expect(await soon((id) => id.startsWith("step-")), "contents lead to a chapter");
const place = (await shown()).join();
const touch = await page.touchscreen.touchStart(300, 300);
await touch.move(60, 310);
await touch.end();
expect(await soon((id) => id !== place), "a swipe turns the page");

// Landmarks and names, for those who do not see it.
const tree = await page.accessibility.snapshot({ interestingOnly: false });
const roles = new Set();
const unnamed = [];
const walk = (node) => {
  roles.add(node.role);
  if (["button", "checkbox", "slider", "image"].includes(node.role) && !node.name) unnamed.push(node.role);
  (node.children || []).forEach(walk);
};
walk(tree);
for (const role of ["banner", "navigation", "main", "contentinfo"]) expect(roles.has(role), `landmark ${role}`);
expect(unnamed.length === 0, `without a name: ${unnamed}`);

if (pictures) {
  await page.setViewport({ width: 1280, height: 800 });
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: "dark" }]);
  await page.goto(`${address}#step-2`);
  await page.reload();
  await page.screenshot({ path: `${pictures}/dark-step-2.png` });
}
await page.emulateMediaType("print");
const hidden = await page.$$eval("main > .page", (all) => all.filter((p) => getComputedStyle(p).display === "none").length);
expect(hidden === 0, `${hidden} pages are not printed`);
const steps = await page.$$eval(".step", (all) => all.length);
const printed = Buffer.from(await page.pdf({ format: "A4" })).toString("latin1");
const sheets = (printed.match(/\/Type\s*\/Page[^s]/g) || []).length;
expect(sheets <= 4 + steps / 4, `${steps} steps take ${sheets} printed pages`);
if (pictures) await page.pdf({ path: `${pictures}/printed.pdf`, format: "A4" });
await browser.close();
faults.forEach((fault) => console.log(fault));
process.exit(faults.length ? 1 : 0);
