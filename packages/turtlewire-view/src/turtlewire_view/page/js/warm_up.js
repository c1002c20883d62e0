// In a worker: makes the browser load its graphics driver while the page goes on.

postMessage(Boolean(new OffscreenCanvas(1, 1).getContext("webgl2")));
