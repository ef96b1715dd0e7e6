// Keeps the page usable without a network: all of its files, and nothing else. web/build fills these in. A new version
// waits until no page of the old one is open, because their workers load files later.
const CACHE = 'tatamu-__VERSION__';
const FILES = { __FILES__ };

addEventListener('install', event => {
  // Asked for again, because a copy that the browser still has may be of another version; and by its sum, because the
  // host may be in the middle of an update. Then this version is not installed, and the next visit tries again.
  const fresh = Object.entries(FILES).map(([file, integrity]) => new Request(file, { cache: 'no-cache', integrity }));
  event.waitUntil(caches.open(CACHE).then(cache => cache.addAll(fresh)));
});

addEventListener('activate', event => {
  const old = names => names.filter(name => name.startsWith('tatamu-') && name !== CACHE);
  const clear = async () => Promise.all(old(await caches.keys()).map(name => caches.delete(name)));
  event.waitUntil(clear().then(() => clients.claim()));
});

addEventListener('fetch', event => {
  const url = new URL(event.request.url);
  if (event.request.method !== 'GET' || url.origin !== location.origin) return;
  event.respondWith(caches.match(event.request, { cacheName: CACHE, ignoreSearch: true }).then(kept => kept ?? fetch(event.request)));
});
