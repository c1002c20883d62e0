"""A DDS participant, its topics and its domain."""

from __future__ import annotations

import contextlib
import ctypes
import os
import threading
from collections.abc import Iterator

from turtlewire.errors import TurtlewireError, WireError
from turtlewire.wire import names
from turtlewire.wire.environment import Range, discovery
from turtlewire.wire.graph import format_user_data
from turtlewire.wire.loopback import ANY_PORT, bind_to_loopback, open_sockets

from . import library as dds
from .configuration import domain_configuration, stays_on_loopback
from .log import CycloneLog
from .ports import max_processes, ports_of, processes_on_host
from .samples import sertype_of

# An opaque type for the default serializer: a struct of at least one byte, without keys. All bytes
# of a sample are kept as they are.
_ADR, _TYPE_1BY, _RTS = 0x01 << 24, 0x01 << 16, 0x00
_OPS = (ctypes.c_uint32 * 3)(_ADR | _TYPE_1BY, 0, _RTS)
_NO_OPTIMIZE, _RESTRICT_DATA_REPRESENTATION = 1 << 0, 1 << 7
_XCDR1 = 1 << 0

#: Files that must be free before a domain is made: it takes 6 and one or two for each network
#: interface, the log takes 2, and some are for the program.
_FILES = 24


class _Domains:
    """The Cyclone domains of this process; a domain ends with the last participant in it."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._users: dict[int, int] = {}
        self._handles: dict[int, int] = {}
        self._process = os.getpid()
        self._log: CycloneLog | None = None
        self._keeps_library = False

    def join(self, domain_id: int) -> None:
        """Make the domain, unless it exists."""
        with self._lock:
            self._notice_fork()
            if not self._users.get(domain_id):
                self._create(domain_id)
                self._keep_library()
            self._users[domain_id] = self._users.get(domain_id, 0) + 1

    def _notice_fork(self) -> None:
        """A forked child has none of Cyclone's threads, and Cyclone would wait for them forever.

        A new context is of no use there.
        """
        if self._process == os.getpid():
            return
        if any(self._users.values()):
            error = WireError(
                "open a context: this process was forked from one with an open context"
            )
            raise error.with_hint(
                "Start processes with subprocess or multiprocessing's 'spawn', or fork before the "
                "first context."
            )
        self._process = os.getpid()
        self._log = None  # its pipe is shared with the parent

    def _create(self, domain_id: int) -> None:
        _require_files(domain_id)
        if self._log is None:
            self._log = CycloneLog()
        chosen, former = discovery(), open_sockets()
        with self._log.capturing():
            handle = dds.create_domain(domain_id, domain_configuration(domain_id, chosen).encode())
        if handle == dds.RETCODE_PRECONDITION_NOT_MET:
            return  # other code of this process made the domain, and ends it
        if handle < 0:
            raise _failure(handle, domain_id, self._log.unread())
        self._handles[domain_id] = handle
        if stays_on_loopback(chosen):
            # Without discovery Cyclone takes any ports.
            is_off = chosen.range == Range.OFF
            bind_to_loopback(former, ANY_PORT if is_off else ports_of(domain_id))
        self._log.start()

    def _keep_library(self) -> None:
        """Let Cyclone's tables outlive the domains.

        It would free them with the last domain, and crash when another thread, which still spins or
        closes something, looks a handle up at that moment. This entity is its reason not to.
        """
        if not self._keeps_library:
            dds.check(dds.create_guard_condition(dds.WHOLE_LIBRARY), "keep the library")
            self._keeps_library = True

    def leave(self, domain_id: int) -> None:
        """End the domain if it has no other participant."""
        with self._lock:
            self._users[domain_id] -= 1
            if not self._users[domain_id] and domain_id in self._handles:
                dds.delete(self._handles.pop(domain_id))
                if not self._handles and self._log is not None:
                    self._log.stop()


def _require_files(domain_id: int) -> None:
    """Make sure that the process may open the files of a domain; Cyclone 11 crashes if it may not.

    Raises:
        WireError: The limit of open files is too low.
    """
    # Opening files is the test, because the limit counts all descriptors of the process.
    opened: list[int] = []
    try:
        while len(opened) < _FILES:
            opened.append(os.open(os.devnull, os.O_RDONLY))
    except OSError as reason:
        error = WireError(f"join domain {domain_id}: {reason.strerror} ({_FILES} are needed)")
        raise error.with_hint(
            "Close files that are not needed, or allow more of them: `ulimit -n 1024` in the shell."
        ) from reason
    finally:
        for file in opened:
            os.close(file)


def _failure(code: int, domain_id: int, said: list[str]) -> TurtlewireError:
    """Return the error of a domain that could not be created: Cyclone's text and likely causes."""
    reason = "; ".join(said) or dds.return_code_text(code).decode()
    error = WireError(f"join domain {domain_id}: Cyclone DDS says {reason}")
    processes, limit = processes_on_host(domain_id), max_processes(domain_id)
    if processes is not None and processes >= limit:
        return error.with_hint(
            f"Processes of this host in the domain: {processes}; it holds {limit}. End some, or "
            "use another domain."
        )
    if os.environ.get("CYCLONEDDS_URI"):
        return error.with_hint(
            "CYCLONEDDS_URI is set: fix what Cyclone DDS reports about it, or unset it."
        )
    if "interfaces" in reason:
        return error.with_hint(
            "Is a network interface up? Nodes of one computer need the loopback one (`ip link set "
            "lo up`)."
        )
    return error


