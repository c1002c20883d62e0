"""Processes: their output, their end, how they are stopped."""

import os
import re
import signal
import sys
from contextlib import suppress
from pathlib import Path

import pytest

from launch.actions import (
    EmitEvent,
    ExecuteProcess,
    GroupAction,
    LogInfo,
    OpaqueFunction,
    RegisterEventHandler,
    SetLaunchConfiguration,
    Shutdown,
    TimerAction,
)
from launch.event_handlers import OnProcessExit, OnProcessIO, OnProcessStart
from launch.events import matchers
from launch.events.process import ProcessStdin, ShutdownProcess, SignalProcess
from launch.substitutions import LaunchConfiguration

#: Say when ready, then wait for signals.
IGNORES_SIGINT = (
    "import signal, sys; signal.signal(signal.SIGINT, signal.SIG_IGN); print('ready', "
    "flush=True); signal.pause()"
)
IGNORES_BOTH = f"import signal; signal.signal(signal.SIGTERM, signal.SIG_IGN); {IGNORES_SIGINT}"
HANDLES_SIGINT = (
    "import signal\ntry: print('ready', flush=True); signal.pause()\nexcept KeyboardInterrupt: "
    "print('bye')"
)


def python(code, **options):
    return ExecuteProcess(
        cmd=[sys.executable, "-c", code], name="child", **{"output": "screen", **options}
    )


def when_ready(process, *entities):
    """Visit entities as soon as the process has said something."""
    said = []

    def answer(event):
        said.append(event.text)
        return list(entities) if len(said) == 1 else None

    return RegisterEventHandler(OnProcessIO(target_action=process, on_stdout=answer))


def log_lines(outcome, head):
    return [
        re.sub(r"pid \[?\d+\]?", "pid N", line) for line in outcome.lines if re.match(head, line)
    ]


def test_start_output_and_end(launch):
    outcome = launch(python("print('one'); print('two', end='')"))
    (name,) = {
        line.split("]")[0][1:] for line in outcome.lines if re.match(r"\[child-\d+\] ", line)
    }
    assert log_lines(outcome, rf"\[(INFO\] \[)?{name}") == [
        f"[INFO] [{name}]: process started with pid N",
        f"[{name}] one",
        f"[{name}] two",
        f"[INFO] [{name}]: process has finished cleanly [pid N",
    ]


def test_a_child_that_dies_at_once(launch):
    process = python("raise SystemExit(3)")
    outcome = launch(process)
    assert outcome.status == 0  # failures of processes do not count
    assert process.return_code == 3
    assert "exit code 3, cmd '" in outcome.text
    assert outcome.text.rstrip().endswith("raise SystemExit(3)'].")


def test_a_command_that_does_not_exist(launch):
    outcome = launch(ExecuteProcess(cmd=["no_such_program"]), LogInfo(msg="goes on"))
    assert outcome.messages == ["goes on"]
    assert (
        "exception occurred while executing process: [Errno 2] No such file or directory: "
        "'no_such_program'" in outcome.text
    )


def test_bytes_that_are_no_text(launch):
    outcome = launch(
        python("import os; os.write(1, b'a\\xff\\xfeb\\r\\nGr\\xc3\\xbc\\xc3\\x9fe\\n')")
    )
    assert [line.split("] ")[1] for line in outcome.lines if line.startswith("[child")] == [
        "a\ufffd\ufffdb",
        "Grüße",
    ]


def test_huge_lines_and_much_output(launch):
    outcome = launch(
        python("print('x' * 3_000_000); print('y' * 10); [print(i) for i in range(5000)]")
    )
    shown = [line.split("] ")[1] for line in outcome.lines if line.startswith("[child")]
    assert "".join(line for line in shown if line.startswith("x")) == "x" * 3_000_000
    assert "y" * 10 in shown
    assert shown[-5000:] == [str(number) for number in range(5000)]


def test_print_is_seen_at_once(launch):
    process = python("import signal; print('ready'); signal.pause()")
    assert launch(process, when_ready(process, Shutdown())).status == 0


def test_a_child_that_leaves_its_pipes_to_a_grandchild(launch):
    code = "import subprocess; print(subprocess.Popen(['sleep', '1000']).pid)"
    outcome = launch(python(code))
    (pid,) = (
        int(match[1])
        for line in outcome.lines
        if (match := re.match(r"\[child-\d+\] (\d+)$", line))
    )
    with suppress(ProcessLookupError):  # it has ended, unless nobody has asked for its status
        os.kill(pid, signal.SIGKILL)
    assert "process has finished cleanly" in outcome.text


