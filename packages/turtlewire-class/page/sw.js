// Keeps the lesson for later, without a network, and gives its pages the two headers that let a
// page stop a loop of Python's (cross-origin isolation), which a static host seldom sends.

const CACHE = "lesson-VERSION-OF-THE-BUILD";
const HEADERS = {
  "Cross-Origin-Opener-Policy": "same-origin",
  "Cross-Origin-Embedder-Policy": "require-corp",
  "Cross-Origin-Resource-Policy": "same-origin",
};

addEventListener("install", () => skipWaiting());
addEventListener("activate", (event) => event.waitUntil(takeOver()));
addEventListener("fetch", (event) => {
  const { request } = event;
  const isOurs = request.url.startsWith(registration.scope);
  if (request.method === "GET" && isOurs) event.respondWith(answer(request));
});

async function takeOver() {
  for (const name of await caches.keys()) {
    if (name.startsWith("lesson-") && name !== CACHE) await caches.delete(name);
  }
  await clients.claim();
}

async function answer(request) {
  const cache = await caches.open(CACHE);
  const url = request.url.split(/[?#]/)[0];
  const kept = await cache.match(url);
  if (kept) return kept;
  const fresh = await fetch(url, { cache: "no-cache" });
  if (fresh.status !== 200) return fresh;
  const headers = new Headers(fresh.headers);
  for (const [name, value] of Object.entries(HEADERS)) headers.set(name, value);
  const isolated = new Response(fresh.body, { status: 200, headers });
  await cache.put(url, isolated.clone());
  return isolated;
}
