// The page in a browser, as a maker uses it: a mesh is dropped and becomes files; parts are turned, merged, split;
// a job goes to a stub of a serial port; then without a network, and on a phone. And the files of the native program.
// check_web.mjs PAGE TATAMU FOLDER [FOLDER FOR PICTURES]; the files it downloads are left in FOLDER.
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createHash } from "node:crypto";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { extname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { brotliCompressSync, constants, gzipSync } from "node:zlib";

const require = createRequire(`${process.env.NODE_TOOLS}/`);
const puppeteer = require("puppeteer-core");
const { PNG } = require("pngjs");
const [root, tatamu, folder, pictures] = process.argv.slice(2).map((path) => path && resolve(path));
mkdirSync(folder, { recursive: true });
let passed = 0;
const faults = [];
const expect = (holds, what) => {
  if (holds) passed += 1; else { faults.push(what); console.log(`FAIL  ${what}`); }
};
const figure = (name, value) => console.log(`      ${name}: ${value}`);
const pause = (ms) => new Promise((done) => setTimeout(done, ms));

// ---- The same files as the native program's.

const door = await import(pathToFileURL(join(root, "tatamu.js")));
globalThis.tatamu = { stage() {}, fraction() {}, is_cancelled: () => false };
const wasm = readFileSync(join(root, "tatamu_bg.wasm"));
door.initSync({ module: wasm });
const native = join(folder, "native");
mkdirSync(native, { recursive: true });

const run = (locale, ...words) => execFileSync(tatamu, words, { stdio: "pipe", env: { ...process.env, LC_ALL: locale } });
const made = (sample, locale = "de-DE") => {
  const desk = new door.Desk();
  desk.add(sample, readFileSync(join("samples", sample)));
  desk.open(sample, locale);
  while (desk.work());
  return desk;
};
const FORMATS = ["svg", "dxf", "pdf", "fold", "obj", "stl", "plt"];
for (const sample of readdirSync("samples").filter((name) => /\.obj$|^(gift-box|lamp|vase)\.toml$/.test(name))) {
  const stem = sample.replace(/\.\w+$/, "");
  const outputs = FORMATS.flatMap((format) => ["-o", join(native, `${stem}.${format}`)]);
  run("de_DE.UTF-8", "make", join("samples", sample), "--quiet", ...outputs);
  const desk = made(sample);
  for (const format of FORMATS) {
    for (const file of desk.export(format)) {
      expect(readFileSync(join(native, file.name)).equals(Buffer.from(file.bytes)), `${file.name}: the same bytes as the native program`);
    }
  }
  desk.free();
}
for (const sample of ["teddy.obj", "snowman.obj", "lamp.toml"]) {
  const desk = made(sample);
  const state = JSON.parse(desk.state());
  const [file] = desk.export("fold");
  const path = join(folder, file.name);
  writeFileSync(path, file.bytes);
  execFileSync(tatamu, ["check", path, "--quiet"], { stdio: "pipe" });
  const report = join(native, "report.json");
  run("de_DE.UTF-8", "make", join("samples", sample), "--quiet", "-o", report);
  const names = JSON.parse(readFileSync(report)).components.map((part) => part.name);
  expect(state.parts.map((part) => part.name).join() === names.join(), `${sample}: the components of the native program`);
  desk.free();
}
// On the paper of another country, and in the size that takes no more sheets.
{
  const desk = made("teddy.obj", "en-US");
  const same = (what, ...words) => {
    run("en_US.UTF-8", "make", "samples/teddy.obj", "--quiet", ...words, "-o", join(native, "teddy.svg"));
    for (const file of desk.export("svg")) {
      expect(readFileSync(join(native, file.name)).equals(Buffer.from(file.bytes)), `${file.name} ${what}: the same bytes as the native program`);
    }
  };
  same("on letter");
  desk.set(".sheets_max", "2", undefined, false);
  desk.fit_sheets();
  while (desk.work());
  same("on two sheets", "--sheets-max", "2");
  desk.free();
}

// ---- The page.

const types = { ".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm", ".css": "text/css", ".svg": "image/svg+xml", ".webmanifest": "application/manifest+json", ".gif": "image/gif", ".png": "image/png" };
// What the server gives in place of a file, as in the middle of an update.
const changed = new Map();
const serve = () => new Promise((done) => {
  const server = createServer((request, response) => {
    const path = join(root, decodeURIComponent(new URL(request.url, "http://x").pathname).replace(/\/$/, "/index.html"));
    if (!path.startsWith(root) || !existsSync(path)) { response.writeHead(404).end(); return; }
    response.writeHead(200, { "content-type": types[extname(path)] ?? "application/octet-stream" }).end(changed.get(path) ?? readFileSync(path));
  });
  server.listen(0, "127.0.0.1", () => done(server));
});
const server = await serve();
const address = `http://127.0.0.1:${server.address().port}/`;

const profile = join(folder, "profile");
rmSync(profile, { recursive: true, force: true });
const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM || "/usr/bin/chromium",
  userDataDir: profile,
  args: ["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run"],
});
const page = await browser.newPage();
page.on("console", (message) => faults.push(`console: ${message.text()}`));
const questions = [];
let answer = true;
page.on("dialog", (dialog) => { questions.push(dialog.message()); return answer ? dialog.accept() : dialog.dismiss(); });
page.on("pageerror", (error) => faults.push(`error: ${error.message}`));
page.on("request", (request) => {
  if (!/^(http:\/\/127\.0\.0\.1|blob:|data:)/.test(request.url())) faults.push(`request: ${request.url().slice(0, 200)}`);
});
const session = await browser.target().createCDPSession();
const downloads = join(folder, "downloads");
rmSync(downloads, { recursive: true, force: true });
mkdirSync(downloads, { recursive: true });
await session.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: downloads });