def test_command_lines(launch):
    outcome = launch(
        ExecuteProcess(cmd=["echo one | tr o 0"], shell=True, output="screen"),
        ExecuteProcess(
            cmd=["echo", ["t", LaunchConfiguration("x", default="wo")]],
            output="screen",
            log_cmd=True,
            prefix="env Z=1",
        ),
        ExecuteProcess(cmd=["pwd"], cwd="/", output="screen"),
        ExecuteProcess(
            cmd=["env"], env={"ONLY": "this"}, output="screen", output_format="<{line}>"
        ),
        ExecuteProcess(
            cmd=["sh", "-c", "echo more $MORE"], additional_env={"MORE": "that"}, output="screen"
        ),
    )
    for pattern in (
        r"\[echo one .*-\d+\] 0ne",
        r"\[echo-\d+\] two",
        r"\[pwd-\d+\] /",
        r"<ONLY=this>",
        r"\[sh-\d+\] more that",
    ):
        assert any(re.fullmatch(pattern, line) for line in outcome.lines), (pattern, outcome.text)
    assert "process details: cmd='env Z=1 echo two', cwd='None'" in outcome.text


def test_prefix_for_some(launch):
    settings = [
        SetLaunchConfiguration("launch-prefix", "echo with"),
        SetLaunchConfiguration("launch-prefix-filter", "ech"),
    ]
    outcome = launch(
        *settings,
        ExecuteProcess(cmd=["echo", "a"], output="screen"),
        ExecuteProcess(cmd=["printf", "b"], output="screen"),
    )
    assert any(line.endswith("] with echo a") for line in outcome.lines)
    assert any(line.endswith("] b") for line in outcome.lines)


BOTH_STREAMS = "import sys; print('out'); print('err', file=sys.stderr)"


@pytest.mark.parametrize(
    ("output", "screen", "main_log", "own"),
    [
        ("log", ["err"], ["err", "out"], {}),
        ("screen", ["err", "out"], [], {}),
        ("both", ["err", "out"], ["err", "out"], {}),
        (
            "own_log",
            [],
            [],
            {".log": ["err", "out"], "-stdout.log": ["out"], "-stderr.log": ["err"]},
        ),
        (
            "full",
            ["err", "out"],
            ["err", "out"],
            {".log": ["err", "out"], "-stdout.log": ["out"], "-stderr.log": ["err"]},
        ),
        (
            {"stdout": "screen", "stderr": {"log", "own_log"}},
            ["out"],
            ["err"],
            {"-stderr.log": ["err"]},
        ),
    ],
)
def test_output_destinations(launch, output, screen, main_log, own):
    def ends(text):
        return sorted(
            found[1]
            for line in text.splitlines()
            if (found := re.search(r"\[child-\d+\] (out|err)$", line))
        )

    outcome = launch(python(BOTH_STREAMS, output=output))
    assert ends(outcome.text) == screen
    files = {path.name: ends(path.read_text()) for path in outcome.log_dir.iterdir()}
    assert files.pop("launch.log") == main_log
    assert {re.sub(r"^child-\d+", "", name): lines for name, lines in files.items()} == own


def test_an_output_that_does_not_exist(launch):
    assert launch(python("", output="nowhere")).error.startswith(
        "'nowhere' is not a valid standard output config i.e. one of: "
    )
    assert "is not a valid output source" in launch(python("", output={"stdin": "log"})).error
    assert (
        "is not a valid output destination" in launch(python("", output={"stdout": "paper"})).error
    )


def test_the_environment_overrides_where_output_goes(launch, monkeypatch):
    monkeypatch.setenv("OVERRIDE_LAUNCH_PROCESS_OUTPUT", "screen")
    assert "] out" in launch(python(BOTH_STREAMS, output="log")).text


def test_output_can_be_kept(launch):
    process = python(BOTH_STREAMS, cached_output=True, output="own_log")
    launch(process)
    assert (process.get_stdout(), process.get_stderr()) == (b"out\n", b"err\n")


def test_a_process_may_find_a_terminal(launch):
    code = "import sys; print([stream.isatty() for stream in (sys.stdin, sys.stdout, sys.stderr)])"
    assert "] [False, False, False]" in launch(python(code)).text
    assert (
        "] [False, True, True]" in launch(python(code, emulate_tty=True)).text
    )  # the test has no keyboard