_domains = _Domains()


class Participant:
    """A participant of a domain.

    Attributes:
        handle: Cyclone's handle of it.
        gid: Its 16 bytes.
        domain_id: The domain it is in.
    """

    def __init__(self, domain_id: int, enclave: str) -> None:
        self.domain_id = domain_id
        with contextlib.ExitStack() as if_it_fails:
            _domains.join(domain_id)
            if_it_fails.callback(_domains.leave, domain_id)
            self.handle = self._create(enclave)
            if_it_fails.callback(dds.delete, self.handle)
            self.gid = dds.guid_of(self.handle)
            self._check_types()
            if_it_fails.pop_all()

    def _check_types(self) -> None:
        """Check that this build of Cyclone passes our opaque type through unchanged.

        Peers do not see this: Cyclone does not announce topics, only their readers and writers.
        """
        # A build with another layout of its structures would not fail, but send wrong bytes.
        probe = b"\x00\x01\x00\x00\x07turtle"
        with self.topic("turtlewire/check", "turtlewire/msg/Check") as topic:
            if _there_and_back(probe, sertype_of(topic)) != probe:
                raise WireError(f"{dds.LIBRARY} has an unexpected layout of types")

    def _create(self, enclave: str) -> int:
        user_data = format_user_data(enclave=enclave)
        qos = dds.create_qos()
        try:
            dds.qset_user_data(qos, user_data, len(user_data))
            return dds.check(
                dds.create_participant(self.domain_id, qos, None), f"join domain {self.domain_id}"
            )
        finally:
            dds.delete_qos(qos)

    @contextlib.contextmanager
    def topic(self, dds_topic: str, type_name: str, shared_type: int = 0) -> Iterator[int]:
        """The handle of a topic, to make readers and writers of.

        It is deleted afterwards. What was made of it keeps it alive, and the last of these to go
        ends it: names that come and go leave nothing behind.

        Args:
            dds_topic: Its name.
            type_name: The name of its type.
            shared_type: Address of a type of that name to use, and to release; 0 for a new one.
        """
        if shared_type:
            handle = self._create_topic_of(shared_type, dds_topic)
        else:
            handle = self._create_topic(dds_topic, type_name)
        try:
            yield handle
        finally:
            dds.delete(handle)

    def _create_topic(self, dds_topic: str, type_name: str) -> int:
        descriptor = dds.TopicDescriptor(
            size=1,
            align=1,
            flags=_RESTRICT_DATA_REPRESENTATION | _NO_OPTIMIZE,
            type_name=names.type_to_dds(type_name).encode(),
            op_count=len(_OPS),
            ops=ctypes.cast(_OPS, ctypes.c_void_p),
            meta=b"",
            restrict_data_representation=_XCDR1,
        )
        return dds.check(
            dds.create_topic(self.handle, descriptor, dds_topic.encode(), None, None),
            f"create topic {dds_topic}",
        )

    def _create_topic_of(self, sertype: int, dds_topic: str) -> int:
        place = ctypes.c_void_p(sertype)
        handle = dds.create_topic_of_type(self.handle, dds_topic.encode(), place, None, None, None)
        if handle < 0:  # else Cyclone has released it
            dds.release_sertype(sertype)
        return dds.check(handle, f"create topic {dds_topic}")

    def close(self) -> None:
        """Leave the domain; everything made in this participant is deleted."""
        dds.delete(self.handle)
        _domains.leave(self.domain_id)


def _there_and_back(probe: bytes, sertype: int) -> bytes:
    """Bytes that Cyclone took as a message and gave out again; none if it refused them."""
    serdata = dds.serdata_from_bytes(
        sertype, dds.SERDATA_KIND_DATA, 1, dds.IoVec(base=probe, size=len(probe)), len(probe)
    )
    if not serdata:
        return b""
    copy = bytes(dds.serdata_size(serdata))
    dds.serdata_to_bytes(serdata, 0, len(copy), copy)
    dds.serdata_unref(serdata)
    return copy
