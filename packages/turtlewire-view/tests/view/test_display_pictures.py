"""Each display in a real browser: what colour the picture has at known places."""

import base64
import copy
import io
import json
import struct

import numpy as np
import pytest
from PIL import Image

from .looking_down import (
    BLUE,
    GREEN,
    GROUND,
    LIMIT_MS,
    PIXELS,
    RED,
    REMOVE_ALL,
    WHITE,
    get,
    pose,
    stamped,
)

DAE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>
  <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="f" count="9">0 0 0 1 0 0 0 1 0</float_array>
      <technique_common><accessor source="#f" count="3" stride="3"><param name="X" type="float"/>
        <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common>
    </source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>"""


def painted_dae(unit, effect, images=""):
    """A square of 1 m that faces up, its corners in the unit [m], with its own effect."""
    corners = " ".join(f"{x / unit} {y / unit} 0" for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="own" meter="{unit}"/><up_axis>Y_UP</up_axis></asset>
  <library_images>{images}</library_images>
  <library_effects><effect id="e"><profile_COMMON>{effect}</profile_COMMON></effect>
  </library_effects>
  <library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
  <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="pf" count="12">{corners}</float_array>
      <technique_common><accessor source="#pf" count="4" stride="3"><param name="X" type="float"/>
        <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common>
    </source>
    <source id="n"><float_array id="nf" count="3">0 0 1</float_array>
      <technique_common><accessor source="#nf" count="1" stride="3"><param name="X" type="float"/>
        <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common>
    </source>
    <source id="t"><float_array id="tf" count="8">0 0 1 0 1 1 0 1</float_array>
      <technique_common><accessor source="#tf" count="4" stride="2"><param name="S" type="float"/>
        <param name="T" type="float"/></accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="2" material="s"><input semantic="VERTEX" source="#v" offset="0"/>
      <input semantic="NORMAL" source="#n" offset="1"/>
      <input semantic="TEXCOORD" source="#t" offset="2" set="0"/>
      <p>0 0 0 1 0 1 2 0 2 0 0 0 2 0 2 3 0 3</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="vs"><node><instance_geometry url="#g"><bind_material>
    <technique_common><instance_material symbol="s" target="#m">
      <bind_vertex_input semantic="UV" input_semantic="TEXCOORD" input_set="0"/>
    </instance_material></technique_common></bind_material></instance_geometry></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#vs"/></scene>
</COLLADA>"""


def diffuse(inner, params=""):
    return f"""{params}<technique sid="c"><lambert><diffuse>{inner}</diffuse></lambert>
        </technique>"""


GREEN_DAE = painted_dae(0.001, diffuse("<color>0 1 0 1</color>"))
IMAGE_DAE = painted_dae(
    1,
    diffuse(
        '<texture texture="sampler" texcoord="UV"/>',
        """<newparam sid="surface"><surface type="2D"><init_from>i</init_from></surface></newparam>
        <newparam sid="sampler"><sampler2D><source>surface</source></sampler2D></newparam>""",
    ),
    '<image id="i"><init_from>four.tif</init_from></image>',
)
_CORNERS = base64.b64encode(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)).decode()
GLTF = json.dumps(
    {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "rotation": [0, 0, 0, 1]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "buffers": [
            {"byteLength": 36, "uri": f"data:application/octet-stream;base64,{_CORNERS}"}
        ],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [
            {
                "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                "min": [0, 0, 0], "max": [1, 1, 0],
            }
        ],
    }
)  # fmt: skip

Point = get("geometry_msgs/msg/Point")
Color = get("std_msgs/msg/ColorRGBA")


def points(*places):
    return [Point(x=float(x), y=float(y), z=float(z)) for x, y, z in places]


def test_path(scene):
    PoseStamped = get("geometry_msgs/msg/PoseStamped")  # noqa: N806
    poses = [PoseStamped(pose=pose(x, y)) for x, y in ((-1, 0), (1, 0), (1, 2))]
    scene.show("path", stamped("nav_msgs/msg/Path", "base", poses=poses), width=0.2)
    line = (0x19, 255, 0)
    scene.expect(((1, 0, 0), line), ((2, 1, 0), line), ((1, 1, 0), GROUND))
    scene.set_option("color", "#0000ff")
    scene.expect(((1, 0, 0), BLUE))
    scene.page.evaluate(REMOVE_ALL)
    scene.expect_ground((1, 0, 0))


