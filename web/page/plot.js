// A job on a serial port of the browser: the port and the clock. What to send is decided by the session in the program.
import init, { Plotter } from './tatamu.js';

// Longest time between two looks at the port, ms.
const LOOK = 8;

/// Sends what is left of a job after `done` strokes. `tell` hears how far it is.
export async function plot(module, profile, job, done, port, tell) {
  await init({ module_or_path: module });
  const plotter = new Plotter(profile, job.bytes, new Uint32Array(job.turns), done);
  await port.open(JSON.parse(plotter.serial()));
  const writer = port.writable.getWriter();
  let reader, queued = 0, isOver = false;
  // Noise on the line ends a stream of the port, which then has another one; a port that is gone has none.
  const listen = async () => {
    for (let isOpen = true; isOpen && port.readable && !isOver;) {
      reader = port.readable.getReader();
      try {
        for (let got = await reader.read(); (isOpen = !got.done) && !isOver; got = await reader.read()) plotter.received(got.value);
      } catch {}
      reader.releaseLock();
    }
    if (!isOver) plotter.port_lost();
  };
  const listening = listen();
  // A computer that falls asleep leaves the tool on the paper.
  const awake = await navigator.wakeLock?.request('screen').catch(() => null);
  const clock = new Worker('clock.js', { type: 'module' });
  const wait = ms => new Promise(next => { clock.onmessage = next; clock.postMessage(ms); });
  const start = performance.now();
  const run = async () => {
    for (;;) {
      const step = JSON.parse(plotter.step(performance.now() - start, queued));
      tell(step);
      if (step.is_over) return step;
      if (step.send !== null) {
        const bytes = new TextEncoder().encode(step.send);
        queued += bytes.length;
        writer.write(bytes).then(() => { queued -= bytes.length; }, () => plotter.port_lost());
      } else {
        await wait(Math.min(step.wait_ms, LOOK));
      }
    }
  };
  const finish = async () => {
    const last = await run();
    isOver = true;
    clock.terminate();
    awake?.release().catch(() => {});
    // What the port does not take is not waited for.
    if (queued) writer.abort().catch(() => {});
    await reader.cancel().catch(() => {});
    await listening;
    writer.releaseLock();
    await port.close().catch(() => {});
    return last;
  };
  return { pause: () => plotter.pause(), goOn: () => plotter.go_on(), stop: () => plotter.stop(), end: finish() };
}