// A plotter with a buffer of 1024 bytes that answers as HP-GL says. What it gets is kept. It can have a line with noise,
// take nothing more, and be unplugged.
await page.evaluateOnNewDocument(() => {
  const got = (globalThis.got = { text: "", opened: 0 });
  const answers = { B: "1024", L: "1024", E: "0", O: "0" };
  class Port {
    async open(options) {
      got.options = options;
      got.opened += 1;
      let reading;
      const give = (text) => reading.enqueue(new TextEncoder().encode(`${text}\r`));
      const listen = () => { this.readable = new ReadableStream({ start(controller) { reading = controller; } }); };
      listen();
      got.fault = (name) => {
        const last = reading;
        if (name === "FramingError") listen(); else this.readable = null;
        last.error(new DOMException(name, name));
      };
      this.writable = new WritableStream({
        async write(bytes, controller) {
          if (got.isStuck) return new Promise((_, failed) => controller.signal.addEventListener("abort", failed));
          const text = new TextDecoder().decode(bytes);
          got.text += text;
          for (const [, letter] of text.matchAll(/\x1b\.([A-Z])/g)) if (answers[letter]) give(answers[letter]);
          if (text.includes("OI;")) give("7475A");
          if (/O[AC];/.test(text)) give("0,0,0");
        },
      });
    }
    async close() {}
  }
  Object.defineProperty(navigator, "serial", { value: { requestPort: async () => new Port() } });
  // A Silhouette, which is ready as soon as it has got something. It can be pulled out.
  const usb = (globalThis.usb = { text: "", calls: [] });
  const inputs = [];
  let waiting = null;
  const device = {
    configuration: null,
    async open() { usb.calls.push("open"); },
    async selectConfiguration(number) { this.configuration = number; },
    async claimInterface(number) { usb.calls.push(`claim ${number}`); },
    async transferOut(endpoint, bytes) {
      const text = new TextDecoder().decode(bytes);
      usb.text += text;
      if (endpoint !== 1) return { status: "stall" };
      // A byte a millisecond.
      await new Promise((next) => setTimeout(next, bytes.length));
      for (const question of text.matchAll(/\x1b\x05/g)) inputs.push(question && "0\x03");
      waiting?.();
      return { status: "ok", bytesWritten: bytes.length };
    },
    async transferIn(endpoint, length) {
      if (endpoint !== 2 || length % 64) return { status: "babble" };
      while (!inputs.length) await new Promise((next, lost) => { waiting = next; usb.pull = () => lost(new DOMException("pulled out", "NetworkError")); });
      return { status: "ok", data: new DataView(new TextEncoder().encode(inputs.shift()).buffer) };
    },
    async close() { usb.calls.push("close"); usb.pull?.(); },
  };
  const requestDevice = async ({ filters }) => { usb.filters = filters.map(({ vendorId }) => vendorId); return device; };
  Object.defineProperty(navigator, "usb", { value: { requestDevice } });
});

const until = async (what, holds, seconds = 60) => {
  for (let k = 0; k < seconds * 20; k += 1) {
    if (await page.evaluate(holds).catch(() => false)) return true;
    await pause(50);
  }
  expect(false, `${what}, within ${seconds} s`);
  return false;
};
const isDone = () => !document.getElementById("work").hidden && document.getElementById("busy").hidden && document.getElementById("facts").textContent.includes("work");
const parts = () => page.$$eval("#parts [role=option]", (all) => all.map((option) => option.dataset.key));
const picture = (name) => pictures && page.screenshot({ path: join(pictures, `${name}.png`) });
const downloaded = async (name) => {
  for (let k = 0; k < 200; k += 1) {
    if (existsSync(join(downloads, name)) && !readdirSync(downloads).some((file) => file.endsWith(".crdownload"))) return join(downloads, name);
    await pause(50);
  }
  expect(false, `${name} is downloaded; there are ${readdirSync(downloads)}`);
  return null;
};
const download = async (label) => {
  await page.click("#downloads > summary");
  await page.evaluate((label) => [...document.querySelectorAll("#formats button")].find((button) => button.querySelector("b").textContent === label).click(), label);
};
const dropBytes = (name, bytes) => page.evaluate((name, text) => {
  const given = new DataTransfer();
  given.items.add(new File([Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0))], name));
  dispatchEvent(new DragEvent("drop", { dataTransfer: given, bubbles: true, cancelable: true }));
}, name, Buffer.from(bytes).toString("base64"));
const drop = (name) => dropBytes(name, readFileSync(join("samples", name)));
const problem = () => page.$eval("#problem", (p) => (p.hidden ? "" : p.textContent));

