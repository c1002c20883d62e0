"""Listeners, buffers and contexts end in any order while messages arrive on Cyclone's threads.

Nothing is used after its end.
"""

import os

import pytest
from tests.needs import needs_cyclone_dds
from tests.programs import run_python

PROGRAM = """
import gc, random, sys, threading
from turtlewire import Buffer, msg, wire
from turtlewire.errors import TransformException
from turtlewire.tf.listener import QOS, TYPE_NAME, TransformListener
from turtlewire.wire.base import TypeId

ROUNDS = 60
over = threading.Event()
MALFORMED = b"\\x00\\x01\\x00\\x00\\xff\\xff\\xff\\x7f"

def messages():
    for second in range(1, 1000):
        message = msg.get_message(TYPE_NAME)()
        for number in range(random.choice([1, 1, 20])):
            transform = msg.get_message("geometry_msgs/msg/TransformStamped")()
            transform.header.frame_id, transform.child_frame_id = "world", f"frame{number}"
            transform.header.stamp.sec = second
            message.transforms.append(transform)
        yield msg.serialize(message) if second % 7 else MALFORMED

def publish():
    context = wire.open_context()
    prepared = list(messages())
    while not over.is_set():
        # A new publisher each time, because its first messages go through Python.
        node = context.create_node("publisher")
        publisher = node.create_publisher("/tf", TypeId(TYPE_NAME, msg.type_hash(TYPE_NAME)), QOS)
        for data in random.sample(prepared, 100):
            publisher.publish(data)
            over.wait(0.0003)  # at a rate, not as fast as can be
        node.close()
    context.close()

def consume(seed):
    chance = random.Random(seed)
    for _ in range(ROUNDS):
        context = wire.open_context()
        node = context.create_node("listener")

        def listening():
            buffer = Buffer()
            if chance.random() < 0.5:
                buffer.on_change(lambda: None)
            return buffer, TransformListener(buffer, node, context=context)

        pairs = [listening() for _ in range(3)]
        for _ in range(chance.randrange(20)):
            index = chance.randrange(len(pairs))
            try:
                pairs[index][0].lookup_transform("world", "frame0", timeout_ns=3_000_000)
            except TransformException:
                pass
            if chance.random() < 0.3:
                pairs[index][1].close()
            if chance.random() < 0.2:
                pairs[index] = listening()
                gc.collect()
        if chance.random() < 0.5:
            del pairs, listening
            gc.collect()
        context.close()

publisher = threading.Thread(target=publish)
consumers = [threading.Thread(target=consume, args=(seed,)) for seed in range(2)]
for thread in (publisher, *consumers):
    thread.start()
for thread in consumers:
    thread.join()
over.set()
publisher.join()
print("alive")
"""


@pytest.mark.slow
@needs_cyclone_dds
def test_everything_may_end_while_messages_arrive():
    """Freed memory is filled with rubbish, so that its use shows."""
    variables = os.environ | {
        "RMW_IMPLEMENTATION": "rmw_cyclonedds_cpp",
        "PYTHONMALLOC": "malloc",
        "MALLOC_PERTURB_": "165",
    }
    done = run_python(PROGRAM, check=False, timeout=840, env=variables)
    assert (done.returncode, done.stdout) == (0, "alive\n"), done.stderr[-2000:]
    known = ("a message on /tf was lost", "TF_OLD_DATA ignoring data from the past")
    assert [
        line for line in done.stderr.splitlines() if not any(text in line for text in known)
    ] == []
