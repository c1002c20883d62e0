"""Launch files in XML and YAML."""

import pytest

import launch_xml
import launch_yaml
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.frontend import Entity as BaseEntity
from launch_xml.launch_description_sources import XMLLaunchDescriptionSource
from launch_yaml.launch_description_sources import YAMLLaunchDescriptionSource


def loader(parser, path):
    """Return a function that makes the first entity of a text."""

    def load(text):
        path.write_text(text)
        return parser.load(str(path))[0]

    return load


# XML.


@pytest.fixture
def xml_entity(tmp_path):
    return loader(launch_xml.Parser, tmp_path / "x.launch.xml")


def test_attributes_of_xml(xml_entity):
    element = xml_entity(
        "<launch a='1' b='1.5' c='true' d='x' e='1;2' e-sep=';' f='a, b' g='[1, "
        "2]'><child/><child/></launch>"
    )
    assert element.type_name == "launch"
    assert element.get_attr("a") == "1"
    assert element.get_attr("a", data_type=int) == 1
    assert element.get_attr("b", data_type=float) == 1.5
    assert element.get_attr("c", data_type=bool) is True
    assert element.get_attr("d", data_type=int) == "x"  # it may hold substitutions
    assert element.get_attr("e", data_type=None) == [1, 2]
    assert element.get_attr("f", data_type=list[str]) == ["a", "b"]
    assert element.get_attr("g", data_type=None) == [1, 2]
    children = element.get_attr("child", data_type=list[BaseEntity])
    assert [child.type_name for child in children] == ["child", "child"]
    assert children[0].parent is element
    element.assert_entity_completely_parsed()


def test_missing_attributes_and_other_types_of_xml(xml_entity):
    element = xml_entity("<launch a='x'/>")
    assert element.get_attr("b", optional=True) is None
    with pytest.raises(
        AttributeError, match="Attribute 'b' of type '<class 'str'>' not found in Entity 'launch'"
    ):
        element.get_attr("b")
    with pytest.raises(AttributeError, match="not found in Entity 'launch'"):
        element.get_attr("b", data_type=list[BaseEntity])
    with pytest.raises(
        TypeError,
        match="Attribute 'a' of Entity 'launch' expected to be of type "
        "'<class 'bool'>' but got 'x'",
    ):
        element.get_attr("a", data_type=bool, can_be_str=False)


def test_unrequested_attributes_and_elements_are_rejected(xml_entity):
    with pytest.raises(ValueError, match=r"Unexpected attribute\(s\) found in `launch`: {'a'}"):
        xml_entity("<launch a='x'/>").assert_entity_completely_parsed()
    with pytest.raises(
        ValueError, match=r"Unexpected nested entity\(ies\) found in `launch`: {'b'}"
    ):
        xml_entity("<launch><b/></launch>").assert_entity_completely_parsed()


BOMB = """<!DOCTYPE lolz [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">
<!ENTITY c "&b;&b;&b;&b;&b;&b;&b;&b;">]>
<launch><log message="&c;"/></launch>"""
EXTERNAL = '<!DOCTYPE x [<!ENTITY secret SYSTEM "file:///etc/passwd">]><launch><log message="&secret;"/></launch>'
REMOTE = '<!DOCTYPE launch SYSTEM "http://127.0.0.1:9/evil.dtd"><launch/>'


@pytest.mark.parametrize("text", [BOMB, EXTERNAL, REMOTE])
def test_entities_are_refused(tmp_path, text):
    (tmp_path / "x.launch.xml").write_text(text)
    message = (
        r"a document type declaration, which may hold entities, is not allowed here "
        r"\(x.launch.xml, line 1\)"
    )
    with pytest.raises(SyntaxError, match=message):
        launch_xml.Parser.load(str(tmp_path / "x.launch.xml"))


def test_a_malformed_xml_file_is_named_with_its_line(tmp_path):
    (tmp_path / "x.launch.xml").write_text("<launch>\n<log message='a' message='b'/>\n</launch>")
    with pytest.raises(SyntaxError) as caught:
        launch_xml.Parser.load(str(tmp_path / "x.launch.xml"))
    assert str(caught.value) == "duplicate attribute: line 2, column 17 (x.launch.xml, line 2)"


def test_a_file_that_is_nested_too_deeply(tmp_path):
    path = tmp_path / "x.launch.xml"
    path.write_text("<launch>" + "<group>" * 50_000 + "</group>" * 50_000 + "</launch>")
    with pytest.raises(SyntaxError, match=r"^nested too deeply \(x\.launch\.xml\)$"):
        launch_xml.Parser.load(str(path))


def test_the_source_reads_only_xml(tmp_path):
    (tmp_path / "x.launch.xml").write_text("<launch><log message='a'/></launch>")
    source = XMLLaunchDescriptionSource(str(tmp_path / "x.launch.xml"))
    assert isinstance(source.try_get_launch_description_without_context(), LaunchDescription)
    assert source.method == "interpreted XML launch file"
    assert isinstance(
        IncludeLaunchDescription(source).describe_sub_entities()[0], LaunchDescription
    )


# YAML.


@pytest.fixture
def yaml_entity(tmp_path):
    return loader(launch_yaml.Parser, tmp_path / "x.launch.yaml")


