"""Where packages are found: named, around a URDF file, in the ament index."""

import argparse
import io

import numpy as np
import pytest
from PIL import Image

from turtlewire.urdf import Robot
from turtlewire_view import meshes
from turtlewire_view.displays.robot_model import RobotModelDisplay
from turtlewire_view.meshes import MeshFile, MeshLibrary, mesh_address
from turtlewire_view.package_folders import PackageFolders, add_package_option
from turtlewire_view.robots import find_robot

URDF = """<robot name="arm"><link name="base">
  <visual><geometry><mesh filename="{mesh}"/></geometry></visual></link></robot>"""


@pytest.fixture
def ws(tmp_path, monkeypatch):
    """``src`` with the packages ``arm`` (in the folder ``arm-main``) and ``arm_meshes``."""
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    for folder, name in (("src/arm-main", "arm"), ("src/arm_meshes", "arm_meshes")):
        (tmp_path / folder / "meshes").mkdir(parents=True)
        (tmp_path / folder / "meshes/tip.stl").write_text(folder)
        (tmp_path / folder / "package.xml").write_text(
            f"<?xml version='1.0'?><package format='3'>\n  <name> {name}\n</name></package>"
        )
    (tmp_path / "src/arm-main/urdf").mkdir()
    (tmp_path / "src/arm-main/urdf/arm.urdf").touch()
    (tmp_path / "src/arm-main/urdf/near.obj").touch()
    return tmp_path / "src"


def served(uri, packages, **options):
    """The file that the page gets for an address."""
    address = mesh_address(uri, packages, **options)
    assert address.url is not None, address.problem
    library = MeshLibrary()
    library.permit(address.packages)
    found = library.find(address.url)
    assert isinstance(found, MeshFile), found
    return found.path


def test_packages_around_a_urdf_file_need_no_index(ws):
    around = PackageFolders(file=str(ws / "arm-main/urdf/arm.urdf"))
    for name, folder in (("arm", "arm-main"), ("arm_meshes", "arm_meshes")):
        uri = f"package://{name}/meshes/tip.stl"
        assert served(uri, around) == str(ws / folder / "meshes/tip.stl")
        assert "there is no package" in mesh_address(uri, PackageFolders()).problem
    assert around.folder("leg") is None


def test_a_folder_of_the_name_above_the_file_is_the_package_if_no_xml_is(ws):
    (ws / "arm-main/package.xml").unlink()
    around = PackageFolders(file=str(ws / "arm-main/urdf/arm.urdf"))
    assert around.folder("arm-main") == str(ws / "arm-main")
    assert around.folder("arm") is None


def test_a_named_folder_comes_first_and_is_what_an_error_asks_for(ws):
    named = PackageFolders({"arm": str(ws / "arm_meshes")}, str(ws / "arm-main/urdf/arm.urdf"))
    uri = "package://arm/meshes/tip.stl"
    assert served(uri, named) == str(ws / "arm_meshes/meshes/tip.stl")
    problem = mesh_address("package://leg/a.stl", named).problem
    assert problem.endswith("to say where it is, start with --package leg=FOLDER")


@pytest.mark.parametrize(
    ("uri", "file"),
    [
        ("near.obj", "arm-main/urdf/near.obj"),
        ("../meshes/tip.stl", "arm-main/meshes/tip.stl"),
        ("../../arm_meshes/meshes/tip.stl", "arm_meshes/meshes/tip.stl"),
        ("file://{ws}/arm-main/meshes/tip.stl", "arm-main/meshes/tip.stl"),
        ("{ws}/arm-main/meshes/tip.stl", "arm-main/meshes/tip.stl"),
    ],
)
@pytest.mark.parametrize("has_xml", [True, False])
def test_paths_in_a_urdf_file(ws, uri, file, has_xml):
    if not has_xml:
        for xml in ws.glob("*/package.xml"):
            xml.unlink()
    around = PackageFolders(file=str(ws / "arm-main/urdf/arm.urdf"))
    assert served(uri.format(ws=ws), around) == str(ws / file)


