"""The parameters of a node, without a node."""

import re

import pytest
from tests.golden.cli.captures import capture
from tests.places import GOLDEN

from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    ParameterValue,
    SetParametersResult,
)
from rclpy import exceptions
from rclpy._node.parameters import NodeParameters
from rclpy.parameter import Parameter
from rclpy.time import Time

Type = Parameter.Type
OK = SetParametersResult(successful=True)


class Recorder:
    """Parameters of a node `/ns/n`, and the events that they published."""

    def __init__(self, overrides=None, constructor_overrides=None, allow_undeclared=False):
        self.events = []
        self.parameters = NodeParameters(
            node_fqn="/ns/n",
            overrides=overrides or {},
            constructor_overrides=constructor_overrides,
            allow_undeclared=allow_undeclared,
            now=lambda: Time(seconds=3, nanoseconds=4),
            publish_event=self.events.append,
        )

    def names(self):
        """New, changed and deleted names of each event so far."""
        return [
            tuple(
                [each.name for each in getattr(event, f"{kind}_parameters")]
                for kind in ("new", "changed", "deleted")
            )
            for event in self.events
        ]


@pytest.fixture
def recorder():
    return Recorder()


@pytest.fixture
def parameters(recorder):
    return recorder.parameters


@pytest.fixture
def loose():
    return Recorder(allow_undeclared=True)


def values(parameters, *names):
    return [parameters.get_parameter(name).value for name in names]


def reason(parameters, name, value):
    (result,) = parameters.set_parameters([Parameter(name, value=value)])
    assert result.successful == (not result.reason)
    return result.reason


def test_declaring_and_reading(parameters):
    declared = parameters.declare_parameter("a", 1)
    assert (declared.name, declared.type_, declared.value) == ("a", Type.INTEGER, 1)
    assert parameters.get_parameter("a") is declared
    assert parameters.has_parameter("a")
    assert not parameters.has_parameter("b")
    assert parameters.get_parameter_type("a") == Type.INTEGER.value
    assert parameters.get_parameter_types(["a"]) == [2]


def test_several_declarations_with_a_namespace(parameters):
    descriptor = ParameterDescriptor(description="d")
    made = parameters.declare_parameters(
        "ns", [("a", 1), ("b.c", "x", descriptor), ("d", Type.DOUBLE)]
    )
    assert [(each.name, each.value) for each in made] == [
        ("ns.a", 1),
        ("ns.b.c", "x"),
        ("ns.d", None),
    ]
    below = parameters.get_parameters_by_prefix("ns")
    assert {name: parameter.value for name, parameter in below.items()} == {
        "a": 1,
        "b.c": "x",
        "d": None,
    }
    assert set(parameters.get_parameters_by_prefix("")) == {"ns.a", "ns.b.c", "ns.d"}


def test_a_type_alone_has_to_be_set_before_it_is_read(parameters):
    assert parameters.declare_parameter("a", Type.DOUBLE).type_ is Type.NOT_SET
    with pytest.raises(
        exceptions.ParameterUninitializedException,
        match=r"^The parameter 'a' is not initialized: a$",
    ):
        parameters.get_parameter("a")
    assert parameters.get_parameter_or("a", Parameter("a", value=7)).value == 7
    assert parameters.get_parameter_or("a").type_ is Type.NOT_SET
    assert (
        reason(parameters, "a", 1)
        == "Wrong parameter type, expected 'Type.DOUBLE' got 'Type.INTEGER'"
    )
    assert reason(parameters, "a", 1.5) == ""
    assert values(parameters, "a") == [1.5]


def test_a_name_alone_is_deprecated_and_dynamic(parameters):
    with pytest.warns(
        UserWarning,
        match="when declaring parameter named 'a', declaring a parameter only providing its name "
        "is deprecated",
    ):
        assert parameters.declare_parameter("a").type_ is Type.NOT_SET
    assert [reason(parameters, "a", value) for value in (1, "x", None)] == ["", "", ""]
    assert not parameters.has_parameter("a")


