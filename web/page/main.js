// The page: what the user sees and does. The model is made in work.js, its picture in view.js.
import { rows } from './rows.js';
import { plot } from './plot.js';
import { requestUsb } from './usb.js';

const SAMPLES = ['teddy.obj', 'rabbit.obj', 'snowman.obj', 'teapot.obj', 'bottle.obj', 'box.obj', 'gift-box.toml', 'lamp.toml', 'vase.toml'];
// Turn of the view for a drag over the window's shorter side, radians.
const DRAG = 4;
// Turn of a fold direction for a step of the wheel, degrees; with Shift the smaller one.
const STEP = [5, 1];
// Seconds that folding a component takes.
const FOLD = 1.2;
// Milliseconds that a stage may take to end by itself when it is cancelled.
const PATIENCE = 1000;

const by = id => document.getElementById(id);
const element = (name, properties = {}, ...children) => {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
};
const counted = (count, one) => `${count} ${one}${count === 1 ? '' : 's'}`;
const say = text => { by('said').textContent = text; };

// ---- The two workers.

let files = new Map();
let opened = null, state = null, kept = null, choices = null, module = null;
let work = null, number = 0;
// What the worker does beside the model, in words.
let aside = null;
const answers = new Map();

async function compiled() {
  const response = await fetch('tatamu_bg.wasm');
  const isTyped = response.headers.get('content-type')?.startsWith('application/wasm');
  return isTyped ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}

const view = new Worker('view.js', { type: 'module' });

let isReady = () => {};

// Begins with a worker, whose scenes go straight to the picture.
function hire(first = {}, moved = []) {
  const { port1, port2 } = new MessageChannel();
  work = new Worker('work.js', { type: 'module' });
  work.onmessage = heard;
  const ready = new Promise(done => { isReady = done; });
  work.postMessage({ module, scenes: port1 }, [port1]);
  view.postMessage({ ...first, scenes: port2 }, [port2, ...moved]);
  return ready;
}

function ask(call, ...args) {
  number += 1;
  work.postMessage({ call, args, id: number });
  return new Promise((done, failed) => answers.set(number, { done, failed }));
}

// Does something that may be refused; whether it was done.
function act(call, ...args) {
  return ask(call, ...args).then(() => true, error => { problem(error); return false; });
}

const heard = ({ data }) => {
  if (data.choices) {
    choices = data.choices;
    isReady();
  } else if (data.answer) {
    const { done, failed } = answers.get(data.answer);
    answers.delete(data.answer);
    if (data.error) failed(data.error); else done(data.result);
    if (data.isDead) revive();
  } else if (data.stage) {
    by('stage').textContent = data.stage;
    by('progress').removeAttribute('value');
  } else if (data.fraction !== undefined) {
    by('progress').value = data.fraction;
  } else if (data.problem) {
    problem(data.problem);
    if (data.isDead) revive();
  } else if (data.state) {
    if (data.history) kept = data.history;
    show(data.state);
    if (data.sheets) showSheets(data.sheets);
  }
};

function problem(text) {
  const place = by('work').hidden ? by('welcome-problem') : by('problem');
  place.textContent = text;
  place.hidden = false;
}

// Another worker in the place of one that cannot go on; it has the same history.
async function replace(isWanted) {
  work.terminate();
  for (const { failed } of answers.values()) failed('stopped');
  answers.clear();
  await hire();
  if (!opened) return;
  const selected = (state?.parts ?? []).filter(part => part.is_selected).map(part => part.key);
  await ask('open', [...files], opened, navigator.language, kept, selected, isWanted).catch(problem);
}
async function revive() {
  await replace(false);
  if (state) show({ ...state, is_busy: false });
  problem('There is not enough memory for this, or tatamu has a fault. Your changes are kept; the next one starts the work again.');
}

// What goes on is seen where it was asked for.
function showBusy(text = aside) {
  if (text !== aside) by('stage').textContent = text;
  aside = text;
  const place = by('work').hidden ? by('drop') : by('frame');
  // What is moved loses the keyboard.
  if (by('busy').parentElement !== place) place.append(by('busy'));
  by('busy').hidden = !aside && !state?.is_busy;
}

