"""PyPI's zenoh-ros2-sdk, which knows the protocol from elsewhere: ``sdk.py ROLE PORT DOMAIN``."""

from __future__ import annotations

import sys

from zenoh_ros2_sdk import ROS2Publisher, ROS2ServiceClient, ROS2ServiceServer, ROS2Subscriber

ROLE, PORT, DOMAIN = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
ROUTER = {"router_ip": "127.0.0.1", "router_port": PORT, "domain_id": DOMAIN}
CHATTER = {
    "topic": "/chatter",
    "msg_type": "std_msgs/msg/String",
    "msg_definition": "string data\n",
    "node_name": f"sdk_{ROLE}",
    **ROUTER,
}
ADD = {
    "service_name": "/add",
    "srv_type": "example_interfaces/srv/AddTwoInts",
    "request_definition": "int64 a\nint64 b\n",
    "response_definition": "int64 sum\n",
    "node_name": f"sdk_{ROLE}",
    **ROUTER,
}


def main() -> None:
    if ROLE == "publisher":
        publisher = ROS2Publisher(**CHATTER)
        print(publisher.keyexpr, flush=True)
        for _ in sys.stdin:
            publisher.publish(data="from the sdk")
    elif ROLE == "subscriber":
        subscriber = ROS2Subscriber(
            callback=lambda message: print(message.data, flush=True), **CHATTER
        )
        print(subscriber.keyexpr, flush=True)
        sys.stdin.read()
    elif ROLE == "server":
        server = ROS2ServiceServer(
            callback=lambda request: server.response_msg_class(sum=request.a + request.b), **ADD
        )
        print(server.keyexpr, flush=True)
        sys.stdin.read()
    else:
        client = ROS2ServiceClient(**ADD)
        print(client.keyexpr, flush=True)
        for _ in range(3):
            response = client.call(a=20, b=22)
            print(response.sum if response else response, flush=True)
    sys.stdout.flush()


main()