@pytest.mark.parametrize(
    ("declarations", "error", "text"),
    [
        (
            [("a", 1, ParameterDescriptor(), 4)],
            TypeError,
            "Invalid parameter tuple length at index 0 in parameters list: .* between 1 and 3",
        ),
        ([()], TypeError, "Invalid parameter tuple length at index 0"),
        (
            [("a", 1), (5, 1)],
            TypeError,
            "First element 5 at index 1 in parameters list is not a str.",
        ),
        (
            [("a", 1, "x")],
            TypeError,
            "Third element x at index 0 in parameters list is not a ParameterDescriptor.",
        ),
        (
            [("a", Type.NOT_SET)],
            ValueError,
            "Cannot declare parameter a statically to be of type NOT_SET",
        ),
        (
            [("a", Type.BOOL, ParameterDescriptor(dynamic_typing=True))],
            ValueError,
            "is not allowed when the parameter type is specified",
        ),
        ([("", 1)], exceptions.InvalidParameterException, "^Invalid parameter name: $"),
        ([("a", {})], TypeError, "The given value is not one of the allowed types '{}'."),
    ],
)
def test_bad_declarations(parameters, declarations, error, text):
    with pytest.raises(error, match=text):
        parameters.declare_parameters("", declarations)
    assert not parameters.has_parameter("a")


def test_a_default_may_be_a_message(parameters):
    value = ParameterValue(type=Type.INTEGER.value, integer_value=7)
    parameters.declare_parameter("a", value)
    assert values(parameters, "a") == [7]
    assert parameters.describe_parameter("a").type == Type.INTEGER.value
    with pytest.raises(ValueError, match=r"statically typed parameter .* PARAMETER_NOT_SET"):
        parameters.declare_parameter("b", ParameterValue())
    dynamic = ParameterDescriptor(dynamic_typing=True)
    parameters.declare_parameter("c", ParameterValue(), dynamic)
    assert parameters.get_parameter("c").type_ is Type.NOT_SET


@pytest.mark.parametrize("setter", ["set_parameters", "set_parameters_atomically"])
def test_set_requires_a_parameter(parameters, setter):
    with pytest.raises(TypeError, match=r"^parameter must be instance of type '<class 'rclpy.par"):
        getattr(parameters, setter)([42])


def test_nothing_is_declared_twice(parameters):
    parameters.declare_parameter("a", 1)
    with pytest.raises(exceptions.ParameterAlreadyDeclaredException) as caught:
        parameters.declare_parameters("", [("b", 1), ("a", 2)])
    assert str(caught.value) == "Parameter(s) already declared: ['a']"
    assert not parameters.has_parameter("b")
    assert values(parameters, "a") == [1]


def test_overrides():
    recorder = Recorder({"a": 5, "b": 6, "c": 7, "ns.d": 8}, [Parameter("b", value=60)])
    parameters = recorder.parameters
    parameters.declare_parameter("a", 1)
    parameters.declare_parameter("b", 1)
    parameters.declare_parameter("c", 1, ignore_override=True)
    parameters.declare_parameters("ns", [("d", Type.INTEGER)])
    assert values(parameters, "a", "b", "c", "ns.d") == [5, 60, 1, 8]


def test_an_override_of_another_type():
    parameters = Recorder({"a": 2}).parameters
    with pytest.raises(exceptions.InvalidParameterTypeException) as caught:
        parameters.declare_parameter("a", "turtle1")
    assert (
        str(caught.value)
        == "Trying to set parameter 'a' to '2' of type 'INTEGER', expecting type 'STRING': a"
    )
    assert caught.value.hint == "YAML reads a string in quotes: -p a:='\"2\"'"
    with pytest.raises(exceptions.InvalidParameterTypeException) as caught:
        parameters.declare_parameter("a", 1.0)
    assert caught.value.hint == "YAML reads a double with a point in it: -p a:=2.0"
    with pytest.raises(exceptions.InvalidParameterTypeException) as caught:
        parameters.declare_parameter("a", True)
    assert caught.value.hint == ""
    assert not parameters.has_parameter("a")


def test_an_override_out_of_range():
    parameters = Recorder({"a": 20}).parameters
    descriptor = ParameterDescriptor(integer_range=[IntegerRange(from_value=0, to_value=10)])
    with pytest.raises(exceptions.InvalidParameterValueException) as caught:
        parameters.declare_parameter("a", 1, descriptor)
    why = "Parameter a out of range. Min: 0, Max: 10, value: 20"
    assert str(caught.value) == f"Invalid parameter value (20) for parameter. Reason: {why}: a"