const compiling = compiled().catch(error => problem(`tatamu could not be loaded: ${error.message}`));
const hired = compiling.then(async made => {
  module = made;
  const canvas = by('canvas').transferControlToOffscreen();
  await hire({ module, canvas }, [canvas]);
  for (const format of choices.formats) {
    const button = element('button', {}, element('b', { textContent: format.id.replace('guide.', 'guide ') }), element('small', { textContent: format.description }));
    button.onclick = () => download(format.id);
    by('formats').append(button);
  }
  const project = element('button', {}, element('b', { textContent: 'toml' }), element('small', { textContent: 'the project file, to go on later here or with the program' }));
  project.onclick = saveProject;
  const job = element('button', {}, element('b', { textContent: 'plt gcode' }), element('small', { textContent: 'a sheet as a job for your machine' }));
  job.onclick = () => { by('downloads').open = false; by('plot').click(); };
  by('formats').prepend(project);
  by('formats').append(job);
  choices.axes.forEach((name, k) => by('axis').append(element('option', { value: k, textContent: name })));
  choices.machines.forEach(({ profile, name, port }) => {
    const option = element('option', { value: profile, textContent: name });
    option.dataset.port = port;
    by('machine').append(option);
  });
  choices.media.forEach(name => by('medium').append(element('option', { value: name, textContent: name })));
});

// ---- Opening.

const isProject = name => /\.toml$/i.test(name);
const isMesh = name => /\.(obj|stl|ply|off|gltf|glb|3mf)$/i.test(name);

// A file that waits for another one that it names, such as the mesh of a project, and the files that came with it.
let waiting = null;
const canWait = name => isProject(name) || isMesh(name);
const isArchive = name => /\.(zip|rar|7z|gz|tgz|tar)$/i.test(name);

async function take(list) {
  const given = new Map();
  try {
    for (const file of list) given.set(file.name, new Uint8Array(await file.arrayBuffer()));
  } catch {
    problem('A folder or a file cannot be read; choose the files in it.');
    return;
  }
  const names = [...given.keys()];
  const name = names.find(isProject) ?? names.find(isMesh) ?? names[0];
  if (!name) return;
  if (isArchive(name)) {
    problem(`${name} is an archive: unpack it, then choose the files that were in it.`);
    return;
  }
  if (state?.is_changed && !confirm(`Open ${name}? Unsaved changes of ${state.title} are lost.`)) return;
  // What is waited for is not opened by itself, unless it is a mesh and another one is waited for.
  if (waiting && !isProject(name)) {
    const isOpen = await open(waiting.name, new Map([...waiting.beside, ...given]));
    if (isOpen || !isMesh(name)) return;
  }
  await open(name, given);
}

async function open(name, given) {
  showBusy(`reading ${name}`);
  const isOpen = await read(name, given);
  showBusy(null);
  return isOpen;
}

async function read(name, given) {
  for (const place of [by('welcome-problem'), by('problem')]) place.textContent = '';
  by('problem').hidden = true;
  await hired;
  const all = new Map([...files, ...given]);
  try {
    await ask('open', [...all], name, navigator.language);
  } catch (error) {
    waiting = canWait(name) && error.includes('choose that file as well') ? { name, beside: given } : null;
    problem(error);
    return false;
  }
  [files, opened, waiting, state, seenSize] = [all, name, null, null, undefined];
  const isLost = by('welcome').contains(document.activeElement);
  by('welcome').hidden = true;
  by('work').hidden = by('bar').hidden = false;
  // What disappears loses the keyboard.
  if (isLost) by('new').focus();
  by('sheets').replaceChildren();
  stopPlaying();
  Object.assign(sight, { folded: 0, isMesh: false, clash: undefined, axis: undefined });
  by('folded').value = 0;
  by('mesh').checked = false;
  by('splitting').hidden = true;
  by('more').setAttribute('aria-pressed', false);
  view.postMessage({ what: 'reset' });
  measure();
  showBusy();
  return act('run');
}

by('choose').onclick = by('new').onclick = () => by('file').click();
by('file').onchange = async event => {
  await take(event.target.files);
  event.target.value = '';
};
for (const name of SAMPLES) {
  const stem = name.replace(/\.\w+$/, '');
  const picture = element('img', { src: `samples/cards/${stem}.png`, alt: '', width: 90, height: 90 });
  const button = element('button', {}, picture, stem.replace('-', ' '));
  button.onclick = async () => {
    const bytes = new Uint8Array(await (await fetch(`samples/${name}`)).arrayBuffer());
    open(name, new Map([[name, bytes]]));
  };
  by('samples').append(button);
}
addEventListener('dragover', event => { event.preventDefault(); document.body.classList.add('over'); });
addEventListener('dragleave', event => { if (!event.relatedTarget) document.body.classList.remove('over'); });
addEventListener('drop', event => {
  event.preventDefault();
  document.body.classList.remove('over');
  take(event.dataTransfer.files);
});
// A page that goes away leaves a machine with its tool down.
addEventListener('beforeunload', event => { if (state?.is_changed || live) event.preventDefault(); });