def test_images_beside_the_meshes_of_a_file_are_served(ws):
    (ws / "arm-main/package.xml").unlink()
    (ws / "arm-main/skin.png").touch()
    address = mesh_address(
        "../meshes/tip.stl", PackageFolders(file=str(ws / "arm-main/urdf/arm.urdf"))
    )
    library = MeshLibrary()
    library.permit(address.packages)
    url = address.url.replace("meshes/tip.stl", "skin.png")
    assert library.find(url).path == str(ws / "arm-main/skin.png")
    (folder,) = (folder for _, folder in address.packages)
    assert folder == str(ws / "arm-main")


@pytest.mark.parametrize("uri", ["../../../.ssh/id.stl", ".hidden.stl", "/etc/passwd", "a.stl"])
def test_paths_that_are_refused(ws, uri):
    address = mesh_address(uri, PackageFolders(file=str(ws / "arm-main/urdf/arm.urdf")))
    assert address.url is None
    assert address.problem.startswith(f"'{uri}' is not loaded: ")


def test_the_display_of_a_file_searches_around_it(ws):
    file = ws / "arm-main/urdf/arm.urdf"
    file.write_text(URDF.format(mesh="package://arm_meshes/meshes/tip.stl"))
    display = RobotModelDisplay({"source": "file", "description_file": str(file)})
    content, status = display.start()
    assert status.text == ""
    assert content.packages == (("arm_meshes", str(ws / "arm_meshes")),)


def test_a_robot_of_a_path(ws, monkeypatch):
    file = ws / "arm-main/urdf/arm.urdf"
    file.write_text(URDF.format(mesh="package://arm/meshes/tip.stl"))
    monkeypatch.chdir(file.parent)
    robot, packages = find_robot("arm.urdf", {"leg": str(ws)})
    assert robot == Robot.load(file)
    assert packages.folder("arm") == str(ws / "arm-main")
    assert packages.folder("leg") == str(ws)


def test_words_of_the_option(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("HOME", str(tmp_path))
    parser = argparse.ArgumentParser()
    add_package_option(parser)
    words = ["--package", f"arm={tmp_path}", "--package", "leg=~"]
    assert parser.parse_args(words).package == [("arm", str(tmp_path)), ("leg", str(tmp_path))]
    for text, why in (
        ("arm", "'arm' is not NAME=FOLDER"),
        ("arm=", "'arm=' is not NAME=FOLDER"),
        ("=x", "'=x' is not NAME=FOLDER"),
        ("../a=x", "'../a=x' is not NAME=FOLDER"),
        ("arm=none", "'none', given for the package arm, is no folder"),
    ):
        with pytest.raises(SystemExit):
            parser.parse_args(["--package", text])
        assert why in capsys.readouterr().err


def test_tiff_files_are_served_as_png(tmp_path, caplog):
    pixels = np.random.default_rng(7).integers(0, 256, (6, 8, 4), np.uint8)
    Image.fromarray(pixels).save(tmp_path / "skin.TIF", "TIFF", compression="tiff_lzw")
    (tmp_path / "torn.tif").write_bytes(b"II*\0")
    library = MeshLibrary()
    library.permit([("arm", str(tmp_path))])
    content, media_type = library.answer("/mesh/arm/skin.TIF")
    assert media_type == "image/png"
    with Image.open(io.BytesIO(content), formats=["PNG"]) as image:
        assert np.array_equal(np.asarray(image), pixels)
    assert library.answer("/mesh/arm/torn.tif") is None
    assert "The page did not get /mesh/arm/torn.tif: the TIFF file cannot be read: " in caplog.text


def test_tiff_files_without_pillow_say_what_to_install(tmp_path, monkeypatch, caplog):
    (tmp_path / "skin.tif").write_bytes(b"II*\0")
    monkeypatch.setattr(meshes, "find_spec", lambda _: None)
    advice = "needs Pillow: pip install 'turtlewire-view[tiff]'"
    address = mesh_address(
        "package://arm/skin.tif", PackageFolders({"arm": str(tmp_path)}), texture=True
    )
    assert address.problem == f"'package://arm/skin.tif' is not loaded: 'skin.tif' {advice}"
    library = MeshLibrary()
    library.permit([("arm", str(tmp_path))])
    assert library.answer("/mesh/arm/skin.tif") is None
    assert advice in caplog.text