def cloud(places, colors):
    packed = np.array([r << 16 | g << 8 | b for r, g, b in colors], "u4").view("f4")
    rows = np.column_stack([np.array(places, "f4"), packed])
    Field = get("sensor_msgs/msg/PointField")  # noqa: N806
    fields = [
        Field(name=name, offset=4 * k, datatype=7, count=1)
        for k, name in enumerate(("x", "y", "z", "rgb"))
    ]
    return stamped(
        "sensor_msgs/msg/PointCloud2", "base", height=1, width=len(rows), fields=fields,
        point_step=16, row_step=16 * len(rows), data=rows.astype("f4").tobytes(),
    )  # fmt: skip


def test_point_cloud(scene):
    first = cloud([(0, 0, 0), (1, 1, 0)], [(255, 0, 0), (10, 20, 30)])
    scene.show("point_cloud", first, size=9)
    scene.expect(((1, 0, 0), RED), ((2, 1, 0), (10, 20, 30)), ((1, 1, 0), GROUND))
    scene.send(cloud([(0, 1, 0)], [(0, 0, 255)]))
    scene.expect(((1, 1, 0), BLUE), ((1, 0, 0), GROUND))


def test_laser_scan(scene):
    scan = stamped(
        "sensor_msgs/msg/LaserScan", "base", angle_min=0.0, angle_max=np.pi / 2,
        angle_increment=np.pi / 2, range_max=10.0, ranges=[1.0, 2.0],
    )  # fmt: skip
    scene.show("laser_scan", scan, size_metres=0.3, flat_color="#00ff00", color="flat")
    scene.expect(((2, 0, 0), GREEN), ((1, 2, 0), GREEN), ((1, 0, 0), GROUND))


def grid(cells):
    message = stamped("nav_msgs/msg/OccupancyGrid")
    message.info.width, message.info.height, message.info.resolution = 2, 2, 1.0
    message.info.origin = pose(-1, -1)
    message.data = cells
    return message


def test_occupancy_grid(scene):
    Update = get("map_msgs/msg/OccupancyGridUpdate")  # noqa: N806
    scene.show("occupancy_grid", grid([0, 100, -1, 50]), alpha=1.0)
    scene.expect(
        ((-0.5, -0.5, 0), WHITE), ((0.5, -0.5, 0), (0, 0, 0)), ((-0.5, 0.5, 0), (0x70, 0x89, 0x86)),
        ((0.5, 0.5, 0), (128, 128, 128)), ((1.5, 0, 0), GROUND),
    )  # fmt: skip
    scene.send(Update(x=1, y=1, width=1, height=1, data=[0]), "_updates")
    scene.expect(((0.5, 0.5, 0), WHITE), ((0.5, -0.5, 0), (0, 0, 0)))
    scene.set_option("color_scheme", "costmap")
    scene.expect(((0.5, -0.5, 0), (255, 0, 255)), ((0.5, 0.5, 0), GROUND))


def test_a_map_moves_with_its_frame(scene):
    message = grid([0, 0, 0, 0])
    message.header.frame_id = "carrier"
    scene.show("occupancy_grid", message, alpha=1.0)
    scene.expect_status("No transform from the map's frame 'carrier'")
    scene.source.put_frame("map", "carrier", (0, 0, 0))
    scene.expect(((0.5, 0, 0), WHITE), ((2.5, 0, 0), GROUND))
    scene.expect_no_status("No transform")
    scene.source.put_frame("map", "carrier", (2, 0, 0))
    scene.expect(((0.5, 0, 0), GROUND), ((2.5, 0, 0), WHITE))


#: Removes all displays; how many geometries, materials and textures were not freed, and were there.
LEFT_AFTER_REMOVAL = f"""async () => {{
    const {{ stage }} = await import("./js/main.js");
    const held = new Set();
    stage.view.displays.traverse(({{ geometry, material }}) => {{
        const uniforms = Object.values(material?.uniforms ?? {{}}).map(({{ value }}) => value);
        for (const each of [geometry, material, material?.map, ...uniforms]) {{
            if (each?.dispose) held.add(each);
        }}
    }});
    const count = held.size;
    for (const each of held) each.addEventListener("dispose", () => held.delete(each));
    await ({REMOVE_ALL})();
    return [held.size, count];
}}"""