// ---- The state of the desk.

function show(now) {
  const wasBusy = state?.is_busy;
  // The model may be smaller than the mesh that was seen before.
  if (now.parts.length && !state?.parts.length) view.postMessage({ what: 'fit' });
  state = now;
  followSize();
  // A clash is of the model that it was found in.
  if (now.is_busy) sight.clash = undefined;
  by('title').textContent = now.title;
  document.title = `${now.title} – tatamu`;
  showBusy();
  if (now.is_busy && !wasBusy) {
    by('problem').hidden = true;
    say('working');
  }
  if (wasBusy && !now.is_busy && now.facts) say(`${now.title} is ready: ${counted(now.facts.components, 'component')} on ${counted(now.facts.sheets, 'sheet')}`);
  const focused = document.activeElement;
  for (const [id, label] of [['undo', now.undo], ['redo', now.redo]]) {
    by(id).disabled = !label;
    by(id).title = label ? `${id} ${label}` : '';
  }
  // The last step back leaves the keyboard with the way forth.
  if (focused.disabled && focused === by('undo')) by('redo').focus();
  if (focused.disabled && focused === by('redo')) by('undo').focus();
  const f = now.facts;
  if (wasBusy && !now.is_busy && by('plotting').open && !live) prepare();
  by('facts').textContent = f ? `${f.size} · ${counted(f.components, 'component')}, ${counted(f.pieces, 'piece')}, ${counted(f.sheets, 'sheet')} of ${f.paper} · work ${f.work}${f.order?.length > 1 ? ` · folds in the order ${f.order.join(', ')}` : ''}` : '';
  const set = component => (row, value, isGesture) => {
    stopPlaying(0);
    return act('set', row.option, JSON.stringify(value), component, isGesture);
  };
  const end = () => act('end_gesture');
  rows(by('model-rows'), now.model, set(), end);
  rows(by('paper-rows'), now.paper, set(), end);
  rows(by('sheet-rows'), now.sheets, set(), end);
  by('fit-sheets').hidden = now.exceeded_sheets === null;
  by('fit-sheets').disabled = now.is_busy;
  by('fit-sheets').textContent = `Fit the size to ${counted(now.exceeded_sheets, 'sheet')}`;
  showParts(now.parts);
  const own = now.parts.filter(part => part.is_selected);
  by('own').hidden = own.length === 0 || now.is_drawn;
  by('parts-hint').hidden = now.is_drawn;
  by('cards').disabled = now.is_drawn || !now.facts;
  by('merge').disabled = own.length < 2;
  const one = own.at(-1);
  if (one && !now.is_drawn) {
    const name = { option: 'name', label: 'Name', tip: 'printed on the pieces', kind: 'name', value: one.name };
    rows(by('own-rows'), [name, ...one.rows], (row, value, isGesture) => {
      if (row.option === 'name') return act('rename', one.key, value);
      return set(one.key)(row, value, isGesture);
    }, end);
  } else if (sight.axis !== undefined) {
    endSplit();
  }
  showNotes(now);
}

// The view follows a change of size, once the model has it.
let seenSize;
function followSize() {
  if (!state.facts) return;
  const size = state.model.find(row => row.option === '.size').value;
  if (seenSize !== undefined && seenSize !== size) view.postMessage({ what: 'fit' });
  seenSize = size;
}