// As a browser of this language.
const tab = await page.createCDPSession();
const speak = async (acceptLanguage) => tab.send("Emulation.setUserAgentOverride", { userAgent: await browser.userAgent(), acceptLanguage });
const facts = () => page.$eval("#facts", (p) => p.textContent);

await page.setViewport({ width: 1360, height: 820 });
await speak("de-DE");
await page.goto(address);
await page.waitForSelector("#samples button");
await pause(600);
await picture("welcome");
await drop("teddy.obj");
const began = Date.now();
const since = () => `${((Date.now() - began) / 1000).toFixed(1)} s`;
await until("teddy is in the picture", () => document.querySelectorAll("#parts [role=option]").length > 0);
const seen = since();
await until("teddy is finished", isDone);
figure("teddy, dropped on a cold page", `in the picture after ${seen}, with sheets and folding after ${since()}`);
await pause(800);
await picture("teddy");
const names = await parts();
expect(names.length > 4, `teddy has parts: ${names}`);
expect((await page.$$("#sheets img")).length > 1, "its sheets are shown");
expect(await page.$$eval("#sheets img", (all) => all.every((image) => image.complete && image.naturalWidth > 50)), "each sheet is a picture");
expect(await page.$$eval("#model-rows label", (all) => all.length) > 6, "its settings are there");

await download("pdf");
await downloaded("teddy.pdf");
await download("json");
await downloaded("teddy.json");

// A turned direction: from the key to the picture.
const focus = async (k) => {
  await page.evaluate((k) => document.querySelectorAll("#parts [role=option]")[k].click(), k);
  await pause(500);
};
await focus(2);
const direction = () => page.$eval('[id="own-rows-component.direction"]', (input) => Number(input.value));
const before = await direction();
await until("nothing is busy", isDone);
await pause(400);
const times = [];
for (let k = 0; k < 3; k += 1) {
  times.push(await page.evaluate(async () => {
    const now = performance.timeOrigin + performance.now();
    document.getElementById("canvas").dispatchEvent(new KeyboardEvent("keydown", { key: "]", bubbles: true }));
    while (!(Number(document.documentElement.dataset.drawn) > now)) await new Promise((next) => setTimeout(next, 4));
    return performance.timeOrigin + performance.now() - now;
  }));
  await until("the turned model is finished", isDone);
  await pause(400);
}
figure("a turned direction, to the picture", times.map((ms) => `${ms.toFixed(0)} ms`).join(", "));
expect(Math.abs((await direction()) - before - 15) < 0.11 || Math.abs(Math.abs((await direction()) - before - 15) - 360) < 0.11, `turned from ${before} to ${await direction()}`);
await picture("turned");

// A merge, undone.
await focus(0);
await page.evaluate(() => document.querySelectorAll("#parts [role=option]")[1].dispatchEvent(new MouseEvent("click", { shiftKey: true, bubbles: true })));
await until("two are selected", () => !document.getElementById("merge").disabled);
await page.click("#merge");
await pause(300);
await until("the merged model is finished", isDone);
expect((await parts()).length === names.length - 1, `merged: ${await parts()}`);
await page.click("#undo");
await pause(300);
await until("the merge is undone", isDone);
expect((await parts()).join() === names.join(), `undone: ${await parts()}`);

// A split, and another name.
await focus(0);
await page.click("#split");
await pause(300);
await picture("split");
await page.click("#split-here");
await pause(300);
await until("the split model is finished", isDone);
expect((await parts()).length === names.length + 1, `split: ${await parts()}`);
await focus(0);
await page.$eval("#own-rows-name", (input) => { input.value = "tummy"; input.dispatchEvent(new Event("change")); });
await pause(300);
await until("the renamed model is finished", isDone);
expect(await page.$eval("#parts [role=option]", (option) => option.textContent.includes("tummy")), "a part has another name");

// Folding, half way.
await page.$eval("#folded", (input) => { input.value = 0.5; input.dispatchEvent(new Event("input")); });
await pause(600);
await picture("half");