def test_settings_of_a_group_count_for_its_processes(launch):
    code = "import sys; print('terminal' if sys.stdout.isatty() else 'pipe')"
    again = LaunchConfiguration("again", default="false")
    settings = (
        SetLaunchConfiguration("again", "true"),
        SetLaunchConfiguration("emulate_tty", "true"),
    )
    options = {"respawn": again, "respawn_max_retries": 1}
    inside, outside = python(code, **options), python(code, **options)
    text = launch(GroupAction([*settings, inside]), outside).text
    assert (text.count("] terminal"), text.count("] pipe")) == (2, 1)


@pytest.mark.parametrize(("later", "seconds"), [({}, "0.1"), ({"sigterm_timeout": "0.2"}, "0.2")])
def test_timeouts_set_after_the_start_count_before_those_of_the_group(launch, later, seconds):
    process = python(IGNORES_SIGINT)
    group = GroupAction([SetLaunchConfiguration("sigterm_timeout", "0.1"), process])
    settings = [SetLaunchConfiguration(name, value) for name, value in later.items()]
    outcome = launch(when_ready(process, Shutdown()), group, *settings)
    assert process.return_code == -signal.SIGTERM
    assert f"failed to terminate '{seconds}' seconds after receiving 'SIGINT'" in outcome.text
    assert dict(outcome.context.launch_configurations) == later


def test_an_invalid_timeout_set_after_the_start_is_reported_and_ignored(launch):
    process = python(IGNORES_SIGINT)
    before, after = (SetLaunchConfiguration("sigterm_timeout", text) for text in ("0.1", "soon"))
    outcome = launch(when_ready(process, Shutdown()), before, process, after)
    assert process.return_code == -signal.SIGTERM
    assert "sigterm_timeout, got 'soon'; using ['0.1', '5']" in outcome.text


@pytest.mark.parametrize(
    ("timeout", "error"),
    [
        ("soon", r"process\[.*-\d+\]: expected a number of seconds as sigkill_timeout, got 'soon'"),
        (LaunchConfiguration("missing"), "launch configuration 'missing' does not exist"),
    ],
)
def test_a_process_without_valid_timeouts_does_not_start(launch, timeout, error):
    process = python(IGNORES_SIGINT, sigkill_timeout=timeout)
    outcome = launch(when_ready(process, Shutdown()), process)
    assert outcome.status == 1
    assert re.fullmatch(error, outcome.error)
    assert process.process_details is None


def test_an_invalid_format_of_the_last_line_ends_the_launch(launch):
    outcome = launch(python("print('x', end='')", output_format="{nothing}"))
    assert (outcome.status, outcome.error) == (1, "'nothing'")


def test_shutdown_escalates(launch):
    polite, stubborn, deaf = (
        python(HANDLES_SIGINT),
        python(IGNORES_SIGINT, sigterm_timeout=0.05),
        python(IGNORES_BOTH, sigterm_timeout="0.05"),
    )
    deaf._settings.sigkill_timeout = stubborn.sigterm_timeout
    ready = set()

    def answer(event):
        ready.add(event.action)
        return Shutdown() if len(ready) == 3 else None

    outcome = launch(polite, stubborn, deaf, RegisterEventHandler(OnProcessIO(on_stdout=answer)))
    assert [process.return_code for process in (polite, stubborn, deaf)] == [
        0,
        -signal.SIGTERM,
        -signal.SIGKILL,
    ]
    names = [process.process_details["name"] for process in (polite, stubborn, deaf)]
    steps = [
        line for line in outcome.lines if "failed to terminate" in line or "sending signal" in line
    ]
    assert sorted(steps) == sorted(
        [f"[INFO] [{name}]: sending signal 'SIGINT' to process[{name}]" for name in names]
        + [
            f"[ERROR] [{name}]: process[{name}] failed to terminate '0.05' seconds after "
            "receiving 'SIGINT', escalating to 'SIGTERM'"
            for name in names[1:]
        ]
        + [f"[INFO] [{name}]: sending signal 'SIGTERM' to process[{name}]" for name in names[1:]]
        + [
            f"[ERROR] [{name}]: process[{name}] failed to terminate '0.05' seconds after "
            "receiving 'SIGTERM', escalating to 'SIGKILL'"
            for name in names[2:]
        ]
        + [f"[INFO] [{name}]: sending signal 'SIGKILL' to process[{name}]" for name in names[2:]]
    )
    assert outcome.status == 0


