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

  const words = document.body.dataset;
  const filled = (text, values) => text.replace(/\{(\w+)\}/g, (_, name) => values[name]);
  const resume = document.getElementById("resume");
  const chapters = [...document.querySelectorAll("nav .progress")];
  const count = () => {
    const done = ticks.filter((tick) => tick.checked).length;
    progress.value = done;
    where.textContent = filled(words.done, { done, count: ticks.length });
    for (const chapter of chapters) {
      const own = ticks.slice(chapter.dataset.first - 1, chapter.dataset.last);
      const all = { done: own.filter((tick) => tick.checked).length, count: own.length };
      chapter.textContent = (all.done === all.count ? "✓ " : "") + filled(words.chapter, all);
    }
    const first = ticks.find((tick) => !tick.checked);
    resume.hidden = done === 0 || !first;
    if (first) {
      resume.textContent = filled(words.resume, { number: first.dataset.step });
      resume.href = "#step-" + first.dataset.step;
    }
  };
  const keepTicks = () => keep(ticks.filter((tick) => tick.checked).map((tick) => tick.dataset.step));
  const steps = kept();
  for (const tick of ticks) {
    tick.checked = steps.includes(tick.dataset.step);
    tick.addEventListener("change", () => {
      keepTicks();
      count();
      label();
    });
  }

  let at = 0;
  // The tick of the page that is shown, while it is not set.
  const open = () => {
    const tick = pages[at].querySelector(".tick input");
    return tick && !tick.checked ? tick : null;
  };
  const label = () => {
    next.textContent = open() ? words.doneNext : words.next;
    next.disabled = at === pages.length - 1 && !open();
  };
  const show = (index, mayFocus) => {
    at = Math.max(0, Math.min(pages.length - 1, index));
    pages.forEach((page, k) => { page.hidden = k !== at; });
    back.disabled = at === 0;
    label();
    scrollTo(0, 0);
    if (mayFocus) {
      const title = pages[at].querySelector("h2");
      title.tabIndex = -1;
      title.focus({ preventScroll: true });
    }
  };
  // Each page is a step of the browser's history, so that its back button turns the pages back.
  const go = (index) => {
    const before = at;
    show(index, true);
    if (at !== before) history.pushState(null, "", "#" + pages[at].id);
  };
  // A browser goes to the place of the address after its events; the page begins with its title.
  const toTop = () => setTimeout(() => scrollTo(0, 0));
  const fromAddress = () => {
    const found = pages.findIndex((page) => "#" + page.id === location.hash);
    if (found < 0 && location.hash) return;
    contents.open = false;
    show(Math.max(0, found), true);
    toTop();
  };
  back.addEventListener("click", () => go(at - 1));
  next.addEventListener("click", () => {
    const tick = open();
    if (tick) {
      tick.checked = true;
      keepTicks();
      count();
      label();
    }
    go(at + 1);
  });
  addEventListener("popstate", fromAddress);
  addEventListener("keydown", (event) => {
    if (event.altKey || event.ctrlKey || event.metaKey || event.target.matches("input[type=range]")) return;
    const moves = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: pages.length - 1 };
    if (event.key in moves) { event.preventDefault(); go(moves[event.key]); }
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
    if (Math.abs(x) > 50 && Math.abs(x) > 2 * Math.abs(y)) go(at + (x < 0 ? 1 : -1));
    start = null;
  });

  for (const slider of document.querySelectorAll(".slider")) {
    const range = slider.querySelector("input"), frame = slider.querySelector("use");
    range.addEventListener("input", () => frame.setAttribute("href", "#frame-" + range.value));
  }

  history.scrollRestoration = "manual";
  count();
  show(Math.max(0, pages.findIndex((page) => "#" + page.id === location.hash)), false);
  addEventListener("load", toTop);
})();
