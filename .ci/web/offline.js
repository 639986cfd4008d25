// Keeps the files of this folder, so that the page opens without a network from the second time on.
const KEPT = "geneva-VERSION";

self.addEventListener("install", (event) => {
  event.waitUntil(
    fetch("files.json")
      .then((response) => response.json())
      .then(async (files) => (await caches.open(KEPT)).addAll(files)),
  );
  self.skipWaiting();
});

self.addEventListener("activate", (event) => {
  const old = caches.keys().then((names) => names.filter((name) => name !== KEPT));
  event.waitUntil(old.then((names) => Promise.all(names.map((name) => caches.delete(name)))));
});

self.addEventListener("fetch", (event) => {
  event.respondWith(caches.match(event.request).then((kept) => kept ?? fetch(event.request)));
});