@pytest.mark.parametrize("kind", ["occupancy_grid", "path", "marker"])
def test_a_removed_display_leaves_nothing_on_the_graphics_card(scene, kind):
    PoseStamped = get("geometry_msgs/msg/PoseStamped")  # noqa: N806
    MarkerArray = get("visualization_msgs/msg/MarkerArray")  # noqa: N806
    shapes = copy.deepcopy([message for message, _, _ in MARKERS.values()])
    for key, message in enumerate(shapes):
        message.id = key
    poses = [PoseStamped(pose=pose(x, 0)) for x in (-1, 1)]
    message = {
        "occupancy_grid": grid([0, 0, 0, 0]),
        "path": stamped("nav_msgs/msg/Path", poses=poses),
        "marker": MarkerArray(markers=shapes),
    }[kind]
    scene.show(kind, message, **({"pose_style": "axes"} if kind == "path" else {}))
    scene.wait_until(
        """async () => {
            const { stage } = await import("./js/main.js");
            let count = 0;
            stage.view.displays.traverse(({ geometry }) => { count += geometry ? 1 : 0; });
            return count > 0;
        }"""
    )
    left, count = scene.page.evaluate(LEFT_AFTER_REMOVAL)
    assert count >= 3
    assert left == 0


def marker(kind, key=1, at=(0, 0, 0), scale=(1, 1, 1), color=(1, 0, 0), **values):
    message = stamped("visualization_msgs/msg/Marker", "base", type=kind, ns="n", id=key)
    message.pose = pose(*at)
    message.scale.x, message.scale.y, message.scale.z = map(float, scale)
    message.color.r, message.color.g, message.color.b = map(float, color)
    message.color.a = 1.0
    for name, value in values.items():
        setattr(message, name, value)
    return message


