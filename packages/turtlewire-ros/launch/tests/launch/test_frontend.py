"""XML and YAML launch files: equivalent files in both languages have the same effects."""

import pytest
from tests.programs import lines_in

from launch.actions import IncludeLaunchDescription
from launch.frontend import Parser, expose_action, expose_substitution
from launch.frontend.parse_substitution import parse_substitution
from launch.substitutions import TextSubstitution

XML = """
<launch>
  <arg name="who" default="world" description="Whom it\\'s for">
    <choice value="world"/><choice value="turtle"/>
  </arg>
  <let name="greeting" value="hello $(var who)"/>
  <log message="$(var greeting)"/>
  <log message="never" if="false"/>
  <log message="always" unless="$(equals 1 2)"/>
  <set_env name="TURTLE_FRONTEND" value="a"/>
  <append_env name="TURTLE_FRONTEND" value="b" prepend="true" separator="+"/>
  <log message="$(env TURTLE_FRONTEND)"/>
  <group>
    <let name="greeting" value="inside"/>
    <unset_env name="TURTLE_FRONTEND"/>
    <log message="$(var greeting) $(env TURTLE_FRONTEND none)"/>
  </group>
  <group scoped="false"><let name="left" value="1"/></group>
  <group forwarding="false">
    <keep name="left" value="$(var left)2"/>
    <log message="$(var left) $(var greeting gone)"/>
  </group>
  <log message="$(var greeting) $(env TURTLE_FRONTEND)"/>
  <reset><keep name="who" value="$(var who)"/></reset>
  <log message="$(var left gone)"/>
  <reset_env/>
  <log message="$(env TURTLE_FRONTEND gone)"/>
  <executable cmd="sh -c 'echo &quot;$TURTLE $0&quot; $(var who)' '$(var who)'" name="exe"
              output="screen" cwd="/" output_format="OUT {line}">
    <env name="TURTLE" value="green"/>
  </executable>
  <timer period="0.01"><log message="later"/></timer>
</launch>
"""
YAML = """
launch:
- arg: {name: who, default: world, description: "Whom it\\\\'s for",
        choice: [{value: world}, {value: turtle}]}
- let: {name: greeting, value: hello $(var who)}
- log: {message: $(var greeting)}
- log: {message: never, if: "false"}
- log: {message: always, unless: $(equals 1 2)}
- set_env: {name: TURTLE_FRONTEND, value: a}
- append_env: {name: TURTLE_FRONTEND, value: b, prepend: true, separator: +}
- log: {message: $(env TURTLE_FRONTEND)}
- group:
  - let: {name: greeting, value: inside}
  - unset_env: {name: TURTLE_FRONTEND}
  - log: {message: $(var greeting) $(env TURTLE_FRONTEND none)}
- group: {scoped: false, children: [{let: {name: left, value: "1"}}]}
- group:
    forwarding: false
    children:
    - keep: {name: left, value: $(var left)2}
    - log: {message: $(var left) $(var greeting gone)}
- log: {message: $(var greeting) $(env TURTLE_FRONTEND)}
- reset: [{keep: {name: who, value: $(var who)}}]
- log: {message: $(var left gone)}
- reset_env: {}
- log: {message: $(env TURTLE_FRONTEND gone)}
- executable:
    cmd: sh -c 'echo "$TURTLE $0" $(var who)' '$(var who)'
    name: exe
    output: screen
    cwd: /
    output_format: OUT {line}
    env: [{name: TURTLE, value: green}]
- timer: {period: 0.01, children: [{log: {message: later}}]}
"""


@pytest.fixture(params=["xml", "yaml"])
def language(request):
    return request.param


@pytest.fixture
def launch_file(launch, tmp_path, language):
    def start(xml, yaml, *arguments):
        path = tmp_path / f"x.launch.{language}"
        path.write_text(xml if language == "xml" else yaml)
        return launch(IncludeLaunchDescription(str(path), launch_arguments=arguments))

    return start


def test_shutdown(launch_file):
    xml = (
        '<launch><timer period="1000"><log message="never"/></timer>'
        '<shutdown reason="enough"/></launch>'
    )
    yaml = (
        "launch:\n- timer: {period: 1000.0, children: [{log: {message: never}}]}\n- shutdown: "
        "{reason: enough}\n"
    )
    outcome = launch_file(xml, yaml)
    assert outcome.messages == []
    assert outcome.status == 0


def test_actions(launch_file):
    outcome = launch_file(XML, YAML, ("who", "turtle"))
    assert outcome.messages == [
        "hello turtle",
        "always",
        "b+a",
        "inside none",
        "12 gone",
        "hello turtle b+a",
        "gone",
        "gone",
        "later",
    ]
    assert "OUT green turtle turtle" in outcome.lines
    assert outcome.status == 0