def test_an_empty_list_of_the_command_line_fits_every_array():
    parameters = Recorder({"a": []}).parameters
    declared = parameters.declare_parameter("a", ["x"])
    assert (declared.type_, declared.value) == (Type.STRING_ARRAY, [])


def test_all_overrides_can_be_declared():
    recorder = Recorder({"a": 5, "b": "x"})
    recorder.parameters.declare_overrides()
    assert values(recorder.parameters, "a", "b") == [5, "x"]
    assert reason(recorder.parameters, "a", "now a string") == ""


def test_undeclared_parameters(parameters):
    parameters.declare_parameter("turtlename", "x")
    with pytest.raises(exceptions.ParameterNotDeclaredException) as caught:
        parameters.get_parameter("turtle_name")
    assert str(caught.value) == "Invalid access to undeclared parameter(s): turtle_name"
    assert (
        caught.value.hint
        == "Parameter 'turtle_name' of /ns/n is not declared: did you mean 'turtlename'?"
    )
    for call in (
        parameters.get_parameter_type,
        parameters.describe_parameter,
        parameters.undeclare_parameter,
    ):
        with pytest.raises(exceptions.ParameterNotDeclaredException):
            call("nope")
    with pytest.raises(exceptions.ParameterNotDeclaredException):
        parameters.set_descriptor("nope", ParameterDescriptor())
    assert parameters.get_parameter_or("nope", Parameter("nope", value=1)).value == 1


def test_the_text_for_an_undeclared_name_is_ros_2s(parameters):
    """`ros2 param set /broadcaster1 nope 5` of a real ROS 2."""
    shown = capture("289_param_set_py_undeclared")
    expected = re.search(r"Setting parameter failed: (.*)", shown.stdout + shown.stderr)[1]
    with pytest.raises(exceptions.ParameterNotDeclaredException) as caught:
        parameters.set_parameters_atomically([Parameter("nope", value=5)])
    assert str(caught.value) == expected
    assert "'nope'" in caught.value.hint


def test_allowing_undeclared_parameters(loose):
    parameters = loose.parameters
    assert parameters.get_parameter("a").type_ is Type.NOT_SET
    assert parameters.get_parameter_type("a") == 0
    assert parameters.describe_parameter("a") == ParameterDescriptor()
    assert parameters.set_descriptor("a", ParameterDescriptor()).type == 0
    assert [reason(parameters, "a", value) for value in (1, "x")] == ["", ""]
    assert values(parameters, "a") == ["x"]
    assert reason(parameters, "a", None) == ""
    assert loose.names() == [(["a"], [], []), ([], ["a"], []), ([], [], ["a"])]
    assert not parameters.has_parameter("a")


def test_each_parameter_is_set_by_itself(parameters):
    parameters.declare_parameters("", [("a", 1), ("b", 1)])
    results = parameters.set_parameters([Parameter("a", value="x"), Parameter("b", value=2)])
    assert [result.successful for result in results] == [False, True]
    assert values(parameters, "a", "b") == [1, 2]


def test_all_or_none(parameters):
    parameters.declare_parameters("", [("a", 1), ("b", 1)])
    result = parameters.set_parameters_atomically(
        [Parameter("a", value=2), Parameter("b", value="x")]
    )
    assert result == SetParametersResult(
        successful=False, reason="Wrong parameter type, expected 'Type.INTEGER' got 'Type.STRING'"
    )
    assert values(parameters, "a", "b") == [1, 1]
    assert (
        parameters.set_parameters_atomically([Parameter("a", value=2), Parameter("b", value=3)])
        == OK
    )
    assert values(parameters, "a", "b") == [2, 3]


def test_read_only(parameters):
    parameters.declare_parameter("a", 1, ParameterDescriptor(read_only=True))
    assert reason(parameters, "a", 2) == "Trying to set a read-only parameter: a."
    for call in (
        lambda: parameters.undeclare_parameter("a"),
        lambda: parameters.set_descriptor("a", ParameterDescriptor()),
    ):
        with pytest.raises(
            exceptions.ParameterImmutableException,
            match=r"^Attempted to modify read-only parameter: a$",
        ):
            call()


