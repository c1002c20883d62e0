// Foxglove's own client, driven from outside: reads a command as a JSON array from each line of its
// input, prints an event as a JSON array for everything that the client reports.
//
//     node peer.mjs FOLDER_OF_NODE_MODULES URL SUBPROTOCOL

import { createRequire } from "node:module";
import { createInterface } from "node:readline";

const [folder, url, subprotocol] = process.argv.slice(2);
const require = createRequire(`${folder}/`);
const { FoxgloveClient } = require("@foxglove/ws-protocol");
const { WebSocket } = require("ws");

const print = (name, value) => console.log(JSON.stringify([name, value]));
const base64 = (view) =>
  Buffer.from(view.buffer, view.byteOffset, view.byteLength).toString("base64");
const bytes = (text) => new Uint8Array(Buffer.from(text, "base64"));

const client = new FoxgloveClient({ ws: new WebSocket(url, [subprotocol]) });
for (const name of [
  "open", "serverInfo", "status", "advertise", "unadvertise", "advertiseServices",
  "unadvertiseServices", "parameterValues", "connectionGraphUpdate", "serviceCallFailure",
]) {
  client.on(name, (event) => print(name, event ?? null));
}
client.on("error", (error) => print("error", String(error)));
client.on("close", () => {
  print("close", null);
  process.exit(0);
});
client.on("message", ({ subscriptionId, timestamp, data }) =>
  print("message", { subscriptionId, timestamp: String(timestamp), data: base64(data) }));
client.on("time", ({ timestamp }) => print("time", String(timestamp)));
client.on("serviceCallResponse", ({ serviceId, callId, encoding, data }) =>
  print("serviceCallResponse", { serviceId, callId, encoding, data: base64(data) }));
client.on("fetchAssetResponse", ({ requestId, status, error, data }) =>
  print("fetchAssetResponse", { requestId, status, error, data: data && base64(data) }));

const commands = {
  sendMessage: (channel, data) => client.sendMessage(channel, bytes(data)),
  sendServiceCallRequest: (request) =>
    client.sendServiceCallRequest({ ...request, data: bytes(request.data) }),
};
for await (const line of createInterface({ input: process.stdin })) {
  const [name, ...words] = JSON.parse(line);
  print("done", (commands[name] ?? client[name].bind(client))(...words) ?? null);
}