def test_choices(launch_file):
    assert launch_file(XML, YAML, ("who", "nobody")).error.endswith(
        "is not valid. Valid options are: ['world', 'turtle']"
    )


def test_descriptions_are_unescaped(tmp_path):
    (tmp_path / "x.launch.xml").write_text(XML)
    description = IncludeLaunchDescription(str(tmp_path / "x.launch.xml")).launch_description_source
    (argument,) = description.try_get_launch_description_without_context().get_launch_arguments()
    assert argument.description == "Whom it's for Valid choices are: ['world', 'turtle']"


def test_includes_with_arguments(launch_file, tmp_path):
    (tmp_path / "inner.launch.xml").write_text(
        "<launch><arg name='who'/><log message='$(var who)'/></launch>"
    )
    xml = (
        "<launch><include file='$(dirname)/inner.launch.xml'><arg name='who' "
        "value='me'/></include></launch>"
    )
    yaml = "launch: [{include: {file: $(dirname)/inner.launch.xml, arg: [{name: who, value: me}]}}]"
    assert launch_file(xml, yaml).messages == ["me"]


def test_processes(launch_file):
    attributes = {
        "respawn": "false",
        "respawn_delay": "1.0",
        "respawn_max_retries": "1",
        "shell": "true",
        "emulate_tty": "false",
    }
    attributes |= {
        "sigterm_timeout": "1",
        "sigkill_timeout": "$(var none 2)",
        "launch-prefix": "env",
        "on_exit": "shutdown",
    }
    xml = (
        "<launch><executable cmd='echo a' output='screen' "
        + " ".join(f"{name}='{value}'" for name, value in attributes.items())
        + "/></launch>"
    )
    yaml = (
        "launch: [{executable: {cmd: echo a, output: screen, "
        + ", ".join(f"{name}: {value}" for name, value in attributes.items())
        + "}}]"
    )
    outcome = launch_file(xml, yaml)
    assert "was required: shutting down launched system" in outcome.text
    assert any(line.endswith("] a") for line in outcome.lines)


@pytest.mark.parametrize(
    ("xml", "yaml", "error"),
    [
        (
            "<log/>",
            "log: {}",
            "Attribute 'message' of type '<class 'str'>' not found in Entity 'log'",
        ),
        (
            "<log message='a' if='1' unless='1'/>",
            "log: {message: a, if: '1', unless: '1'}",
            "if and unless conditions can't be used simultaneously",
        ),
        (
            "<log message='a' colour='b'/>",
            "log: {message: a, colour: b}",
            " found in `log`: {'colour'}",
        ),
        ("<log message='$(nope a)'/>", "log: {message: $(nope a)}", "Unknown substitution: nope"),
        (
            "<log message='$(var a'/>",
            "log: {message: $(var a}",
            "the substitution '$(var a' is not closed by ')'",
        ),
        (
            "<executable cmd='a' on_exit='x'/>",
            "executable: {cmd: a, on_exit: x}",
            'on_exit of Entity node expected to be "shutdown" but got `x`',
        ),
    ],
)
def test_elements_that_are_wrong(launch_file, xml, yaml, error):
    outcome = launch_file(f"<launch>{xml}</launch>", f"launch:\n- {yaml}")
    assert outcome.status == 1
    assert error in outcome.text


@pytest.mark.parametrize(
    ("element", "attribute", "value"),
    [
        ("group", "scoped", "maybe"),
        ("group", "scoped", "5"),
        ("group", "scoped", "$(var a)"),
        ("group", "forwarding", "maybe"),
        ("executable", "shell", "maybe"),
        ("executable", "shell", "$(var a)"),
        ("executable", "emulate_tty", "maybe"),
        ("executable", "respawn", "maybe"),
        ("append_env", "prepend", "maybe"),
    ],
)
def test_truth_values_that_are_wrong(launch_file, element, attribute, value):
    others = {"group": {}, "executable": {"cmd": "true"}, "append_env": {"name": "A", "value": "b"}}
    attributes = {**others[element], attribute: value}
    xml = " ".join(f'{name}="{text}"' for name, text in attributes.items())
    yaml = ", ".join(f"{name}: '{text}'" for name, text in attributes.items())
    children = ", children: []" if element == "group" else ""
    outcome = launch_file(
        f'<launch><arg name="a" default="false"/><{element} {xml}/></launch>',
        f"launch:\n- arg: {{name: a, default: 'false'}}\n- {element}: {{{yaml}{children}}}",
    )
    assert outcome.status == 1
    assert (
        f"Attribute '{attribute}' of Entity '{element}' expected to be of type '<class 'bool'>'"
        in outcome.text
    )