def test_a_typed_parameter_cannot_be_unset(parameters):
    parameters.declare_parameter("a", 1)
    assert reason(parameters, "a", None) == "Static parameter cannot be undeclared"


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0, ""),
        (10, ""),
        (3, ""),
        (11, "Parameter a out of range. Min: 0, Max: 10, value: 11"),
        (-1, "Parameter a out of range. Min: 0, Max: 10, value: -1"),
        (4, "The parameter value for a is not a valid step. Min: 0, max: 10, value: 4, step: 3"),
    ],
)
def test_integer_ranges(parameters, value, text):
    limits = IntegerRange(from_value=10, to_value=0, step=3)
    parameters.declare_parameter("a", 0, ParameterDescriptor(integer_range=[limits]))
    assert reason(parameters, "a", value) == text


@pytest.mark.parametrize(
    ("value", "is_refused"),
    [(2**63, True), (2**63 - 1, False), (-(2**63), False), (-(2**63) - 1, True)],
)
def test_integers_that_no_message_can_hold_are_refused(parameters, value, is_refused):
    text = f"Parameter a out of range. Min: {-(2**63)}, Max: {2**63 - 1}, value: "
    parameters.declare_parameters("", [("a", 1), ("aa", [1])])
    limits = ParameterDescriptor(integer_range=[IntegerRange(from_value=0, to_value=10)])
    parameters.declare_parameter("ranged", 1, limits)
    refused = f"Parameter ranged out of range. Min: 0, Max: 10, value: {value}"
    assert reason(parameters, "ranged", value) == refused
    assert reason(parameters, "a", value).startswith(text) == is_refused
    assert reason(parameters, "aa", [0, value]) == (
        text.replace(" a ", " aa ") + str(value) if is_refused else ""
    )
    if is_refused:
        with pytest.raises(exceptions.InvalidParameterValueException, match="out of range"):
            parameters.declare_parameter("b", value)
        assert not parameters.has_parameter("b")


@pytest.mark.parametrize(
    ("value", "is_a_step"), [(2, True), (4, False), (5, True), (9, False), (10, True), (11, True)]
)
def test_steps_count_from_the_start_of_a_range_and_its_end_is_always_valid(
    parameters, value, is_a_step
):
    limits = IntegerRange(from_value=2, to_value=10, step=3)
    parameters.declare_parameter("a", 2, ParameterDescriptor(integer_range=[limits]))
    text = reason(parameters, "a", value)
    if value > 10:
        assert text == "Parameter a out of range. Min: 2, Max: 10, value: 11"
    else:
        assert text.startswith("The parameter value for a is not a valid step.") != is_a_step
    limits = FloatingPointRange(from_value=2.0, to_value=10.0, step=3.0)
    parameters.declare_parameter("b", 2.0, ParameterDescriptor(floating_point_range=[limits]))
    assert (reason(parameters, "b", float(value)) == "") == (is_a_step and value <= 10)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.3, ""),
        (1.0, ""),
        (1.0000001, ""),
        (0.1 + 0.2, ""),
        (1.1, "Parameter a out of range Min: 0.0, Max: 1.0, value: 1.1"),
        (
            0.25,
            (
                "The parameter value for a is not close enough to a valid step. Min: 0.0, "
                "max: 1.0, value: 0.25, step: 0.1"
            ),
        ),
        (float("nan"), "Parameter a out of range Min: 0.0, Max: 1.0, value: nan"),
    ],
)
def test_ranges_of_doubles(parameters, value, text):
    limits = FloatingPointRange(from_value=0.0, to_value=1.0, step=0.1)
    parameters.declare_parameter("a", 0.0, ParameterDescriptor(floating_point_range=[limits]))
    assert reason(parameters, "a", value) == text


@pytest.mark.parametrize("step", [5e-324, 1e-300])
def test_a_step_below_the_precision_of_a_double(parameters, step):
    limits = FloatingPointRange(from_value=0.0, to_value=1e300, step=step)
    parameters.declare_parameter("a", 0.0, ParameterDescriptor(floating_point_range=[limits]))
    assert reason(parameters, "a", 0.3) == ""
    assert reason(parameters, "a", 1e299) == ""