// The project goes to the native program, and comes back.
await download("toml");
const project = await downloaded("teddy.toml");
if (project) {
  writeFileSync(join(downloads, "teddy.obj"), readFileSync("samples/teddy.obj"));
  execFileSync(tatamu, ["make", project, "--quiet", "-o", join(downloads, "again.svg"), "-o", join(downloads, "again.json")], { stdio: "pipe" });
  expect(JSON.parse(readFileSync(join(downloads, "again.json"))).components.some((part) => part.name === "tummy"), "the native program reads the project");
}
if (project) {
  await (await page.$("#file")).uploadFile(project, join(downloads, "teddy.obj"));
  await pause(500);
  await until("the project is open again", isDone);
  expect(await page.$eval("#parts [role=option]", (option) => option.textContent.includes("tummy")), "the project comes back");
}

// What is open stays, where another file is none, and where the user wants to keep changes.
const title = () => page.$eval("#title", (h2) => h2.textContent);
const setSize = (mm) => page.$eval('[id="model-rows-.size"]', (input, mm) => { input.value = mm; input.dispatchEvent(new Event("change")); }, mm);
await setSize(150);
await pause(300);
await until("the smaller model is finished", isDone);
answer = false;
await drop("box.obj");
await pause(300);
expect(questions.splice(0).length === 1 && (await title()) === "teddy", `changes are kept: ${await title()}`);
answer = true;
await drop("teddy.png");
await until("a picture is no mesh", () => document.getElementById("problem").textContent.includes("teddy.png"));
expect((await title()) === "teddy", `still open: ${await title()}`);
await page.click("#undo");
await pause(300);
await until("a step is undone after a file that is none", isDone);
expect((await problem()) === "", `after a file that is none: ${await problem()}`);
questions.length = 0;

// A value that is refused gives way to the one that holds; what is in a project file is not asked about.
await setSize(-5);
await until("a size below zero is refused", () => !document.getElementById("problem").hidden);
expect(Number(await page.$eval('[id="model-rows-.size"]', (input) => input.value)) > 0, "a refused size is not left in its field");
await page.click("#redo");
await pause(300);
await until("the smaller model is finished again", isDone);
const firstProject = readFileSync(project);
rmSync(project);
await download("toml");
await downloaded("teddy.toml");
await drop("teddy.obj");
await pause(300);
await until("teddy is opened anew", isDone);
expect(questions.length === 0, `asked about saved changes: ${questions}`);
writeFileSync(project, firstProject);
await (await page.$("#file")).uploadFile(project, join(downloads, "teddy.obj"));
await pause(500);
await until("the project is open once more", isDone);

// Cancel, which keeps what can be undone.
const size = () => page.$eval('[id="model-rows-.size"]', (input) => Number(input.value));
const sized = await size();
await page.$eval('[id="model-rows-.size"]', (input) => { input.value = 230; input.dispatchEvent(new Event("change")); });
await pause(300);
await until("the larger model is finished", isDone);
await page.$eval('[id="model-rows-.size"]', (input) => { input.blur(); input.value = 240; input.dispatchEvent(new Event("change")); });
await pause(60);
if (await page.$eval("#busy", (busy) => !busy.hidden)) {
  await page.click("#cancel");
  await until("the work is stopped", () => document.getElementById("busy").hidden && document.getElementById("problem").textContent.includes("Stopped"));
  await page.$eval('[id="model-rows-.size"]', (input) => { input.value = 210; input.dispatchEvent(new Event("change")); });
  await pause(300);
  await until("the next change starts it again", isDone);
}
while (!(await page.$eval("#undo", (undo) => undo.disabled))) {
  await page.click("#undo");
  await pause(200);
  await until("a step is undone", isDone);
}
expect((await size()) === sized, `all is undone after a cancel: ${await size()} mm of ${sized} mm`);

// A size for a number of sheets: found, undone, and cancelled while it is searched for.
const sheets = async () => Number((await facts()).match(/(\d+) sheets?/)[1]);
const many = await sheets();
expect(await page.$eval("#fit-sheets", (button) => button.hidden), "there is nothing to fit while any number of sheets will do");
await page.click("#sheet-rows input[type=checkbox]");
await until("the number of sheets is exceeded", () => !document.getElementById("fit-sheets").hidden && document.getElementById("busy").hidden);
await page.$eval('[id="sheet-rows-.sheets_max"]', (input) => { input.value = 2; input.dispatchEvent(new Event("change")); });
await until("two sheets are exceeded", () => document.getElementById("fit-sheets").textContent.includes("2 sheets") && !document.getElementById("fit-sheets").disabled);
await pause(500);
await picture("sheets-max");
const fit = () => page.click("#fit-sheets");
await fit();
await until("the search is seen", () => !document.getElementById("busy").hidden && document.getElementById("fit-sheets").disabled);
await pause(300);
expect((await sheets()) === many, "the model is there while its size is searched for");
await picture("fitting");
await page.click("#cancel");
await until("the search is cancelled", isDone);
expect((await size()) === sized && (await sheets()) === many, `after a cancel: ${await size()} mm on ${await sheets()} sheets`);
const asked = Date.now();
await fit();
await until("the search is seen again", () => document.getElementById("fit-sheets").disabled && !document.getElementById("busy").hidden);
await pause(300);
await until("the size is found", isDone, 120);
figure("two sheets of teddy", `${await size()} mm instead of ${sized} mm, found in ${((Date.now() - asked) / 1000).toFixed(1)} s`);
expect((await sheets()) <= 2 && (await size()) < sized, `fitted: ${await size()} mm on ${await sheets()} sheets`);
expect(await page.$eval("#fit-sheets", (button) => button.hidden), "nothing is left to fit");
await picture("fitted");
await page.click("#undo");
await pause(300);
await until("the size is undone", isDone);
expect((await size()) === sized && (await sheets()) === many, `undone: ${await size()} mm on ${await sheets()} sheets`);