function showParts(parts) {
  const list = by('parts');
  const focused = [...list.children].findIndex(option => option === document.activeElement);
  list.replaceChildren(...parts.map((part, k) => {
    const swatch = element('span', { className: 'swatch' });
    swatch.style.background = part.colour;
    const error = element('span', { className: 'right-text', textContent: state.is_drawn ? '' : `${part.error_mm.toFixed(1)} mm`, title: 'largest distance between the component and the hull of its part' });
    const option = element('div', { role: 'option', tabIndex: k === Math.max(focused, 0) ? 0 : -1 }, swatch, element('span', { textContent: part.name }), error);
    option.setAttribute('aria-selected', part.is_selected);
    option.dataset.key = part.key;
    option.onclick = event => select(part.key, event.shiftKey || event.ctrlKey || event.metaKey);
    option.onkeydown = event => {
      const to = { ArrowDown: k + 1, ArrowUp: k - 1, Home: 0, End: parts.length - 1 }[event.key];
      if (to !== undefined) { list.children[to]?.focus(); event.preventDefault(); }
      if (event.key === ' ' || event.key === 'Enter') { select(part.key, event.shiftKey); event.preventDefault(); }
    };
    return option;
  }));
  if (focused >= 0) list.children[focused]?.focus();
}

function select(key, adds) {
  act('select', key, adds || by('more').getAttribute('aria-pressed') === 'true');
}

let seenNotes = '[]';
function showNotes(now) {
  const notes = JSON.stringify(now.warnings);
  if (notes === seenNotes) return;
  seenNotes = notes;
  const isLost = by('notes').contains(document.activeElement);
  const buttons = (...list) => (list.length ? [element('div', { className: 'buttons' }, ...list)] : []);
  const button = (textContent, onclick) => element('button', { textContent, onclick });
  // Several are selected one after the other.
  const goTo = about => about.forEach((key, k) => act('select', key, k > 0));
  const showClash = async ({ clash, about }) => {
    goTo(about);
    sight.clash = clash;
    fold(await ask('moment', clash) ?? 0);
  };
  const lead = warning => {
    if (warning.clash !== null) return [button('Show it', () => showClash(warning))];
    return warning.about.length ? [button('Go to', () => goTo(warning.about))] : [];
  };
  by('notes').replaceChildren(...now.warnings.map((warning, k) => element('div', { className: 'note' }, element('p', { textContent: warning.text }), ...buttons(
    ...lead(warning),
    ...warning.remedies.map((label, r) => button(label, () => act('apply_remedy', k, r))),
  ))));
  // Whoever did what a warning advises can take it back.
  if (isLost) by('undo').focus();
}

let urls = [];
function showSheets(texts) {
  urls.forEach(url => URL.revokeObjectURL(url));
  urls = texts.map(text => URL.createObjectURL(new Blob([text], { type: 'image/svg+xml' })));
  by('sheets-title').textContent = `Sheets (${texts.length})`;
  by('sheets').replaceChildren(...urls.map((src, k) => {
    const link = element('a', { href: src, target: '_blank', title: 'opens the sheet' }, element('img', { src, alt: `Sheet ${k + 1}` }));
    return link;
  }));
}

// ---- Space.

const sight = { folded: 0, isMesh: false, hover: undefined, clash: undefined, axis: undefined, share: 0.5 };
const look = () => act('sight', { ...sight });
const steer = (azimuth, elevation, zoom = 1, x = 0, y = 0, dx = 0, dy = 0) => view.postMessage({ what: 'steer', by: [azimuth, elevation, zoom, x, y, dx, dy] });

function measure() {
  const box = by('frame').getBoundingClientRect();
  // A phone's pixels are finer than the eye.
  const ratio = Math.min(devicePixelRatio || 1, 2);
  const [width, height] = [box.width, box.height].map(n => Math.max(1, Math.round(n * ratio)));
  if (width > 1) view.postMessage({ what: 'size', width, height });
}
new ResizeObserver(measure).observe(by('frame'));

const dark = matchMedia('(prefers-color-scheme: dark)');
const paint = () => view.postMessage({ what: 'ground', rgb: dark.matches ? [38, 40, 44] : [246, 247, 249] });
dark.onchange = paint;

const picks = new Map();
view.onmessage = ({ data }) => {
  if (data.isReady) { measure(); paint(); }
  if (data.drawn) document.documentElement.dataset.drawn = data.drawn;
  if (data.asked) { picks.get(data.asked)?.(data); picks.delete(data.asked); }
};
function pick(event) {
  const box = by('frame').getBoundingClientRect();
  const ratio = Math.min(devicePixelRatio || 1, 2);
  number += 1;
  const asked = number;
  view.postMessage({ asked, at: [(event.clientX - box.left) * ratio, (event.clientY - box.top) * ratio].map(Math.floor) });
  return new Promise(done => picks.set(asked, done));
}