def test_events(recorder):
    parameters = recorder.parameters
    parameters.declare_parameter("a", 1)
    parameters.declare_parameters("", [("b", 1), ("c", Type.BOOL)])
    parameters.set_parameters_atomically([Parameter("a", value=2), Parameter("c", value=True)])
    parameters.set_parameters([Parameter("a", value="refused")])
    parameters.undeclare_parameter("a")
    assert recorder.names() == [
        (["a"], [], []),
        (["b"], [], []),
        (["c"], [], []),
        (["c"], ["a"], []),
    ]
    last = recorder.events[-1]
    assert (last.node, last.stamp.sec, last.stamp.nanosec) == ("/ns/n", 3, 4)
    assert last.changed_parameters[0].value.integer_value == 2


def test_a_single_declaration_makes_the_event_of_a_real_node():
    """The first event of `bare_node` in golden/wire/demo_topics.json, but for the stamp."""
    import json

    from turtlewire import msg

    samples = json.loads((GOLDEN / "wire" / "demo_topics.json").read_text())
    (golden, *_) = [
        each
        for each in samples
        if each["topic"] == "rt/parameter_events" and each["values"]["node"] == "/ns1/bare_node"
    ]
    events = []
    stamp = golden["values"]["stamp"]
    parameters = NodeParameters(
        node_fqn="/ns1/bare_node",
        overrides={},
        constructor_overrides=None,
        allow_undeclared=False,
        now=lambda: Time(seconds=stamp["sec"], nanoseconds=stamp["nanosec"]),
        publish_event=events.append,
    )
    parameters.declare_parameter("use_sim_time", False)
    data = msg.serialize(events[0])
    assert data + bytes(-len(data) % 4) == bytes.fromhex(golden["bytes"])


def test_callbacks_run_in_order(recorder):
    parameters = recorder.parameters
    parameters.declare_parameter("a", 1)
    calls = []

    def double(parameter_list):
        calls.append("pre")
        return [Parameter(each.name, value=each.value * 2) for each in parameter_list]

    def on_set(name):
        def decide(parameter_list):
            calls.append((name, parameter_list[0].value, parameters.get_parameter("a").value))
            return OK

        return decide

    older, newer = on_set("older"), on_set("newer")

    def after(parameter_list):
        calls.append(("post", parameters.get_parameter("a").value, len(recorder.events)))

    parameters.callbacks.before.insert(0, double)
    parameters.callbacks.deciding.insert(0, older)
    parameters.callbacks.deciding.insert(0, newer)
    parameters.callbacks.after.insert(0, after)
    assert reason(parameters, "a", 5) == ""
    assert calls == ["pre", ("newer", 10, 1), ("older", 10, 1), ("post", 10, 2)]
    parameters.callbacks.before.remove(double)
    parameters.callbacks.deciding.remove(older)
    parameters.callbacks.deciding.remove(newer)
    parameters.callbacks.after.remove(after)
    assert reason(parameters, "a", 6) == ""
    assert values(parameters, "a") == [6]
    assert len(calls) == 4
    with pytest.raises(ValueError):
        parameters.callbacks.deciding.remove(older)


def test_a_callback_refuses(recorder):
    parameters = recorder.parameters
    asked = []
    parameters.callbacks.deciding.insert(
        0, lambda parameter_list: asked.append(parameter_list) or OK
    )
    parameters.callbacks.deciding.insert(
        0, lambda _: SetParametersResult(successful=False, reason="not today")
    )
    with pytest.raises(exceptions.InvalidParameterValueException, match="not today"):
        parameters.declare_parameter("a", 1)
    assert not parameters.has_parameter("a")
    assert asked == []
    assert recorder.events == []


def test_a_callback_that_decides_nothing_refuses_with_a_warning(parameters):
    parameters.declare_parameter("speed", 1)
    parameters.callbacks.deciding.insert(0, lambda _: None)
    text = "Callback returned an invalid type"
    with pytest.warns(UserWarning, match=re.escape(text)):
        (result,) = parameters.set_parameters([Parameter("speed", value=2)])
    assert (result.successful, result.reason) == (False, text)
    assert parameters.get_parameter("speed").value == 1


def test_a_refusal_without_a_reason_is_a_refusal(parameters):
    parameters.declare_parameter("a", 1)
    parameters.callbacks.deciding.insert(0, lambda _: SetParametersResult(successful=False))
    assert not parameters.set_parameters_atomically([Parameter("a", value=2)]).successful
    assert values(parameters, "a") == [1]


def test_a_pre_set_callback_empties_the_list(parameters):
    parameters.declare_parameter("a", 1)
    parameters.callbacks.before.insert(0, lambda _: [])
    assert reason(parameters, "a", 2).startswith(
        "parameter list cannot be empty, this might be due to pre_set_parameters_callback"
    )