def test_single_processes_can_be_stopped_signalled_and_fed(launch):
    # Each stays until its own event comes; with the last of them the launch ends.
    stopped = python(HANDLES_SIGINT)
    signalled = python(
        "import signal\nsignal.signal(signal.SIGUSR1, lambda *_: "
        "exit(5))\nprint('ready')\nsignal.pause()"
    )
    fed = python("print('ready'); print('got', input())")
    seen = []

    def feed(context):
        event = ProcessStdin(text=b"this\n", action=fed, **fed.process_details)
        return [EmitEvent(event=event)]

    outcome = launch(
        RegisterEventHandler(OnProcessIO(target_action=fed, on_stdin=seen.append)),
        stopped,
        signalled,
        fed,
        when_ready(
            stopped,
            EmitEvent(event=ShutdownProcess(process_matcher=matchers.matches_action(stopped))),
        ),
        when_ready(
            signalled,
            EmitEvent(
                event=SignalProcess(
                    signal_number="SIGUSR1", process_matcher=lambda action: action is signalled
                )
            ),
        ),
        when_ready(fed, OpaqueFunction(function=feed)),
    )
    assert [process.return_code for process in (stopped, signalled, fed)] == [0, 5, 0]
    assert "] got this" in outcome.text
    (event,) = seen
    assert (event.from_stdin, event.from_stdout, event.from_stderr) == (True, False, False)
    assert (event.text, event.action) == (b"this\n", fed)
    assert event.pid == fed.process_details["pid"]


def test_matchers(launch):
    process = python("pass")
    launch(process)
    details = process.process_details
    assert matchers.matches_pid(details["pid"])(process)
    assert matchers.matches_name(details["name"])(process)
    assert matchers.matches_executable(Path(sys.executable).name)(process)
    assert not matchers.matches_pid(-1)(process)
    assert not matchers.matches_name("child")(python("pass"))


def test_handlers_of_start_and_end(launch):
    first, second = python("print('first')"), python("raise SystemExit(4)")
    seen = []
    outcome = launch(
        first,
        RegisterEventHandler(
            OnProcessStart(target_action=first, on_start=[LogInfo(msg="first has started")])
        ),
        RegisterEventHandler(
            OnProcessExit(target_action=first, on_exit=[LogInfo(msg="first has ended"), second])
        ),
        RegisterEventHandler(
            OnProcessExit(
                target_action=second, on_exit=lambda event, _: seen.append(event.returncode)
            )
        ),
    )
    assert outcome.messages == ["first has started", "first has ended"]
    assert seen == [4]


def test_the_end_of_a_required_process_ends_the_launch(launch):
    required, other = python("pass", on_exit=Shutdown()), python(HANDLES_SIGINT)
    handler = RegisterEventHandler(
        OnProcessIO(
            target_action=other,
            on_stdout=lambda event: required if b"ready" in event.text else None,
        )
    )
    outcome = launch(other, handler)
    name = required.process_details["name"]
    assert (
        f"[INFO] [launch]: process[{name}] was required: shutting down launched system"
        in outcome.lines
    )
    assert other.return_code == 0


def test_respawn_has_limits(launch):
    process = python("print('run')", respawn=True, respawn_max_retries=2)
    outcome = launch(process)
    assert sum(line.endswith("] run") for line in outcome.lines) == 3
    assert (
        outcome.text.count("process started with pid")
        == outcome.text.count("process has finished cleanly")
        == 3
    )


def test_the_end_of_the_launch_ends_respawns(launch):
    process = python("print('run')", respawn="true", respawn_delay=100.0)
    outcome = launch(
        process, RegisterEventHandler(OnProcessExit(target_action=process, on_exit=[Shutdown()]))
    )
    assert sum(line.endswith("] run") for line in outcome.lines) == 1


@pytest.mark.parametrize("last", [1, 2, 3])
def test_no_respawn_overtakes_the_handler_of_an_end(launch, last):
    ends = []

    def on_exit(event, _context):
        ends.append(event.pid)
        return [Shutdown()] if len(ends) == last else []

    process = python("pass", respawn=True)
    outcome = launch(
        process, RegisterEventHandler(OnProcessExit(target_action=process, on_exit=on_exit))
    )
    assert outcome.text.count("process started with pid") == len(ends) == last


def test_it_is_executed_once(launch):
    process = python("pass")
    assert "executed more than once" in launch(process, process).error


def test_no_process_starts_after_the_end(launch):
    outcome = launch(
        Shutdown(),
        TimerAction(period=0.0, actions=[python("print('never')")], cancel_on_shutdown=False),
    )
    assert "never" not in outcome.text