def test_attributes_of_yaml(yaml_entity):
    element = yaml_entity(
        "launch:\n- node: {a: 1, b: 1.5, c: true, d: x, e: [1, 2], children: [{x: {}}, {y: {}}], "
        "env: [{name: n}]}"
    ).children[0]
    assert element.type_name == "node"
    assert element.get_attr("a", data_type=int) == 1
    assert element.get_attr("a", data_type=float) == 1
    assert element.get_attr("b", data_type=float) == 1.5
    assert element.get_attr("c", data_type=bool) is True
    assert element.get_attr("d") == "x"
    with pytest.raises(TypeError, match="Attribute 'd' of Entity 'node' expected to be of type"):
        element.get_attr("d", data_type=bool)
    assert element.get_attr("e", data_type=list[int]) == [1, 2]
    assert element.get_attr("e", data_type=None) == [1, 2]
    assert [child.type_name for child in element.children] == ["x", "y"]
    (variable,) = element.get_attr("env", data_type=list[BaseEntity])
    assert (variable.type_name, variable.get_attr("name"), variable.parent) == ("env", "n", element)
    element.assert_entity_completely_parsed()


def test_missing_attributes_and_other_types_of_yaml(yaml_entity):
    element = yaml_entity("launch:\n- node: {a: x, c: true, env: 3}").children[0]
    assert element.get_attr("b", optional=True) is None
    with pytest.raises(
        AttributeError, match="Attribute 'b' of type '<class 'str'>' not found in Entity 'node'"
    ):
        element.get_attr("b")
    with pytest.raises(
        TypeError,
        match="Attribute 'c' of Entity 'node' expected to be of type '<class 'int'>' but got "
        "'<class 'bool'>'",
    ):
        element.get_attr("c", data_type=int)
    with pytest.raises(TypeError, match="expected to be of type '<class 'bool'>'"):
        element.get_attr("a", data_type=bool, can_be_str=False)
    with pytest.raises(
        TypeError, match="Attribute 'env' of Entity 'node' expected to be a list of dictionaries"
    ):
        element.get_attr("env", data_type=list[BaseEntity])


@pytest.mark.parametrize(
    ("text", "error", "message"),
    [
        ("launch: 3", TypeError, "Expected a list of entities in `launch`, got '3'"),
        ("launch: {}", ValueError, "Expected entity `launch` to have children entities"),
        (
            "launch: [{a: 1, b: 2}]",
            RuntimeError,
            "Subentities must be a dictionary with only one key",
        ),
        ("launch: [x]", RuntimeError, "Subentities must be a dictionary with only one key"),
    ],
)
def test_invalid_elements(yaml_entity, text, error, message):
    with pytest.raises(error, match=message):
        _ = yaml_entity(text).children


def test_unrequested_keys_are_rejected(yaml_entity):
    with pytest.raises(ValueError, match=r"Unexpected key\(s\) found in `log`: {'a'}"):
        yaml_entity("launch:\n- log: {a: 1}").children[0].assert_entity_completely_parsed()


def test_aliases_work_but_no_bombs(yaml_entity):
    assert (
        yaml_entity("launch: [{log: &m {message: hi}}, {log: *m}]").children[1].get_attr("message")
        == "hi"
    )
    levels = "\n".join(
        f"  - group: &g{level} [{', '.join(f'{{group: *g{level - 1}}}' for _ in range(10))}]"
        for level in range(1, 9)
    )
    with pytest.raises(ValueError, match="The aliases expand to more than 100000 elements"):
        yaml_entity(f"launch:\n  - group: &g0 []\n{levels}")
    with pytest.raises(ValueError, match="An alias contains itself"):
        yaml_entity("launch: &a [{group: *a}]")


@pytest.mark.parametrize(
    ("text", "why"),
    [("[" * 50_000, "nested too deeply"), ("launch: 2026-13-01", "month must be in 1..12")],
)
def test_invalid_yaml_files(tmp_path, text, why):
    (tmp_path / "x.launch.yaml").write_text(text)
    with pytest.raises(SyntaxError) as caught:
        launch_yaml.Parser.load(str(tmp_path / "x.launch.yaml"))
    # Python 3.14 adds the month.
    assert (caught.value.msg.removesuffix(", not 13"), caught.value.filename) == (
        why,
        "x.launch.yaml",
    )


def test_a_malformed_yaml_file_is_named_with_its_line(tmp_path):
    (tmp_path / "x.launch.yaml").write_text("launch:\n- log:\n\tmessage: x")
    with pytest.raises(SyntaxError) as caught:
        launch_yaml.Parser.load(str(tmp_path / "x.launch.yaml"))
    assert (
        str(caught.value)
        == "found character '\\t' that cannot start any token (x.launch.yaml, line 3)"
    )


def test_no_python_objects(tmp_path):
    (tmp_path / "x.launch.yaml").write_text("launch: !!python/object/apply:os.getcwd []")
    with pytest.raises(
        SyntaxError,
        match=r"could not determine a constructor for the tag .* \(x\.launch\.yaml, line 1\)",
    ):
        launch_yaml.Parser.load(str(tmp_path / "x.launch.yaml"))


def test_the_source_reads_only_yaml(tmp_path):
    (tmp_path / "x.launch.yaml").write_text("launch: []")
    source = YAMLLaunchDescriptionSource(str(tmp_path / "x.launch.yaml"))
    assert isinstance(source.try_get_launch_description_without_context(), LaunchDescription)
    assert source.method == "interpreted YAML launch file"