const canvas = by('canvas');
const fingers = new Map();
let moved = 0;
canvas.onpointerdown = event => {
  canvas.setPointerCapture(event.pointerId);
  fingers.set(event.pointerId, event);
  moved = fingers.size > 1 ? 99 : 0;
};
canvas.onpointermove = event => {
  const last = fingers.get(event.pointerId);
  if (!last) return;
  const side = Math.min(canvas.clientWidth, canvas.clientHeight);
  const [dx, dy] = [event.clientX - last.clientX, event.clientY - last.clientY].map(d => d / side);
  moved += Math.hypot(dx, dy) * side;
  const other = [...fingers.values()].find(finger => finger.pointerId !== event.pointerId);
  if (other) {
    const apart = finger => Math.hypot(finger.clientX - other.clientX, finger.clientY - other.clientY);
    steer(0, 0, apart(event) / Math.max(apart(last), 1), 0, 0, dx / 2, -dy / 2);
  } else if (event.buttons & 6 || event.shiftKey) {
    steer(0, 0, 1, 0, 0, dx, -dy);
  } else {
    steer(-dx * DRAG, dy * DRAG);
  }
  fingers.set(event.pointerId, event);
};
canvas.onpointerup = async event => {
  fingers.delete(event.pointerId);
  if (moved > 5) return;
  const { part } = await pick(event);
  select(state?.parts[part]?.key, event.shiftKey || event.ctrlKey || event.metaKey);
};
canvas.onpointercancel = event => fingers.delete(event.pointerId);
canvas.oncontextmenu = event => event.preventDefault();

let ending = 0;
function turn(part, degrees) {
  stopPlaying(0);
  act('turn', part, degrees);
  clearTimeout(ending);
  ending = setTimeout(() => act('end_gesture'), 1000);
}
let rest = 0;
canvas.addEventListener('wheel', async event => {
  event.preventDefault();
  const box = by('frame').getBoundingClientRect();
  const side = Math.min(box.width, box.height);
  const at = [(event.clientX - box.left - box.width / 2) / side, -(event.clientY - box.top - box.height / 2) / side];
  const steps = -(event.deltaY + event.deltaX) / (event.deltaMode === 0 ? 100 : 3);
  const { part } = await pick(event);
  if (!event.ctrlKey && state?.parts[part]?.is_selected && !state.is_drawn) {
    rest += steps;
    const whole = Math.trunc(rest);
    rest -= whole;
    if (whole) turn(part, whole * STEP[event.shiftKey ? 1 : 0]);
  } else {
    // Fingers on a touchpad come as a small wheel with Ctrl, 100 for a factor of e.
    const isPinch = event.ctrlKey && event.deltaMode === 0 && Math.abs(event.deltaY) < 50;
    steer(0, 0, (isPinch ? Math.E : 1.12) ** steps, ...at);
  }
}, { passive: false });
canvas.onkeydown = event => {
  const selected = state?.parts.findLastIndex(part => part.is_selected) ?? -1;
  const keys = {
    ArrowLeft: () => steer(0.15, 0), ArrowRight: () => steer(-0.15, 0), ArrowUp: () => steer(0, 0.15), ArrowDown: () => steer(0, -0.15),
    '+': () => steer(0, 0, 1.12), '-': () => steer(0, 0, 1 / 1.12), f: () => view.postMessage({ what: 'fit' }),
    '[': () => selected >= 0 && turn(selected, -STEP[0]), ']': () => selected >= 0 && turn(selected, STEP[0]), ' ': play,
    m: () => act('merge'), Escape: () => act('select', undefined, false),
  };
  if (!keys[event.key] || event.ctrlKey || event.metaKey) return;
  keys[event.key]();
  event.preventDefault();
};
addEventListener('keydown', event => {
  // What is written has steps of its own.
  const isText = event.target.matches('input[type=number], input[type=text]');
  const key = event.key.toLowerCase();
  if (key === 'escape' && by('downloads').open) closeDownloads();
  if (isText || !opened || by('plotting').open || !(event.ctrlKey || event.metaKey) || !['z', 'y'].includes(key)) return;
  act(key === 'y' || event.shiftKey ? 'redo' : 'undo');
  event.preventDefault();
});

