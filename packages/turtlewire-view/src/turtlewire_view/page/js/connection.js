// The WebSocket to the server, opened again whenever it is lost.

import { decodePacket } from "./packets.js";

const FIRST_RETRY_MS = 250;
const LAST_RETRY_MS = 2000;

export class Connection {
  #socket = null;
  #retryMs = FIRST_RETRY_MS;
  #handlers;

  /** `handlers`: onState("live" or "lost"), onPacket(packet). */
  constructor(handlers) {
    this.#handlers = handlers;
    this.#open();
  }

  /** Send a command; says whether it went out. */
  send(command) {
    if (this.#socket?.readyState !== WebSocket.OPEN) return false;
    this.#socket.send(JSON.stringify(command));
    return true;
  }

  #open() {
    const address = new URL("live", location.href);
    address.protocol = "ws:";
    const socket = new WebSocket(address);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.#retryMs = FIRST_RETRY_MS;
      this.#handlers.onState("live");
    };
    socket.onmessage = ({ data }) => {
      if (data instanceof ArrayBuffer) this.#handlers.onPacket(decodePacket(data));
    };
    socket.onclose = () => {
      this.#handlers.onState("lost");
      setTimeout(() => this.#open(), this.#retryMs);
      this.#retryMs = Math.min(2 * this.#retryMs, LAST_RETRY_MS);
    };
    this.#socket = socket;
  }
}
