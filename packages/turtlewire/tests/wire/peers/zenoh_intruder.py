"""Another computer's Zenoh: sends a Hello, which asks a session to connect, and says who came.

Arguments: own address, the session's address, the ports at which it may receive.
"""

import json
import socket
import sys
import threading

import zenoh

own, host, *ports = sys.argv[1:]
locator = f"tcp/{own}:7555"
configuration = {
    "mode": "peer",
    "listen": {"endpoints": [locator]},
    "scouting": {"multicast": {"enabled": False}},
}
seen = threading.Event()
with (
    zenoh.open(zenoh.Config.from_json5(json.dumps(configuration))) as session,
    socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender,
):
    tokens = session.liveliness().declare_subscriber("@ros2_lv/**", lambda _: seen.set())
    zid = bytes.fromhex(str(session.zid()).zfill(32))[::-1]
    # HELLO with locators, version 9, length of the id and "peer", id, one locator.
    hello = bytes([0x22, 9, (len(zid) - 1) << 4 | 1, *zid, 1, len(locator), *locator.encode()])
    for _ in range(5):  # a datagram may be lost
        for port in ports:
            sender.sendto(hello, (host, int(port)))
        if seen.wait(1):
            break
print("connected" if seen.is_set() else "nobody came")
