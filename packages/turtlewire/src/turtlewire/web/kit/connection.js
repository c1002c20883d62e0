// The WebSocket to the server, opened again whenever it is lost.

import { decodePacket } from "./packets.js";

const FIRST_RETRY_MS = 250;
const LAST_RETRY_MS = 2000;

export class Connection {
  #socket = null;
  #retryMs = FIRST_RETRY_MS;
  #onState;
  #takers;

  /**
   * `onState("live" or "lost")` is told when that changes; `takers` holds a function for each type
   * of message.
   */
  constructor(onState, takers) {
    this.#onState = onState;
    this.#takers = takers;
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
    address.protocol = location.protocol.replace("http", "ws");
    const socket = new WebSocket(address);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.#retryMs = FIRST_RETRY_MS;
      this.#onState("live");
    };
    socket.onmessage = ({ data }) => {
      const message = typeof data === "string" ? JSON.parse(data) : decodePacket(data);
      this.#takers[message.type]?.(message);
    };
    socket.onclose = () => {
      this.#onState("lost");
      setTimeout(() => this.#open(), this.#retryMs);
      this.#retryMs = Math.min(2 * this.#retryMs, LAST_RETRY_MS);
    };
    this.#socket = socket;
  }
}