@pytest.mark.parametrize("value", ["true", "1", "$(var a)"])
def test_truth_values_from_texts(launch_file, value):
    outcome = launch_file(
        f"""<launch><arg name="a" default="true"/><set_env name="TURTLE_FRONTEND" value="x"/>
<append_env name="TURTLE_FRONTEND" value="y" separator="" prepend="{value}"/>
<log message="$(env TURTLE_FRONTEND)"/></launch>""",
        f"""launch:
- arg: {{name: a, default: 'true'}}
- set_env: {{name: TURTLE_FRONTEND, value: x}}
- append_env: {{name: TURTLE_FRONTEND, value: y, separator: '', prepend: '{value}'}}
- log: {{message: $(env TURTLE_FRONTEND)}}""",
    )
    assert "[INFO] [launch.user]: yx" in outcome.lines


@pytest.mark.parametrize(
    ("text", "performed"),
    [
        ("", ""),
        ("plain", "plain"),
        ("$(var a)", "1"),
        ("x$(var a)$(var b)y", "x12y"),
        ("$(var $(var name))", "1"),
        ("$(var 'a')", "1"),
        ('$(var "a")', "1"),
        ("$(var c 'two words')", "two words"),
        ("$(var c '$(var a) and $(var b)')", "1 and 2"),
        ("$(var c '')", ""),
        (r"\$(var a) \'\"\\", "$(var a) '\"\\"),
        ("costs $5", "costs $5"),
        (r"C:\turtle", r"C:\turtle"),
        ("$(not $(equals 1 2))", "true"),
        ("$(and true $(or 0 1))", "true"),
        ("$(any 0 0 1) $(all 1 0)", "true false"),
        ("$(not-equals a b)", "true"),
        ("$(if 1 yes no)$(if 0 yes)", "yes"),
        ("$(eval '1 + $(var a)')", "2"),
        ("$(command 'echo hi')", "hi\n"),
        ("( $ ) $", "( $ ) $"),
    ],
)
def test_texts_with_substitutions(context, text, performed):
    Parser().parse_substitution("$(var a)")  # makes the names known
    context.launch_configurations.update(a="1", b="2", name="a")
    assert "".join(part.perform(context) for part in parse_substitution(text)) == performed


@pytest.mark.parametrize(
    "text",
    [
        "$(",
        "$(var",
        "$(var a",
        "$(var 'a)",
        "$()",
        "$(var)",
        "$(not)",
        "$(equals a)",
        "$(env)",
        "$(anon)",
        "$(find-exec)",
        "$(dirname x)",
        "$(filename x)",
        "$(command)",
        "$(eval)",
        "$(if 1)",
        "$(launch_log_dir x)",
        "$(file-content)",
        "$(and a)",
    ],
)
def test_texts_that_are_wrong(text):
    with pytest.raises((SyntaxError, RuntimeError, TypeError, AttributeError, ValueError)):
        Parser().parse_substitution(text)


def test_names_are_given_once():
    @expose_substitution("test-only")
    class _Mine(TextSubstitution):
        @classmethod
        def parse(cls, data):
            return cls, {"text": str(len(data))}

    (made,) = parse_substitution("$(test-only a b)")
    assert made.text == "2"
    with pytest.raises(RuntimeError, match="Two substitutions are exposed as 'test-only'"):
        expose_substitution("test-only")(lambda data: (TextSubstitution, {"text": str(data)}))
    with pytest.raises(RuntimeError, match="While exposing action 'x', it must be a callable"):
        expose_action("x")(3)


def test_languages():
    assert {"xml", "yaml", "yml"} <= set(Parser.get_available_extensions())
    assert Parser.is_extension_valid(".xml")
    assert not Parser.is_extension_valid("py")


@pytest.mark.parametrize(
    ("distro", "result"), [("kilted", "Action ['condition']"), ("lyrical", "Mine ['condition']")]
)
def test_an_action_s_own_parse(distro, result):
    """Its class is Lyrical's answer; a subclass calls it in the same way."""
    program = """
import io
from launch.action import Action
from launch.frontend import Parser

class Mine(Action):
    pass

entity, parser = Parser.load(io.StringIO('<launch><mine if="true"/></launch>'))
kind, arguments = Mine.parse(entity.children[0], parser)
print(kind.__name__, sorted(arguments))
"""
    assert lines_in(distro, program) == [result]