#: Marker, places that it covers, places beside it, all in the frame `base`.
MARKERS = {
    "arrow": (marker(0, scale=(2, 0.6, 0.6)), [(0.5, 0, 0), (1.7, 0.2, 0)], [(0.5, 0.5, 0)]),
    "arrow between points": (
        marker(0, scale=(0.4, 0.8, 0.5), points=points((0, -1, 0), (0, 1, 0))),
        [(0, -0.5, 0), (0.2, 0.6, 0)], [(0.35, -0.5, 0), (1, 0, 0)],
    ),
    "cube": (marker(1, scale=(2, 1, 1)), [(0.8, 0.4, 0.5)], [(0, 0.7, 0)]),
    "sphere": (marker(2), [(0, 0, 0), (0.3, 0.3, 0)], [(0.45, 0.45, 0)]),
    "cylinder": (marker(3), [(0, 0, 0), (0.3, 0.3, 0)], [(0.45, 0.45, 0)]),
    "line strip": (
        marker(4, scale=(0.3, 0, 0), points=points((-1, 0, 0), (1, 0, 0), (1, 1, 0))),
        [(0, 0, 0), (1, 0.5, 0)], [(0, 0.5, 0)],
    ),
    "line list": (
        marker(5, scale=(0.3, 0, 0), points=points((-1, 0, 0), (1, 0, 0), (-1, 1, 0), (1, 1, 0))),
        [(0, 0, 0), (0, 1, 0)], [(0, 0.5, 0), (1, 0.5, 0)],
    ),
    "cube list": (
        marker(6, scale=(0.5, 0.5, 0.5), points=points((0, 0, 0), (1, 0, 0))),
        [(0.2, 0.2, 0), (1.2, 0.2, 0)], [(0.5, 0, 0)],
    ),
    "sphere list": (
        marker(7, scale=(0.5, 0.5, 0.5), points=points((0, 0, 0), (1, 0, 0))),
        [(0.1, 0.1, 0), (1.1, 0.1, 0)], [(0.22, 0.22, 0), (0.5, 0, 0)],
    ),
    "points": (
        marker(8, scale=(0.5, 0.5, 0), points=points((0, 0, 0), (1, 0, 0))),
        [(0.2, 0.2, 0), (1.2, 0, 0)], [(0.5, 0, 0)],
    ),
    "text": (marker(9, scale=(0, 0, 3), text="I"), [(0, 0, 0)], [(1.5, 0, 0)]),
    "triangle list": (
        marker(11, points=points((0, 0, 0), (1, 0, 0), (0, 1, 0))),
        [(0.2, 0.2, 0)], [(0.7, 0.7, 0)],
    ),
    "arrow strip": (
        marker(12, scale=(0.3, 0.6, 0.3), points=points((-1, 0, 0), (0, 0, 0), (0, 1, 0))),
        [(-0.5, 0, 0), (0, 0.5, 0)], [(-0.5, 0.5, 0)],
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", MARKERS)
def test_marker(scene, name):
    message, on, off = MARKERS[name]
    on, off = ([(x + 1, y, z) for x, y, z in places] for places in (on, off))
    scene.show("marker", message)
    scene.expect_red(*on)
    scene.expect_ground(*off)
    delete = marker(0)
    delete.action = 2
    scene.send(delete)
    scene.expect_ground(*on, *off)


def test_colors_of_points(scene):
    colors = [Color(g=1.0, a=1.0), Color(b=1.0, a=1.0)]
    places = points((0, 0, 0), (1, 0, 0))
    scene.show("marker", marker(8, scale=(0.5, 0.5, 0), points=places, colors=colors))
    scene.expect(((1, 0, 0), GREEN), ((2, 0, 0), BLUE))


def test_an_array_with_lifetimes_and_hidden_namespaces(scene):
    passing = marker(8, key=1, scale=(0.5, 0.5, 0), points=points((0, 0, 0)))
    passing.lifetime.sec = 1
    other = marker(8, key=2, scale=(0.5, 0.5, 0), points=points((1, 0, 0)), ns="walls")
    MarkerArray = get("visualization_msgs/msg/MarkerArray")  # noqa: N806
    scene.show("marker", MarkerArray(markers=[passing, other]))
    scene.expect(((2, 0, 0), RED))
    scene.expect(((1, 0, 0), GROUND), ((2, 0, 0), RED))
    scene.set_option("hidden", "^wall")
    scene.expect_ground((2, 0, 0))


def test_a_marker_on_a_frame_moves_with_it(scene):
    message = marker(8, scale=(0.5, 0.5, 0), points=points((0, 0, 0)), frame_locked=True)
    message.header.frame_id = "cart"
    scene.source.put_frame("map", "cart", (0, 2, 0))
    scene.show("marker", message)
    scene.expect(((0, 2, 0), RED))
    scene.source.put_frame("map", "cart", (0, -2, 0))
    scene.expect(((0, -2, 0), RED), ((0, 2, 0), GROUND))


def bmp(rows):
    """An image file of rows of colours, each ``(r, g, b)``."""
    lines = [b"".join(bytes(color[::-1]) for color in row) for row in rows[::-1]]
    pixels = b"".join(line + bytes(-len(line) % 4) for line in lines)
    head = struct.pack("<IiiHH24x", 40, len(rows[0]), len(rows), 1, 24)
    return b"BM" + struct.pack("<IHHI", 54 + len(pixels), 0, 0, 54) + head + pixels


def tiff(rows):
    """The same as a TIFF file."""
    file = io.BytesIO()
    Image.fromarray(np.array(rows, np.uint8)).save(file, "TIFF")
    return file.getvalue()


def textured(name, **values):
    """A square of 2 m, on which the image's first row lies in the north."""
    UV = get("visualization_msgs/msg/UVCoordinate")  # noqa: N806
    corners = [(-1, -1), (1, -1), (1, 1), (-1, -1), (1, 1), (-1, 1)]
    return marker(
        11, points=points(*[(x, y, 0) for x, y in corners]), color=(1, 1, 1),
        uv_coordinates=[UV(u=(x + 1) / 2, v=(1 - y) / 2) for x, y in corners],
        texture_resource=name, **values,
    )  # fmt: skip


#: Four colours, the red one in the north-west.
IMAGE = bmp([[RED, BLUE], [GREEN, BLUE]])


def expect_image(scene):
    scene.expect_red((0.5, 0.5, 0))
    scene.expect(((1.5, 0.5, 0), BLUE), ((1.5, -0.5, 0), BLUE), tolerance=110)
    scene.expect(((0.5, -0.5, 0), GREEN), tolerance=110)


def test_a_texture_comes_with_the_marker(scene):
    message = textured("embedded://four")
    message.texture.data = IMAGE
    scene.show("marker", message)
    expect_image(scene)
    message.texture.data = bmp([[RED]])
    scene.send(message)
    scene.expect_red((0.5, -0.5, 0), (1.5, 0.5, 0))


@pytest.mark.usefixtures("package")
def test_a_texture_of_a_package(scene):
    scene.show("marker", textured("package://arm/meshes/four.bmp"))
    expect_image(scene)


@pytest.mark.usefixtures("package")
def test_a_texture_that_browsers_do_not_read(scene):
    scene.show("marker", textured("package://arm/meshes/four.tif"))
    expect_image(scene)


def test_a_texture_that_is_none(scene):
    message = textured("embedded://four")
    message.texture.data = b"no image"
    scene.show("marker", message)
    scene.expect_status("marker n/1: 'embedded://four' is not an image that this browser can read")


def stl(*triangles, normal=(0, 0, 1)):
    """A binary STL file."""
    data = bytes(80) + struct.pack("<I", len(triangles))
    for triangle in triangles:
        data += struct.pack("<12fH", *normal, *np.ravel(triangle), 0)
    return data


@pytest.fixture
def package(meshes):
    """The package ``arm`` with a mesh: a triangle on the ground."""
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    (meshes / "flat.stl").write_bytes(stl(corners))
    (meshes / "no_normals.stl").write_bytes(stl(corners, normal=(0, 0, 0)))
    (meshes / "four.bmp").write_bytes(IMAGE)
    (meshes / "flat.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (meshes / "painted.obj").write_text(
        "mtllib paints.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0.25 0.75\n"
        "o a\nusemtl green\nf 1 2 3\no b\nusemtl image\nf 2/1 4/1 3/1\n"
    )
    (meshes / "paints.mtl").write_text("newmtl green\nKd 0 1 0\nnewmtl image\nmap_Kd four.bmp\n")
    (meshes / "lost.obj").write_text("mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (meshes / "flat.dae").write_text(DAE)
    (meshes / "flat.gltf").write_text(GLTF)
    (meshes / "green.dae").write_text(GREEN_DAE)
    (meshes / "image.dae").write_text(IMAGE_DAE)
    (meshes / "four.tif").write_bytes(tiff([[RED, BLUE], [GREEN, BLUE]]))
    (meshes / "broken.stl").write_bytes(stl(corners)[:90])
    (meshes / "broken.dae").write_text("<img src=x>")


@pytest.mark.usefixtures("package")
@pytest.mark.parametrize(
    "name", ["flat.stl", "no_normals.stl", "flat.obj", "flat.dae", "flat.gltf"]
)
def test_a_mesh(scene, name):
    message = marker(10, scale=(2, 1, 1), mesh_resource=f"package://arm/meshes/{name}")
    scene.show("marker", message)
    scene.expect_red((1.2, 0.2, 0), (2.2, 0.2, 0))
    scene.expect_ground((2.5, 0.8, 0))


@pytest.mark.usefixtures("package")
def test_materials_of_an_obj_file(scene):
    message = marker(10, scale=(2, 1, 1), mesh_resource="package://arm/meshes/painted.obj")
    message.mesh_use_embedded_materials = True
    scene.show("marker", message)
    scene.expect(((1.2, 0.2, 0), GREEN), tolerance=110)
    scene.expect_red((2.6, 0.8, 0))


@pytest.mark.usefixtures("package")
def test_lost_materials_of_an_obj_file(scene, shown_page):
    scene.show("marker", marker(10, mesh_resource="package://arm/meshes/lost.obj"))
    scene.expect_red((1.2, 0.2, 0))
    scene.expect_status("'package://arm/meshes/lost.obj' needs 'none.mtl', which cannot be")
    (answer,) = shown_page[2]  # the browser itself tells of the file that there is not
    assert "404" in answer
    shown_page[2].clear()


@pytest.mark.usefixtures("package")
@pytest.mark.parametrize("name", ["broken.stl", "broken.dae"])
def test_a_mesh_of_nonsense(scene, name):
    scene.show("marker", marker(10, mesh_resource=f"package://arm/meshes/{name}"))
    scene.expect_status(f"marker n/1: 'package://arm/meshes/{name}'")


def test_an_embedded_mesh(scene):
    message = marker(10, mesh_resource="embedded://flat.stl")
    message.mesh_file.filename = "flat.stl"
    message.mesh_file.data = stl([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
    scene.show("marker", message)
    scene.expect_red((1.2, 0.2, 0))


ROBOT = """<robot name="arm">
  <material name="red"><color rgba="1 0 0 1"/></material>
  <link name="base">
    <visual><origin xyz="-1 0 0"/><geometry><box size="1 2 0.5"/></geometry>
      <material name="red"/></visual>
    <collision><origin xyz="0 -2 0"/><geometry><sphere radius="0.5"/></geometry></collision>
  </link>
  <link name="tip">
    <visual><geometry><mesh filename="package://arm/meshes/flat.stl" scale="-1 1 1"/></geometry>
      <material name="red"/></visual>
    <visual><origin xyz="1 0 0"/><geometry><cylinder radius="0.3" length="1"/></geometry>
      <material name="red"/></visual>
    <visual><geometry><mesh filename="package://arm/meshes/none.stl"/></geometry></visual>
  </link>
  <link name="lost"><visual><geometry><sphere radius="1"/></geometry></visual></link>
  <joint name="a" type="fixed"><parent link="base"/><child link="tip"/></joint>
  <joint name="b" type="fixed"><parent link="base"/><child link="lost"/></joint>
</robot>"""


@pytest.mark.usefixtures("package")
def test_robot_model(scene):
    scene.topic = "/robot_description"
    scene.show("robot_model", get("std_msgs/msg/String")(data=ROBOT))
    scene.expect_red((0.2, 0.7, 0), (-0.2, -0.7, 0))  # the box at base
    scene.expect_red((0.8, 1.2, 0))  # the mirrored mesh at tip
    scene.expect_red((2, 1, 0))  # the cylinder at tip
    scene.expect_ground((1, -2, 0), (0, 1.4, 0))
    scene.expect_status("has no file 'meshes/none.stl'")
    scene.set_option("collision", True)
    scene.wait_until(f"async () => (await ({PIXELS})([[1, -2, 0]]))[0][2] < 200")
    scene.set_option("visual", False)
    scene.expect_ground((0.2, 0.7, 0), (2, 1, 0))


def show_meshes(scene, *visuals):
    """A robot of ``(x, file, scale, material)`` in ``base``."""
    shapes = "".join(
        f"""<visual><origin xyz="{x} 0 0"/><geometry><mesh
        filename="package://arm/meshes/{file}" scale="{scale}"/></geometry>{material}</visual>"""
        for x, file, scale, material in visuals
    )
    text = f"""<robot name="r"><link name="base">{shapes}</link></robot>"""
    scene.topic += "/robot_description"
    scene.show("robot_model", get("std_msgs/msg/String")(data=text))


@pytest.mark.usefixtures("package")
def test_millimetres_and_materials_of_a_dae_file(scene):
    red = '<material name="own"><color rgba="1 0 0 1"/></material>'
    show_meshes(scene, (-1, "green.dae", "1 1 1", ""), (0, "green.dae", "2 0.5 1", red))
    scene.expect(((0.1, 0.1, 0), GREEN), ((0.9, 0.9, 0), GREEN), tolerance=110)
    scene.expect_red((1.1, 0.4, 0), (2.9, 0.4, 0))
    scene.expect_ground((0.5, 1.1, 0), (-0.1, 0.5, 0), (1.5, 0.6, 0), (3.1, 0.4, 0))


@pytest.mark.usefixtures("package")
def test_an_image_of_a_dae_file_that_browsers_do_not_read(scene):
    show_meshes(scene, (0, "image.dae", "2 2 1", ""))
    scene.expect_red((1.5, 1.5, 0))  # between the edges of the picture's four pixels
    scene.expect(((2.5, 1.5, 0), BLUE), ((2.5, 0.5, 0), BLUE), tolerance=110)
    scene.expect(((1.5, 0.5, 0), GREEN), tolerance=110)


@pytest.mark.usefixtures("package")
def test_a_dae_file_without_materials_has_the_colour_of_what_has_none(scene):
    show_meshes(scene, (0, "flat.dae", "1 1 1", ""))
    scene.expect_red((1.2, 0.2, 0))


def test_a_link_without_a_frame_is_named(scene):
    scene.topic = "/other/robot_description"
    lost = """<robot name="r"><link name="nowhere">
        <visual><geometry><sphere radius="1"/></geometry></visual></link></robot>"""
    scene.show("robot_model", get("std_msgs/msg/String")(data=lost))
    scene.expect_status("No transform from [nowhere]")


def test_pose_and_covariance(scene):
    message = stamped("geometry_msgs/msg/PoseWithCovarianceStamped", "base")
    message.pose.pose = pose(0, 0)
    message.pose.covariance[0] = message.pose.covariance[7] = 1.0
    scene.show("pose", message)
    scene.expect_red((1.3, 0, 0), (1.9, 0, 0))
    violet = "async () => { const [[r, g, b]] = await (" + PIXELS + ")([[1, -0.8, 0]]); "
    scene.wait_until(violet + "return g < r - 20 && g < b - 20; }")
    scene.set_option("show_covariance", False)
    scene.expect_ground((1, -0.8, 0))
    scene.send(stamped("geometry_msgs/msg/PoseWithCovarianceStamped", "tip"))
    scene.expect_red((1.3, 1, 0))
    scene.expect_ground((1.3, 0, 0))


def test_odometry(scene):
    def odometry(x):
        message = stamped("nav_msgs/msg/Odometry", "base")
        message.pose.pose = pose(x, 1)
        return message

    scene.show("odometry", odometry(-3), keep=2)
    scene.expect_red((-1.7, 1, 0))
    scene.send(odometry(-1))
    scene.expect_red((-1.7, 1, 0), (0.3, 1, 0))
    scene.send(odometry(1))
    scene.expect_red((0.3, 1, 0), (2.3, 1, 0))
    scene.expect_ground((-1.7, 1, 0))


def test_pose_array(scene):
    message = stamped("geometry_msgs/msg/PoseArray", "base", poses=[pose(0, 0), pose(0, 2)])
    scene.show("pose_array", message, length=2)
    scene.expect_red((1.5, 0, 0), (1.5, 2, 0))
    scene.expect_ground((1.5, 1, 0))
    scene.set_option("shape", "axes")
    scene.wait_until(
        f"""async () => {{
            const [[r, g, b]] = await ({PIXELS})([[1, 1, 0]]);
            return g > r && g > b;
        }}"""
    )


def test_polygon(scene):
    Point32 = get("geometry_msgs/msg/Point32")  # noqa: N806
    message = stamped("geometry_msgs/msg/PolygonStamped", "base")
    message.polygon.points = [Point32(x=x, y=y) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
    scene.show("polygon", message, color="#0000ff")
    scene.expect(((1.5, 0, 0), BLUE), ((2, 0.5, 0), BLUE), ((1, 0.5, 0), BLUE))
    scene.expect_ground((1.5, 0.5, 0))


def test_point(scene):
    message = stamped("geometry_msgs/msg/PointStamped", "base")
    message.point = points((0, 2, 0))[0]
    scene.show("point", message, color="#ff0000", radius=0.5)
    scene.expect_red((1, 2, 0), (1.3, 2, 0))
    scene.expect_ground((1.6, 2, 0))


def test_range(scene):
    message = stamped("sensor_msgs/msg/Range", "base", range=2.0, max_range=3.0, field_of_view=1.0)
    scene.show("range", message, color="#ff0000", alpha=1.0)
    scene.expect_red((2, 0, 0), (2.8, 0.8, 0))
    scene.expect_ground((1.3, 0.4, 0), (3.2, 0, 0))


#: The colour in the middle of the picture in the window.
WINDOW_COLOR = """([r, g, b]) => {
    const canvas = document.querySelector(".image-window canvas");
    if (!canvas?.width) return false;
    const at = [canvas.width >> 1, canvas.height >> 1];
    const seen = canvas.getContext("2d").getImageData(...at, 1, 1).data;
    return Math.max(...[r, g, b].map((value, k) => Math.abs(value - seen[k]))) < 12;
}"""


def test_image(scene):
    pixels = np.full((6, 8, 3), (10, 200, 30), np.uint8)
    message = stamped("sensor_msgs/msg/Image", "lens", height=6, width=8, step=24)
    message.encoding, message.data = "rgb8", pixels.tobytes()
    scene.show("image", message)
    scene.page.wait_for_function(WINDOW_COLOR, arg=[10, 200, 30], timeout=LIMIT_MS)
    assert scene.page.inner_text(".image-window figcaption").endswith("6 · rgb8 · lens")
    scene.page.evaluate(REMOVE_ALL)
    assert scene.page.query_selector(".image-window") is None


@pytest.mark.parametrize("form", ["png", "jpeg"])
def test_compressed_image(scene, form):
    picture = scene.page.evaluate(
        """async (form) => {
            const canvas = new OffscreenCanvas(16, 16);
            const ink = canvas.getContext("2d");
            ink.fillStyle = "rgb(20, 40, 220)";
            ink.fillRect(0, 0, 16, 16);
            const blob = await canvas.convertToBlob({ type: `image/${form}`, quality: 1 });
            return [...new Uint8Array(await blob.arrayBuffer())];
        }""",
        form,
    )
    scene.show("image", stamped("sensor_msgs/msg/CompressedImage", format=form, data=picture))
    scene.page.wait_for_function(WINDOW_COLOR, arg=[20, 40, 220], timeout=LIMIT_MS)


def test_a_picture_that_is_none(scene):
    data = bytes.fromhex("ffd8ff") + b"nonsense"
    scene.show("image", stamped("sensor_msgs/msg/CompressedImage", format="jpeg", data=data))
    scene.expect_status("The browser cannot read this image/jpeg")


def test_names_with_markup_stay_text(scene):
    message = marker(1, ns="<img src=x onerror=window.hacked=1>", color=(0, 0, 0))
    message.color.a = 0.0
    scene.show("marker", message)
    scene.expect_status("marker <img src=x onerror=window.hacked=1>/1: the marker is invisible")
    assert scene.page.evaluate("window.hacked") is None


def test_a_wrench(scene):
    message = stamped("geometry_msgs/msg/WrenchStamped", "base")
    message.wrench.force.x, message.wrench.torque.y = 1.0, -1.0
    scene.show("twist_or_wrench", message, width=3, hide_small_values=False)
    scene.expect_red((1.5, 0, 0), (2.4, 0, 0))
    yellow = f"""async () => {{
        const [[r, g, b], ring] = await ({PIXELS})([[1, -0.6, 0], [1.5, -1, 0]]);
        return r > b + 60 && g > b + 60 && ring[0] > ring[2] + 60;
    }}"""
    scene.wait_until(yellow)
    scene.expect_ground((1, 0.6, 0), (-1, 0, 0))
    message.wrench.force.x, message.wrench.torque.y = 0.0005, 0.0
    scene.set_option("hide_small_values", True)
    scene.send(message)
    scene.expect_ground((1, 0, 0), (1.5, 0, 0), (1, -0.6, 0))


def test_a_temperature(scene):
    message = stamped("sensor_msgs/msg/Temperature", "base", temperature=100.0)
    scene.show("measurement", message, size=1, text_size=0)
    scene.expect_red((1, 0, 0), (1.3, 0, 0))
    scene.expect_ground((1.7, 0, 0))
    scene.set_option("text_size", 1)
    ink = f"async () => (await ({PIXELS})([...Array(60).keys()].map((k) => [k / 20 - 1, 0, 0])))"
    scene.wait_until(f"{ink}.some(([r, g, b]) => Math.max(r, g, b) < 200 && Math.abs(r - b) < 20)")


def test_grid_cells(scene):
    message = stamped(
        "nav_msgs/msg/GridCells", "base", cell_width=1.0, cell_height=0.5,
        cells=points((0, 0, 0), (1, 1, 0)),
    )  # fmt: skip
    scene.show("grid_cells", message, color="#ff0000")
    scene.expect_red((0.6, 0.2, 0), (1.4, 0.2, 0), (2.4, 1.2, 0))
    scene.expect_ground((0.4, 0, 0), (1, 0.35, 0), (1, 1, 0))


def test_camera_info(scene):
    k = [100.0, 0, 100.0, 0, 100.0, 50.0, 0, 0, 1.0]
    message = stamped("sensor_msgs/msg/CameraInfo", "base", width=200, height=100, k=k)
    scene.show("camera_info", message, color="#ff0000", alpha=1, show_edges=False)
    scene.expect(((1.8, 0.4, 0), RED), ((0.2, -0.4, 0), RED), ((1, 0.6, 0), GROUND))
    scene.set_option("far", 2)
    scene.expect(((1, 0.9, 0), RED), ((1, 1.1, 0), GROUND))
    scene.set_option("show_polygons", False)
    scene.expect_ground((1, 0.9, 0))
    scene.set_option("edge_color", "#0000ff")
    scene.set_option("show_edges", True)
    scene.expect(((1, 1, 0), BLUE))