// Files that belong together are taken together or one after the other; what is none says so.
const gltf = (obj, uri) => {
  const lines = obj.split("\n").map((line) => line.trim().split(/\s+/));
  const points = lines.filter(([kind]) => kind === "v").map(([, ...point]) => point.slice(0, 3).map(Number));
  const corners = lines.filter(([kind]) => kind === "f").flatMap(([, ...face]) => {
    const at = face.map((corner) => parseInt(corner, 10) - 1);
    return at.slice(2).flatMap((last, k) => [at[0], at[k + 1], last]);
  });
  const [a, b] = [new Float32Array(points.flat()), new Uint32Array(corners)].map((numbers) => Buffer.from(numbers.buffer));
  const bound = (of) => [0, 1, 2].map((axis) => of(...points.map((point) => point[axis])));
  const text = JSON.stringify({
    asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }], buffers: [{ uri, byteLength: a.length + b.length }],
    bufferViews: [{ buffer: 0, byteOffset: 0, byteLength: a.length }, { buffer: 0, byteOffset: a.length, byteLength: b.length }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: points.length, type: "VEC3", min: bound(Math.min), max: bound(Math.max) },
      { bufferView: 1, componentType: 5125, count: corners.length, type: "SCALAR" },
    ],
  });
  return [text, Buffer.concat([a, b])];
};
const isOpen = async (name, what) => {
  await page.waitForFunction((name) => document.getElementById("title").textContent === name, { timeout: 20000 }, name).catch(() => {});
  await until(what, isDone);
  expect((await title()) === name, `${what}: ${await title()}, ${await problem()}`);
};
await dropBytes("meshes.zip", [80, 75, 3, 4]);
await until("an archive is none", () => document.getElementById("problem").textContent.includes("meshes.zip is an archive"));
const [text, data] = gltf(readFileSync("samples/box.obj", "utf8"), "its%20data.bin");
await dropBytes("a box.gltf", text);
await until("the data of a glTF file is asked for", () => document.getElementById("problem").textContent.includes("choose that file as well"));
await dropBytes("its data.bin", data);
await isOpen("a box", "a glTF file is opened with data that came later");
await dropBytes("lonely.toml", 'mesh = "b\u00e4r \u5e3d.obj"\n');
await until("the mesh of a project is asked for", () => document.getElementById("problem").textContent.endsWith("choose that file as well"));
await dropBytes("b\u00e4r \u5e3d.obj", readFileSync("samples/box.obj"));
await isOpen("lonely", "a project is opened with a mesh that came later");

// A length as it is written: with a unit, with a comma, with the arrows.
const write = async (text) => {
  await page.click('[id="model-rows-.size"]', { count: 3 });
  await page.keyboard.type(text);
  await page.keyboard.press("Enter");
  await pause(300);
  await until(`a size of ${text}`, isDone);
};
for (const [text, mm] of [["20cm", 200], ["8in", 203.2], ["150,5", 150.5], ["120", 120]]) {
  await write(text);
  expect((await size()) === mm, `${text} is ${await size()} mm`);
}
await write("tall");
expect((await size()) === 120 && (await problem()).includes("tall"), `a size that is none: ${await size()} mm, ${await problem()}`);
await page.keyboard.press("ArrowUp");
await pause(300);
await until("a step of the size", isDone);
expect((await size()) === 121, `a step larger than 120 mm: ${await size()} mm`);

