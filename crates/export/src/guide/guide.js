"use strict";
(() => {
  const pages = [...document.querySelectorAll("main > .page")];
  const ticks = [...document.querySelectorAll(".tick input")];
  const back = document.getElementById("back"), next = document.getElementById("next");
  const where = document.getElementById("where"), progress = document.getElementById("progress");
  const contents = document.querySelector("nav details");
  const key = "tatamu-guide-" + document.body.dataset.key;

  // Some browsers keep nothing for files, or nothing at all: the guide works all the same.
  const kept = () => { try { return JSON.parse(localStorage.getItem(key)) || []; } catch { return []; } };
  const keep = (steps) => { try { localStorage.setItem(key, JSON.stringify(steps)); } catch { /* not kept */ } };

  const count = () => {
    const done = ticks.filter((tick) => tick.checked).length;
    progress.value = done;
    const values = { done, count: ticks.length };
    where.textContent = document.body.dataset.done.replace(/\{(\w+)\}/g, (_, name) => values[name]);
  };
  const steps = kept();
  for (const tick of ticks) {
    tick.checked = steps.includes(tick.dataset.step);
    tick.addEventListener("change", () => {
      keep(ticks.filter((other) => other.checked).map((other) => other.dataset.step));
      count();
    });
  }

  let at = 0;
  const show = (index, mayFocus) => {
    at = Math.max(0, Math.min(pages.length - 1, index));
    pages.forEach((page, k) => { page.hidden = k !== at; });
    back.disabled = at === 0;
    next.disabled = at === pages.length - 1;
    history.replaceState(null, "", "#" + pages[at].id);
    scrollTo(0, 0);
    if (mayFocus) {
      const title = pages[at].querySelector("h2");
      title.tabIndex = -1;
      title.focus({ preventScroll: true });
    }
  };
  const fromAddress = () => {
    const found = pages.findIndex((page) => "#" + page.id === location.hash);
    if (found >= 0) { contents.open = false; show(found, true); }
  };
  back.addEventListener("click", () => show(at - 1, true));
  next.addEventListener("click", () => show(at + 1, true));
  addEventListener("hashchange", fromAddress);
  addEventListener("keydown", (event) => {
    if (event.altKey || event.ctrlKey || event.metaKey || event.target.matches("input[type=range]")) return;
    const moves = { ArrowRight: at + 1, PageDown: at + 1, ArrowLeft: at - 1, PageUp: at - 1, Home: 0, End: pages.length - 1 };
    if (event.key in moves) { event.preventDefault(); show(moves[event.key], true); }
  });

  let start = null;
  const main = document.querySelector("main");
  main.addEventListener("touchstart", (event) => {
    const touch = event.touches[0];
    const isOne = event.touches.length === 1 && !event.target.matches("input");
    start = isOne ? { x: touch.clientX, y: touch.clientY } : null;
  }, { passive: true });
  main.addEventListener("touchend", (event) => {
    if (!start) return;
    const touch = event.changedTouches[0], x = touch.clientX - start.x, y = touch.clientY - start.y;
    if (Math.abs(x) > 50 && Math.abs(x) > 2 * Math.abs(y)) show(at + (x < 0 ? 1 : -1), true);
    start = null;
  });

  for (const slider of document.querySelectorAll(".slider")) {
    const range = slider.querySelector("input"), frame = slider.querySelector("use");
    range.addEventListener("input", () => frame.setAttribute("href", "#frame-" + range.value));
  }

  count();
  const first = pages.findIndex((page) => "#" + page.id === location.hash);
  show(Math.max(0, first), false);
})();