def test_a_callback_may_set_other_parameters(parameters):
    """No lock is held over a callback."""
    parameters.declare_parameters("", [("a", 1), ("b", 1)])

    def follow(parameter_list):
        if parameter_list[0].name == "a":
            parameters.set_parameters([Parameter("b", value=parameter_list[0].value)])

    parameters.callbacks.after.insert(0, follow)
    assert reason(parameters, "a", 9) == ""
    assert values(parameters, "b") == [9]


def test_descriptions(parameters):
    parameters.declare_parameter("a", 1, ParameterDescriptor(description="text"))
    parameters.declare_parameter("b", 1, ParameterDescriptor(dynamic_typing=True))
    parameters.set_parameters([Parameter("b", value="x")])
    described = parameters.describe_parameters(["a", "b"])
    assert [(each.name, each.type, each.description) for each in described] == [
        ("a", 2, "text"),
        ("b", 4, ""),
    ]


def test_parameters_declared_with_one_descriptor_have_their_own_types(parameters):
    shared = ParameterDescriptor(description="limit")
    parameters.declare_parameters("", [("a", 1, shared), ("b", 2.0, shared)])
    described = parameters.describe_parameters(["a", "b"])
    assert [(each.name, each.type) for each in described] == [("a", 2), ("b", 3)]
    assert reason(parameters, "a", 5) == reason(parameters, "b", 0.5) == ""
    other = ParameterDescriptor(description="other")
    parameters.set_descriptor("a", other)
    parameters.set_descriptor("b", other)
    assert reason(parameters, "a", 6) == reason(parameters, "b", 1.5) == ""


def test_another_descriptor(parameters):
    parameters.declare_parameter("a", 20)
    narrow = ParameterDescriptor(integer_range=[IntegerRange(from_value=0, to_value=10)])
    with pytest.raises(exceptions.InvalidParameterValueException, match="Parameter a out of range"):
        parameters.set_descriptor("a", narrow)
    assert (
        parameters.set_descriptor(
            "a", narrow, ParameterValue(type=2, integer_value=5)
        ).integer_value
        == 5
    )
    assert reason(parameters, "a", 11) == "Parameter a out of range. Min: 0, Max: 10, value: 11"


@pytest.mark.parametrize(
    ("prefixes", "depth", "names", "found_prefixes"),
    [
        ([], 0, ["a", "b.c", "b.d.e", "bb.x"], ["b", "b.d", "bb"]),
        ([], 1, ["a"], []),
        ([], 2, ["a", "b.c", "bb.x"], ["b", "bb"]),
        (["b"], 0, ["b.c", "b.d.e"], ["b", "b.d"]),
        (["b"], 1, ["b.c"], ["b"]),
        (["b.d", "a"], 0, ["a", "b.d.e"], ["b.d"]),
        (["nope"], 0, [], []),
    ],
)
def test_lists(parameters, prefixes, depth, names, found_prefixes):
    parameters.declare_parameters("", [(name, 1) for name in ("a", "b.c", "b.d.e", "bb.x")])
    result = parameters.list_parameters(prefixes, depth)
    assert (result.names, result.prefixes) == (names, found_prefixes)


@pytest.mark.parametrize(
    ("prefixes", "depth", "error"),
    [("a", 0, TypeError), ([1], 0, TypeError), ([], "0", TypeError), ([], -1, ValueError)],
)
def test_bad_lists(parameters, prefixes, depth, error):
    with pytest.raises(error):
        parameters.list_parameters(prefixes, depth)


def test_they_are_read_as_a_dictionary(parameters):
    parameters.declare_parameter("speed", 1)
    assert parameters["speed"].value == 1
    assert "speed" in parameters
    assert {name: each.value for name, each in parameters.items()} == {"speed": 1}
    assert parameters.get("none") is None
    with pytest.raises(KeyError):
        parameters["none"]


@pytest.mark.parametrize("step", ["on_set", "post_set"])
def test_a_callback_that_is_not_callable(node, step):
    with pytest.raises(TypeError) as caught:
        getattr(node, f"add_{step}_parameters_callback")(None)
    assert caught.value.args == ("Callback must be callable, got {}", type(None))
