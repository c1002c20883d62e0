"""Tags in parameter files, which choose the type of a value in Lyrical."""

from tests.programs import lines_in

VALUES = {
    "!!str true": "'true'",
    "!!str 1": "'1'",
    "!!str": "''",
    "!!float 10": "10.0",
    '!!float "1e3"': "1000.0",
    "!!float abc": "Error parsing value abc at line 1",
    "!!int 0x10": "16",
    "!!int '7'": "7",
    "!!int 1.5": "Error parsing value 1.5 at line 1",
    "!!int 9223372036854775808": "Error parsing value 9223372036854775808 at line 1",
    "!!bool yes": "True",
    "!!bool 'off'": "False",
    "!!bool 1": "Error parsing value 1 at line 1",
    "!!binary aGk=": "[b'h', b'i']",
    "!!binary aGk": "Error parsing value aGk at line 1",
    "!!binary '*'": "Error parsing value * at line 1",
    "!!null x": 'Unsupport tag "tag:yaml.org,2002:null" at line 1',
    "!!timestamp 2026-01-01": 'Unsupport tag "tag:yaml.org,2002:timestamp" at line 1',
    "!own 1": 'Unsupport tag "!own" at line 1',
    "! 1": "1",
    "!!seq 1": "Error parsing value 1 at line 1",
    "!!seq [1, !!int '2']": "[1, 2]",
    "[!!float 1, 2.5]": "[1.0, 2.5]",
    "[!!str 1, 2]": "Sequence should be of same type. Value type 'integer' do not belong "
    "at line_num 1",
    "!!int [1]": 'Unsupport tag "tag:yaml.org,2002:int" at line 1',
    "!!binary [aGk=]": "Byte array must be encoded as a base64 string, not a sequence, "
    "cannot parse value aGk= at line 1",
}  # fmt: skip

READ = """
from rclpy.impl.rcl_yaml_param_parser import parse_value
for text in TEXTS:
    try:
        print(repr(parse_value(text)))
    except ValueError as error:
        print(error)
"""

NODE = """
import pathlib, rclpy, tempfile
with tempfile.TemporaryDirectory() as folder:
    file = pathlib.Path(folder, "p.yaml")
    parameters = "key: !!binary aGk=\\n    speed: !!float 2"
    file.write_text(f"n:\\n  ros__parameters: !!map\\n    {parameters}\\n")
    rclpy.init(args=["--ros-args", "--params-file", str(file), "-p", "name:=!!str 5"])
    node = rclpy.create_node("n", automatically_declare_parameters_from_overrides=True)
    for name in ("key", "speed", "name"):
        print(node.get_parameter(name).type_.name, node.get_parameter(name).value)
"""


def test_tags_choose_the_type_in_lyrical():
    program = READ.replace("TEXTS", repr(list(VALUES)))
    assert lines_in("lyrical", program) == list(VALUES.values())


def test_up_to_kilted_only_the_tag_of_strings_counts():
    texts = ["!!str true", "!!float 10", "!!bool 'off'", "!!null x", "!!binary aGk="]
    program = READ.replace("TEXTS", repr(texts))
    assert lines_in("kilted", program) == ["'true'", "10", "'off'", "'x'", "'aGk='"]


def test_a_node_has_the_parameters_of_tagged_values():
    values = ["BYTE_ARRAY [b'h', b'i']", "DOUBLE 2.0", "STRING 5"]
    assert lines_in("lyrical", NODE) == values
