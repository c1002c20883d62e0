"""Launch files in YAML."""

import pytest

from launch import LaunchDescription
from launch.frontend import Entity as BaseEntity
from launch_yaml import Parser
from launch_yaml.launch_description_sources import YAMLLaunchDescriptionSource


@pytest.fixture
def entity(tmp_path):
    def load(text):
        path = tmp_path / "x.launch.yaml"
        path.write_text(text)
        return Parser.load(str(path))[0]

    return load


def test_attributes(entity):
    element = entity(
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


def test_attributes_that_are_missing_or_of_another_type(entity):
    element = entity("launch:\n- node: {a: x, c: true, env: 3}").children[0]
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
def test_invalid_elements(entity, text, error, message):
    with pytest.raises(error, match=message):
        _ = entity(text).children


def test_unrequested_files_are_rejected(entity):
    with pytest.raises(ValueError, match=r"Unexpected key\(s\) found in `log`: {'a'}"):
        entity("launch:\n- log: {a: 1}").children[0].assert_entity_completely_parsed()


def test_aliases_work_but_no_bombs(entity):
    assert (
        entity("launch: [{log: &m {message: hi}}, {log: *m}]").children[1].get_attr("message")
        == "hi"
    )
    levels = "\n".join(
        f"  - group: &g{level} [{', '.join(f'{{group: *g{level - 1}}}' for _ in range(10))}]"
        for level in range(1, 9)
    )
    with pytest.raises(ValueError, match="The aliases expand to more than 100000 elements"):
        entity(f"launch:\n  - group: &g0 []\n{levels}")
    with pytest.raises(ValueError, match="An alias contains itself"):
        entity("launch: &a [{group: *a}]")


@pytest.mark.parametrize(
    ("text", "why"),
    [("[" * 50_000, "nested too deeply"), ("launch: 2026-13-01", "month must be in 1..12")],
)
def test_invalid_yaml_files(tmp_path, text, why):
    (tmp_path / "x.launch.yaml").write_text(text)
    with pytest.raises(SyntaxError) as caught:
        Parser.load(str(tmp_path / "x.launch.yaml"))
    # Python 3.14 adds the month.
    assert (caught.value.msg.removesuffix(", not 13"), caught.value.filename) == (
        why,
        "x.launch.yaml",
    )


def test_a_malformed_file_is_named_with_its_line(tmp_path):
    (tmp_path / "x.launch.yaml").write_text("launch:\n- log:\n\tmessage: x")
    with pytest.raises(SyntaxError) as caught:
        Parser.load(str(tmp_path / "x.launch.yaml"))
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
        Parser.load(str(tmp_path / "x.launch.yaml"))


def test_the_source_reads_only_yaml(tmp_path):
    (tmp_path / "x.launch.yaml").write_text("launch: []")
    source = YAMLLaunchDescriptionSource(str(tmp_path / "x.launch.yaml"))
    assert isinstance(source.try_get_launch_description_without_context(), LaunchDescription)
    assert source.method == "interpreted YAML launch file"
