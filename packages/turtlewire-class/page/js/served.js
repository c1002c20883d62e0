// The start of a page from a host. The service worker comes before everything else is loaded, since
// it may make the page load once more.

// A browser that refuses service workers may do so by never answering.
const PATIENCE_MS = 20_000;
const ISOLATION_TRIED = "lesson-isolation-tried";

/** Install the service worker; the page is loaded once more if that isolates it. */
async function prepareOffline() {
  if (!("serviceWorker" in navigator) || !isSecureContext) return;
  try {
    const isThere = await Promise.race([registered(), later(PATIENCE_MS)]);
    if (!isThere) return;
  } catch {
    return; // private windows may refuse it: the lesson works, but only with a network
  }
  if (!crossOriginIsolated && !sessionStorage.getItem(ISOLATION_TRIED)) {
    sessionStorage.setItem(ISOLATION_TRIED, "yes");
    location.reload();
    await new Promise(() => {}); // the page ends here
  }
}

const later = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** Wait until a service worker answers this page's requests. */
async function registered() {
  await navigator.serviceWorker.register("sw.js");
  await navigator.serviceWorker.ready;
  if (!navigator.serviceWorker.controller) {
    await new Promise((resolve) => {
      navigator.serviceWorker.addEventListener("controllerchange", resolve, { once: true });
    });
  }
  return true;
}

await prepareOffline();
await import("./main.js");
