// The desk: opens files, makes the model one stage at a time, and writes files. Between two stages it hears the page.
import init, { Desk, choices } from './tatamu.js';

let desk, scenes;
let sight = { folded: 0, isMesh: false };
let isRunning = false, laid = '', kept = '', reported = 0;

globalThis.tatamu = {
  stage: name => postMessage({ stage: name }),
  fraction(done) {
    // Not more often than it can be seen.
    if (performance.now() - reported < 50) return;
    reported = performance.now();
    postMessage({ fraction: done });
  },
  is_cancelled: () => false,
};

// After a trap, such as for want of memory, an instance of the program cannot go on.
const isDead = error => error instanceof WebAssembly.RuntimeError || error instanceof RangeError;
const text = error => (typeof error === 'string' ? error : String(error?.message ?? error));

function show() {
  const numbers = desk.scene(sight.folded, sight.hover, sight.isMesh, sight.clash, sight.axis, sight.share ?? 0.5);
  scenes.postMessage(numbers, [numbers.buffer]);
}

function tell() {
  const now = JSON.parse(desk.state());
  const message = { state: now };
  // Stages do not change it.
  const project = desk.project() + now.undo + now.redo + now.is_changed;
  if (project !== kept) {
    kept = project;
    message.history = desk.history();
  }
  const facts = JSON.stringify([now.facts && { ...now.facts, order: null }, now.title]);
  if (now.facts && facts + now.is_busy !== laid) {
    laid = facts + now.is_busy;
    message.sheets = desk.sheets();
  }
  postMessage(message);
}

async function run() {
  tell();
  if (isRunning) return;
  isRunning = true;
  try {
    for (let isMore = true; isMore;) {
      await new Promise(done => setTimeout(done, 0));
      isMore = desk.work();
      show();
      tell();
    }
  } catch (error) {
    postMessage({ problem: text(error), isDead: isDead(error) });
    if (!isDead(error)) tell();
  }
  isRunning = false;
  postMessage({ isIdle: true });
}

// What the page may ask for; those of the first list change the model.
const changes = ['set', 'rename', 'reset', 'apply_remedy', 'undo', 'redo', 'turn', 'cards', 'merge', 'split', 'fit_sheets'];
const calls = {
  open(files, name, locale, history, selected, isWanted) {
    const next = new Desk();
    for (const [name, bytes] of files) next.add(name, bytes);
    try {
      next.open(name, locale);
      if (history) next.go_on(history, selected);
    } catch (error) {
      // What was open before stays.
      next.free();
      throw error;
    }
    if (history && !isWanted) next.stop();
    desk?.free();
    desk = next;
    laid = kept = '';
    sight = { folded: 0, isMesh: false };
  },
  run() { show(); run(); },
  stop() { desk.stop(); tell(); },
  select(key, adds) { desk.select(key, adds); show(); tell(); },
  sight(now) { sight = now; show(); },
  export: format => desk.export(format).map(file => ({ name: file.name, bytes: file.bytes })),
  save(name) {
    const project = desk.save(name);
    tell();
    return project;
  },
  jobs: (machine, medium) => JSON.parse(desk.jobs(machine, medium)),
  moment: clash => desk.moment(clash),
  end_gesture() { desk.end_gesture(); },
};

onmessage = async ({ data }) => {
  if (data.module) {
    scenes = data.scenes;
    await init({ module_or_path: data.module });
    postMessage({ choices: JSON.parse(choices()) });
    return;
  }
  try {
    let result;
    if (changes.includes(data.call)) {
      desk[data.call](...data.args);
      run();
    } else {
      result = calls[data.call](...data.args);
    }
    postMessage({ answer: data.id, result });
  } catch (error) {
    postMessage({ answer: data.id, error: text(error), isDead: isDead(error) });
  }
};
