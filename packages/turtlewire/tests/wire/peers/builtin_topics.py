"""A foreign peer on the ``cyclonedds`` package.

Prints every endpoint that it discovers as one line of JSON.

Argument: how many endpoints to wait for; a limit of 20 s stands for the case that they do not come.
"""

from __future__ import annotations

import base64
import json
import sys
import time

from cyclonedds.builtin import (
    BuiltinDataReader,
    BuiltinTopicDcpsParticipant,
    BuiltinTopicDcpsPublication,
    BuiltinTopicDcpsSubscription,
)
from cyclonedds.core import InstanceState, ReadCondition, SampleState, ViewState, WaitSet
from cyclonedds.domain import DomainParticipant

ALL = ViewState.Any | InstanceState.Alive | SampleState.Any


def user_data(qos: dict) -> str:
    return base64.b64decode(qos.pop("Userdata", {}).get("data", "")).decode()


def main() -> None:
    expected = int(sys.argv[1])
    participant = DomainParticipant(int(sys.argv[2]))
    readers = {
        "writer": BuiltinDataReader(participant, BuiltinTopicDcpsPublication),
        "reader": BuiltinDataReader(participant, BuiltinTopicDcpsSubscription),
        "participant": BuiltinDataReader(participant, BuiltinTopicDcpsParticipant),
    }
    wait_set = WaitSet(participant)
    conditions = [ReadCondition(reader, ALL) for reader in readers.values()]
    for condition in conditions:
        wait_set.attach(condition)
    found = 0
    deadline = time.monotonic() + 60
    while found < expected and time.monotonic() < deadline:
        wait_set.wait(1_000_000_000)
        for kind, reader in readers.items():
            for sample in reader.take(1000):
                qos = sample.qos.asdict()
                line = {
                    "kind": kind,
                    "user_data": user_data(qos),
                    "qos": qos,
                    "key": sample.key.hex,
                }
                if kind != "participant":
                    if sample.topic_name.startswith("DCPS"):
                        continue
                    line |= {"topic": sample.topic_name, "type": sample.type_name}
                    found += 1
                print(json.dumps(line), flush=True)


main()
