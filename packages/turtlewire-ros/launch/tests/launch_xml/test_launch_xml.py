"""Launch files in XML."""

import pytest

from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.frontend import Entity as BaseEntity
from launch_xml import Parser
from launch_xml.launch_description_sources import XMLLaunchDescriptionSource


@pytest.fixture
def entity(tmp_path):
    def load(text):
        path = tmp_path / "x.launch.xml"
        path.write_text(text)
        return Parser.load(str(path))[0]

    return load


def test_attributes(entity):
    element = entity(
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


def test_attributes_that_are_missing_or_of_another_type(entity):
    element = entity("<launch a='x'/>")
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


def test_unrequested_files_are_rejected(entity):
    with pytest.raises(ValueError, match=r"Unexpected attribute\(s\) found in `launch`: {'a'}"):
        entity("<launch a='x'/>").assert_entity_completely_parsed()
    with pytest.raises(
        ValueError, match=r"Unexpected nested entity\(ies\) found in `launch`: {'b'}"
    ):
        entity("<launch><b/></launch>").assert_entity_completely_parsed()


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
        Parser.load(str(tmp_path / "x.launch.xml"))


def test_a_malformed_file_is_named_with_its_line(tmp_path):
    (tmp_path / "x.launch.xml").write_text("<launch>\n<log message='a' message='b'/>\n</launch>")
    with pytest.raises(SyntaxError) as caught:
        Parser.load(str(tmp_path / "x.launch.xml"))
    assert str(caught.value) == "duplicate attribute: line 2, column 17 (x.launch.xml, line 2)"


def test_a_file_that_is_nested_too_deeply(tmp_path):
    path = tmp_path / "x.launch.xml"
    path.write_text("<launch>" + "<group>" * 50_000 + "</group>" * 50_000 + "</launch>")
    with pytest.raises(SyntaxError, match=r"^nested too deeply \(x\.launch\.xml\)$"):
        Parser.load(str(path))


def test_the_source_reads_only_xml(tmp_path):
    (tmp_path / "x.launch.xml").write_text("<launch><log message='a'/></launch>")
    source = XMLLaunchDescriptionSource(str(tmp_path / "x.launch.xml"))
    assert isinstance(source.try_get_launch_description_without_context(), LaunchDescription)
    assert source.method == "interpreted XML launch file"
    assert isinstance(
        IncludeLaunchDescription(source).describe_sub_entities()[0], LaunchDescription
    )