let playing = 0;
function fold(folded) {
  sight.folded = folded;
  by('folded').value = folded;
  look();
}
function stopPlaying(folded) {
  cancelAnimationFrame(playing);
  playing = 0;
  by('play').setAttribute('aria-pressed', false);
  by('play').textContent = 'Fold';
  sight.clash = undefined;
  if (folded !== undefined && sight.folded !== folded) fold(folded);
}
function play() {
  if (playing) return stopPlaying();
  const [from, to] = sight.folded >= 1 ? [1, 0] : [sight.folded, 1];
  const whole = FOLD * 1000 * Math.max(state?.parts.length ?? 1, 1) * Math.abs(to - from);
  const start = performance.now();
  let isBusy = false;
  by('play').setAttribute('aria-pressed', true);
  by('play').textContent = 'Pause';
  const frame = async now => {
    const share = Math.min(Math.max((now - start) / whole, 0), 1);
    playing = requestAnimationFrame(frame);
    if (isBusy) return;
    isBusy = true;
    sight.folded = from + (to - from) * share;
    by('folded').value = sight.folded;
    await ask('sight', { ...sight }).catch(() => {});
    isBusy = false;
    if (share === 1 && playing) stopPlaying();
  };
  playing = requestAnimationFrame(frame);
}
by('play').onclick = play;
by('folded').oninput = event => { stopPlaying(); fold(Number(event.target.value)); };
by('mesh').onchange = event => { sight.isMesh = event.target.checked; look(); };
by('fit').onclick = () => view.postMessage({ what: 'fit' });

// ---- Changes.

by('undo').onclick = () => act('undo');
by('redo').onclick = () => act('redo');
by('cards').onclick = () => act('cards');
by('fit-sheets').onclick = () => { stopPlaying(0); act('fit_sheets'); };
by('merge').onclick = () => { by('more').setAttribute('aria-pressed', false); act('merge'); };
by('more').onclick = () => by('more').setAttribute('aria-pressed', by('more').getAttribute('aria-pressed') !== 'true');
by('reset').onclick = () => { const part = state.parts.findLast(own => own.is_selected); if (part) act('reset', part.key); };
function endSplit() {
  if (by('splitting').contains(document.activeElement)) by('split').focus();
  by('splitting').hidden = true;
  sight.axis = undefined;
  look();
}
function moveSplit() {
  by('splitting').hidden = false;
  Object.assign(sight, { axis: Number(by('axis').value), share: Number(by('share').value), folded: 0 });
  by('folded').value = 0;
  look();
}
by('split').onclick = () => { by('axis').value = 2; moveSplit(); };
by('axis').onchange = by('share').oninput = moveSplit;
by('split-cancel').onclick = endSplit;
by('split-here').onclick = () => { act('split', sight.axis, sight.share); endSplit(); };

// The worker hears this after the stage that it is at. One that does not end soon ends with its worker; the next
// worker goes on with the same history.
by('cancel').onclick = async () => {
  // A model that was whole while a size was searched for stays.
  const isWhole = Boolean(state?.facts?.order);
  const isHeard = ask('stop').then(() => true, () => true);
  if (!await Promise.race([isHeard, new Promise(done => setTimeout(() => done(false), PATIENCE))])) {
    await replace(isWhole);
    if (isWhole) {
      say('stopped; the model stays');
      act('run');
      return;
    }
  }
  say('stopped');
  if (!state) return;
  show({ ...state, is_busy: false });
  problem('Stopped; the next change starts it again.');
};

// ---- Files.

