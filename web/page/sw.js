// Keeps the page usable without a network: all of its files, and nothing else. web/build fills these in.
const CACHE = 'tatamu-__VERSION__';
const FILES = ['./', __FILES__];

addEventListener('install', event => {
  event.waitUntil(caches.open(CACHE).then(cache => cache.addAll(FILES)).then(() => skipWaiting()));
});

addEventListener('activate', event => {
  const old = names => names.filter(name => name.startsWith('tatamu-') && name !== CACHE);
  const clear = async () => Promise.all(old(await caches.keys()).map(name => caches.delete(name)));
  event.waitUntil(clear().then(() => clients.claim()));
});

addEventListener('fetch', event => {
  const url = new URL(event.request.url);
  if (event.request.method !== 'GET' || url.origin !== location.origin) return;
  event.respondWith(caches.match(event.request, { ignoreSearch: true }).then(kept => kept ?? fetch(event.request)));
});