// What a warning advises is done by the keyboard, and taken back; the keyboard is never lost.
const focused = () => page.evaluate(() => document.activeElement.id || document.activeElement.textContent);
const warnings = () => page.$$eval("#notes .note p", (all) => all.map((p) => p.textContent));
await write("40");
const warned = await warnings();
await page.evaluate(() => [...document.querySelectorAll("#notes button")].find((button) => button.textContent.startsWith("Size")).focus());
await page.keyboard.press("Enter");
await pause(300);
await until("the advice is followed", isDone);
expect(warned.length > 0 && !(await warnings()).includes(warned[0]) && (await size()) === 50, `after the advice: ${await size()} mm, ${await warnings()}`);
expect((await focused()) === "undo", `after the advice the keyboard is at ${await focused()}`);
await page.keyboard.press("Enter");
await pause(300);
await until("the advice is undone", isDone);
expect((await warnings()).join() === warned.join() && (await size()) === 40, `after the advice was undone: ${await size()} mm, ${await warnings()}`);
while (!(await page.$eval("#undo", (undo) => undo.disabled))) {
  await page.keyboard.press("Enter");
  await pause(300);
  await until("a step is undone by the keyboard", isDone);
}
expect((await focused()) === "redo", `after the last step back the keyboard is at ${await focused()}`);

// A plane and a fold that is played end with their file.
await focus(0);
await page.click("#split");
await page.click("#play");
await drop("bottle.obj");
await isOpen("bottle", "another file is opened in the middle of a fold");
await focus(0);
await pause(1500);
expect(await page.$eval("#folded", (folded) => folded.value === "0"), "another file is not folded");
expect(await page.$eval("#splitting", (splitting) => splitting.hidden), "another file is not split");

// Two fingers on a touchpad that come apart by a half: the model is so much larger.
const covered = async () => {
  const { width, height, data } = PNG.sync.read(Buffer.from(await (await page.$("#frame")).screenshot()));
  let count = 0;
  for (let at = 0; at < 4 * width * height; at += 4) count += Math.max(...data.subarray(at, at + 3)) - Math.min(...data.subarray(at, at + 3)) > 40;
  return count;
};
await page.evaluate(() => document.getElementById("fit").click());
await pause(500);
const small = await covered();
const [x, y] = await page.$eval("#frame", (frame) => { const { left, top, width, height } = frame.getBoundingClientRect(); return [left + width / 2, top + height / 2]; });
for (let k = 0; k < 8; k += 1) await tab.send("Input.dispatchMouseEvent", { type: "mouseWheel", x, y, deltaX: 0, deltaY: -5, modifiers: 2 });
await pause(500);
const grown = (await covered()) / small;
expect(grown > 1.7 && grown < 2.6, `a pinch on a touchpad: ${grown.toFixed(2)} times the area`);

// No words of the command line; each file is offered once.
const words = await page.$$eval("[title]", (all) => all.map((one) => one.title));
expect(words.every((tip) => !/--|LC_|Repeat it/.test(tip)), `tips: ${words.filter((tip) => /--|LC_|Repeat it/.test(tip))}`);
const offered = await page.$$eval("#formats small", (all) => all.map((one) => one.textContent));
expect(new Set(offered).size === offered.length, `offered twice: ${offered.filter((one, k) => offered.indexOf(one) !== k)}`);

// Accessible in both themes, as far as a program can tell.
const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");
const accessible = async (what) => {
  await page.evaluate(axe);
  for (const value of ["dark", "light"]) {
    await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value }]);
    await pause(400);
    const found = await page.evaluate(() => axe.run({ resultTypes: ["violations"] }));
    const serious = found.violations.filter(({ impact }) => ["serious", "critical"].includes(impact));
    expect(serious.length === 0, `axe, ${what}, ${value}: ${JSON.stringify(serious.map(({ id, nodes }) => [id, nodes.slice(0, 3).map((node) => node.html.slice(0, 120))]))}`);
    await picture(`${what}-${value}`);
  }
};
await write("40");
await write("none");
await page.evaluate(() => document.querySelectorAll("details").forEach((details) => { details.open = true; }));
await accessible("warnings");
await page.keyboard.press("Escape");
await page.evaluate(() => document.getElementById("plot").click());
await until("the jobs are there", () => document.querySelectorAll("#job option").length > 0);
await accessible("dialog");
await page.click("#plotting-close");

// The paper of the country; a project has its own everywhere.
const paper = () => page.$eval('[id="paper-rows-paper.size"]', (input) => input.value);
expect((await paper()) === "a4" && /of a4/i.test(await facts()), `in German: ${await facts()}`);
await speak("en-US");
await page.reload();
await page.waitForSelector("#samples button");
await drop("box.obj");
await until("the box is finished in America", isDone);
expect((await paper()) === "letter" && /of letter/i.test(await facts()), `in America: ${await facts()}`);
await picture("letter");
writeFileSync(join(downloads, "plain.toml"), 'mesh = "box.obj"\n');
writeFileSync(join(downloads, "box.obj"), readFileSync("samples/box.obj"));
await (await page.$("#file")).uploadFile(join(downloads, "plain.toml"), join(downloads, "box.obj"));
await pause(500);
await until("a project is finished in America", isDone);
expect((await paper()) === "a4", `a project without a paper, in America: ${await paper()}`);
await speak("de-DE");