function save(name, parts, type = 'application/octet-stream') {
  const url = URL.createObjectURL(new Blob(parts, { type }));
  element('a', { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}
function closeDownloads() {
  const isLost = by('formats').contains(document.activeElement);
  by('downloads').open = false;
  if (isLost) by('downloads').firstElementChild.focus();
}
async function download(format) {
  closeDownloads();
  by('problem').hidden = true;
  say('writing');
  showBusy(`writing ${format}`);
  try {
    for (const file of await ask('export', format)) save(file.name, [file.bytes]);
    say('written');
  } catch (error) {
    problem(error);
  } finally {
    showBusy(null);
  }
}
async function saveProject() {
  closeDownloads();
  const name = `${state.title}.toml`;
  save(name, [await ask('save', name)], 'application/toml');
}
addEventListener('click', event => { if (!by('downloads').contains(event.target)) by('downloads').open = false; });

// ---- Machines.

let jobs = [], live = null, preparing = 0;
// The job that was stopped, and its strokes that are done.
let stopped = { bytes: '', done: 0 };
const strokesDone = () => (stopped.bytes === chosen()?.bytes ? stopped.done : 0);
const chosen = () => jobs[Number(by('job').value)];
// What of the browser reaches the machine: serial or usb.
const portOf = () => by('machine').selectedOptions[0].dataset.port;

// What is chosen last counts.
async function prepare() {
  number += 1;
  const own = (preparing = number);
  by('job-start').disabled = by('job-save').disabled = true;
  by('no-port').hidden = Boolean(navigator[portOf()]);
  by('job-status').textContent = 'preparing the job';
  try {
    const made = await ask('jobs', by('machine').value, by('medium').value);
    if (own !== preparing) return;
    const last = by('job').value;
    jobs = made;
    by('job').replaceChildren(...jobs.map((job, k) => element('option', { value: k, textContent: job.name })));
    if (last && last < jobs.length) by('job').value = last;
    ready();
  } catch (error) {
    if (own !== preparing) return;
    jobs = [];
    by('job').replaceChildren();
    by('job-note').textContent = '';
    by('job-status').textContent = error;
  }
  by('job-save').disabled = !jobs.length;
  by('job-start').disabled = !jobs.length || !navigator[portOf()];
}
function ready() {
  const done = strokesDone();
  by('job-progress').value = done ? done / chosen().strokes : 0;
  by('job-start').textContent = done ? 'Continue' : 'Start';
  by('job-note').textContent = [chosen()?.summary, ...(chosen()?.notes ?? [])].join('. ');
  by('job-status').textContent = done ? `${done} of ${chosen().strokes} strokes are done. Leave the sheet, then continue.` : 'Load the sheet, then start.';
  by('job-message').textContent = '';
}
by('plot').onclick = () => {
  by('plotting').showModal();
  if (!live) prepare();
};
by('machine').onchange = by('medium').onchange = prepare;
by('job').onchange = ready;
by('job-save').onclick = () => save(`${state.title}-${Number(by('job').value) + 1}.${chosen().extension}`, [chosen().bytes]);
by('plotting-close').onclick = () => by('plotting').close();

function follow(step) {
  by('job-progress').value = step.strokes ? step.strokes_done / step.strokes : 0;
  const left = Math.ceil(step.seconds_left);
  const time = left < 60 ? `${left} s` : `${Math.floor(left / 60)} min`;
  const text = `${step.doing}: ${step.strokes_done} of ${step.strokes} strokes, ${time} left`;
  if (by('job-status').textContent !== text) by('job-status').textContent = text;
  if (step.notes.length) by('job-message').textContent = step.notes.at(-1);
}
function during(isLive) {
  for (const id of ['machine', 'medium', 'job', 'job-start', 'plotting-close']) by(id).disabled = isLive;
  for (const id of ['job-pause', 'job-stop']) by(id).disabled = true;
  by('job-pause').textContent = 'Pause';
  by('job-stop').textContent = 'Stop';
}
by('job-start').onclick = async () => {
  const job = chosen();
  // A second click, or another job, must not reach the port while it opens.
  during(true);
  try {
    const port = portOf() === 'usb' ? await requestUsb() : await navigator.serial.requestPort();
    live = await plot(module, by('machine').value, job, strokesDone(), port, follow);
    for (const id of ['job-pause', 'job-stop']) by(id).disabled = false;
    const last = await live.end;
    stopped = { bytes: job.bytes, done: last.is_finished ? 0 : last.strokes_done };
    by('job-status').textContent = last.is_finished ? 'finished' : `${last.problem}; ${last.strokes_done} of ${last.strokes} strokes are done`;
    by('job-start').textContent = stopped.done ? 'Continue' : 'Start';
  } catch (error) {
    by('job-status').textContent = `The port cannot be used: ${error.message ?? error}`;
  }
  live = null;
  during(false);
};
by('job-pause').onclick = () => {
  const isPaused = by('job-pause').textContent === 'Go on';
  if (isPaused) live?.goOn(); else live?.pause();
  by('job-pause').textContent = isPaused ? 'Pause' : 'Go on';
};
by('job-stop').onclick = () => {
  live?.stop();
  by('job-stop').textContent = 'Stop without waiting';
};
// Escape ends a dialog in spite of all, but not the job in it.
by('plotting').addEventListener('close', () => { if (by('plotting-close').disabled) by('plotting').showModal(); });

// ---- Without a network.

if ('serviceWorker' in navigator && isSecureContext) navigator.serviceWorker.register('sw.js').catch(() => {});
