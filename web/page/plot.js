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
  const reader = port.readable.getReader();
  let queued = 0, isOver = false;
  const listen = async () => {
    try {
      for (;;) {
        const { value, done } = await reader.read();
        if (done || isOver) break;
        plotter.received(value);
      }
    } catch {
      if (!isOver) plotter.port_lost();
    }
  };
  const listening = listen();
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
        await new Promise(next => setTimeout(next, Math.min(step.wait_ms, LOOK)));
      }
    }
  };
  const finish = async () => {
    const last = await run();
    isOver = true;
    await writer.ready.catch(() => {});
    await reader.cancel().catch(() => {});
    await listening;
    reader.releaseLock();
    writer.releaseLock();
    await port.close().catch(() => {});
    return last;
  };
  return { pause: () => plotter.pause(), goOn: () => plotter.go_on(), stop: () => plotter.stop(), end: finish() };
}