// A job on the stub: pause, go on, stop with the tool up, continue.
const isUp = () => page.evaluate(() => /(^|;|\x1b[^;]*)PU[^;]*;?(?!.*PD)/s.test(globalThis.got.text.slice(globalThis.got.text.lastIndexOf("PD") + 1)));
await drop("box.obj");
await pause(500);
await until("the box is finished", isDone);
await page.click("#plot");
await page.select("#machine", "hp-7475a");
await page.select("#medium", "pen");
await until("the job is ready", () => !document.getElementById("job-start").disabled && document.getElementById("job-note").textContent.includes("stroke"));
expect((await page.$$("#job option")).length > 1, "each sheet is a job");
expect(await page.$eval("#job", (list) => list.value === "0"), "the first sheet is chosen");
await picture("plot");
await page.click("#job-save");
const saved = await downloaded("box-1.plt");
expect(saved && readFileSync(saved, "latin1").includes("PD"), "a job is saved as a file of its machine");
const status = () => page.$eval("#job-status", (p) => p.textContent);
await page.click("#job-start");
await until("strokes are drawn", () => /: [1-9]\d* of/.test(document.getElementById("job-status").textContent), 30);
await page.click("#job-pause");
await until("the job is paused", () => document.getElementById("job-status").textContent.startsWith("paused"), 20);
const paused = await page.evaluate(() => got.text.length);
expect(await isUp(), "the tool is up while the job is paused");
await pause(700);
const moved = await page.evaluate((from) => got.text.slice(from), paused);
expect(!moved.includes("PD"), `nothing is drawn while the job is paused: ${moved}`);
await page.click("#job-pause");
await until("the job goes on", () => document.getElementById("job-status").textContent.startsWith("sending"), 20);
await page.click("#job-stop");
await until("the job is stopped", () => document.getElementById("job-start").textContent === "Continue", 40);
expect(await isUp(), "the tool is up after a stop");
const stopped = await status();
await page.click("#job-start");
await until("the job is finished", () => document.getElementById("job-status").textContent === "finished", 120);
expect(await page.evaluate(() => got.opened === 2 && got.options.baudRate === 9600), "the port is opened as the machine needs");
figure("stopped job", stopped);

// Two clicks are one job. Noise on the line does not end it; a page that is left asks first. After a port was unplugged
// the job goes on, in a dialog that was closed as well. A port that takes nothing more is given up.
const draws = () => /: [1-9]\d* of/.test(document.getElementById("job-status").textContent);
await page.evaluate(() => { for (let k = 0; k < 2; k += 1) document.getElementById("job-start").click(); });
await until("strokes are drawn again", draws, 30);
await page.evaluate(() => got.fault("FramingError"));
await pause(300);
expect(await page.evaluate(() => got.opened === 3), `two clicks open one port: ${await page.evaluate(() => got.opened - 2)}`);
expect((await status()).startsWith("sending"), `after noise on the line: ${await status()}`);
expect(await page.evaluate(() => !dispatchEvent(new Event("beforeunload", { cancelable: true }))), "a page that plots is not left without a question");
await page.evaluate(() => got.fault("NetworkError"));
await until("a job ends with its port", () => document.getElementById("job-start").textContent === "Continue", 20);
const unplugged = await status();
await page.click("#plotting-close");
await page.click("#plot");
await until("the job can go on", () => !document.getElementById("job-start").disabled && document.getElementById("job-start").textContent === "Continue", 20);
figure("unplugged", `${unplugged}; then: ${await status()}`);
await page.click("#job-start");
await until("the job goes on after it was unplugged", draws, 30);
await page.evaluate(() => { got.isStuck = true; });
await page.evaluate(() => { for (let k = 0; k < 3; k += 1) document.getElementById("job-stop").click(); });
await until("a port that takes nothing is given up", () => document.getElementById("job-stop").disabled, 20);

// A job on a cutter on USB: all of it arrives; one that is pulled out ends, and can be cut again.
await page.select("#machine", "silhouette");
await page.select("#medium", "paper-120");
const isReady = () => !document.getElementById("job-start").disabled && document.getElementById("job-note").textContent.includes("stroke");
await until("the job for USB is ready", isReady);
await page.click("#job-start");
await until("half of the job is sent", () => usb.text.length > 1500, 30);
await page.evaluate(() => usb.pull());
await until("a job ends with its cutter", () => /the port is gone/.test(document.getElementById("job-status").textContent), 20);
await page.click("#job-start");
await until("the job on USB is finished", () => document.getElementById("job-status").textContent === "finished", 120);
const sent = await page.evaluate(() => usb);
expect(sent.calls.join() === "open,claim 0,close,open,claim 0,close", `the cutter is opened, claimed and closed: ${sent.calls}`);
expect(sent.filters.join() === "2893,14404", `the makers of cutters: ${sent.filters}`);
expect(/FN0\x03.*M[\d,.]+\x03D[\d,.]+\x03.*H\x03/s.test(sent.text), `the job arrives: ${sent.text.slice(0, 200)}`);
await page.click("#plotting-close");

