// The picture in space. It has an instance of its own, so that it turns while the model is made.
import init, { View, part_of } from './tatamu.js';

let view, canvas, context, ground = new Uint8Array([246, 247, 249]);
let isAsked = false, smoothing = 0;

const soon = globalThis.requestAnimationFrame?.bind(globalThis) ?? (f => setTimeout(f, 16));

function draw(isSmooth) {
  const { width, height } = canvas;
  const bytes = view.draw(width, height, isSmooth, ground);
  if (bytes) context.putImageData(new ImageData(new Uint8ClampedArray(bytes.buffer), width, height), 0, 0);
}

// At once as it is, and smoothly when nothing has moved for a moment.
function ask() {
  clearTimeout(smoothing);
  smoothing = setTimeout(() => draw(true), 140);
  if (isAsked) return;
  isAsked = true;
  soon(() => {
    isAsked = false;
    const start = performance.now();
    draw(false);
    postMessage({ drawn: performance.timeOrigin + performance.now(), ms: performance.now() - start });
  });
}

const handlers = {
  scene({ numbers }) { view.show(numbers); },
  size({ width, height }) { [canvas.width, canvas.height] = [width, height]; },
  steer({ by }) { view.steer(...by); },
  ground({ rgb }) { ground = new Uint8Array(rgb); },
  fit() { view.fit(); },
  reset() { view.reset(); },
};

onmessage = async ({ data }) => {
  if (data.canvas) {
    await init({ module_or_path: data.module });
    [view, canvas] = [new View(), data.canvas];
    context = canvas.getContext('2d');
    data.scenes.onmessage = ({ data: numbers }) => { view.show(numbers); ask(); };
    postMessage({ isReady: true });
    return;
  }
  if (!view) return;
  if (data.scenes) {
    data.scenes.onmessage = ({ data: numbers }) => { view.show(numbers); ask(); };
  } else if (data.at) {
    const tag = view.tag_at(...data.at);
    postMessage({ asked: data.asked, tag, part: tag === undefined ? undefined : part_of(tag) });
  } else {
    handlers[data.what](data);
    ask();
  }
};