// A version that is on its way to the server is not mixed with the one before; once it is whole, the next visit has it.
await until("the service worker keeps the page", () => navigator.serviceWorker.ready.then(() => Boolean(navigator.serviceWorker.controller)));
const [worker, script] = ["sw.js", "main.js"].map((name) => readFileSync(join(root, name), "utf8"));
const next = `${script}\nglobalThis.isNext = true;\n`;
const sum = `sha256-${createHash("sha256").update(next).digest("base64")}`;
changed.set(join(root, "sw.js"), worker.replace("'tatamu-", "'tatamu-next-").replace(/"main.js":"[^"]*"/, `"main.js":"${sum}"`));
const update = () => page.evaluate(async () => {
  const worker = await navigator.serviceWorker.getRegistration();
  await worker.update().catch(() => {});
  for (let k = 0; k < 200 && worker.installing; k += 1) await new Promise((next) => setTimeout(next, 50));
  return Boolean(worker.waiting);
});
expect(!(await update()), "half a version is not installed");
changed.set(join(root, "main.js"), next);
expect(await update(), "a whole version is installed");
await page.reload();
await page.waitForSelector("#samples button");
expect(await page.evaluate(() => !globalThis.isNext), "a new version waits while the page of the old one is open");
await page.goto("about:blank");
await pause(1000);
await page.goto(address);
await page.waitForSelector("#samples button");
expect(await page.evaluate(() => globalThis.isNext), "the next visit has the new version");

// Without a network; and the keyboard is not lost when the first page goes.
await new Promise((done) => { server.close(done); server.closeAllConnections(); });
await page.reload();
await page.waitForSelector("#samples button");
await page.evaluate(() => [...document.querySelectorAll("#samples button")].find((button) => button.textContent === "lamp").focus());
await page.keyboard.press("Enter");
await until("a sample is made without a network", isDone);
expect((await focused()) === "new", `after the first page the keyboard is at ${await focused()}`);

// A phone.
await page.setViewport({ width: 390, height: 844, isMobile: true, hasTouch: true, deviceScaleFactor: 2 });
// The browser loads a page anew for a phone.
await page.waitForSelector("#samples button");
await page.evaluate(() => [...document.querySelectorAll("#samples button")].find((button) => button.textContent === "snowman").click());
await until("a sample is made on a phone", isDone);
await pause(700);
// The window of a phone grows with what is too wide for it.
const overflow = () => page.evaluate(() => Math.max(document.documentElement.scrollWidth, innerWidth) - 390);
expect((await overflow()) <= 0, `the work is ${await overflow()} px too wide for a phone`);
await picture("phone");
await page.click("#downloads > summary");
const list = await page.$eval("#formats", (list) => { const { left, right } = list.getBoundingClientRect(); return [left, right]; });
expect(list[0] >= 0 && list[1] <= 390, `the list of downloads is on a phone's screen: ${list}`);
await picture("phone-downloads");
await page.keyboard.press("Escape");
expect(await page.$eval("#downloads", (menu) => !menu.open), "Escape closes the list of downloads");
await page.evaluate(() => scrollTo(0, 900));
await picture("phone-below");
await page.click("#sheet-rows input[type=checkbox]");
await until("the sheets are exceeded on a phone", () => !document.getElementById("fit-sheets").hidden && document.getElementById("busy").hidden);
await page.evaluate(() => document.getElementById("sheets-title").scrollIntoView());
await pause(300);
expect((await overflow()) <= 0, `the sheets are ${await overflow()} px too wide for a phone`);
await picture("phone-sheets");
await page.reload();
await page.waitForSelector("#samples button");
await pause(400);
expect((await overflow()) <= 0, `the first page is ${await overflow()} px too wide for a phone`);
await picture("phone-welcome");

await browser.close();
// Less than the best compression, which takes a minute.
const brotli = brotliCompressSync(wasm, { params: { [constants.BROTLI_PARAM_QUALITY]: 9, [constants.BROTLI_PARAM_LGWIN]: 24 } });
expect(brotli.length < 2.5e6, `at most 2.5 MB over the wire: ${brotli.length} bytes with brotli`);
figure("WebAssembly", `${(wasm.length / 1e6).toFixed(2)} MB, ${(gzipSync(wasm, { level: 9 }).length / 1e6).toFixed(2)} MB with gzip, ${(brotli.length / 1e6).toFixed(2)} MB with brotli`);
for (const fault of faults) console.log(`fault ${fault}`);
console.log(`${passed} passed, ${faults.length} failed`);
process.exit(faults.length ? 1 : 0);
