"""What a display's panel offers: where a robot comes from, links, namespaces, another topic."""

# ruff: noqa: F811 - fixtures are imported

from .looking_down import get, pose, scene, shown_page, stamped  # noqa: F401 - fixtures

ROBOT = """<robot name="r">
  <link name="base">
    <visual><origin xyz="1 0 0"/><geometry><box size="1 1 0.2"/></geometry>
      <material name="red"><color rgba="1 0 0 1"/></material></visual>
    <inertial><origin xyz="-2 0 0"/><mass value="6000"/>
      <inertia ixx="1000" iyy="1000" izz="1000" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="tip">
    <visual><origin xyz="1 1 0"/><geometry><box size="1 1 0.2"/></geometry>
      <material name="red"/></visual>
  </link>
  <joint name="j" type="fixed"><parent link="base"/><child link="tip"/></joint>
</robot>"""
BASE, TIP, MASS, INERTIA = (2, 0, 0), (2, 2, 0), (-1.1, 0, 0), (-1.4, -0.4, 0)


def open_options(page):
    page.click("#display-list summary")


def set_slider(page, label, value):
    page.get_by_label(label).evaluate(
        "(slider, value) => { slider.value = value; slider.dispatchEvent(new Event('input')); }",
        value,
    )


def test_a_robot_of_a_parameter_and_its_links(scene):
    page = scene.page
    scene.source.parameters["/describer", "description"] = ROBOT
    page.select_option("#topic", label="robot from a parameter or file")
    page.click("#add-display")
    scene.expect_status("the node /robot_state_publisher has no parameter 'robot_description'")
    open_options(page)
    page.get_by_label("Node of the parameter").fill("/describer")
    page.keyboard.press("Enter")
    page.get_by_label("Parameter", exact=True).fill("description")
    page.keyboard.press("Enter")
    scene.expect_red(BASE, TIP)
    page.get_by_label("tip", exact=True).uncheck()
    scene.expect_ground(TIP)
    scene.expect_red(BASE)
    set_slider(page, "Alpha of base", 0)
    scene.expect_ground(BASE)
    set_slider(page, "Alpha of base", 1)
    page.get_by_label("Mass").check()
    scene.expect_red(MASS)
    scene.expect_ground(INERTIA)
    page.get_by_label("Inertia").check()
    scene.expect_red(INERTIA)
    page.get_by_label("All").check()
    scene.expect_red(TIP)
    page.get_by_label("Description from").select_option("file")
    scene.expect_status("no file is chosen")
    scene.expect_ground(TIP)


def test_namespaces_have_check_boxes(scene):
    MarkerArray = get("visualization_msgs/msg/MarkerArray")  # noqa: N806
    markers = []
    for name, x in (("walls", 1.0), ("doors", 3.0)):
        marker = stamped("visualization_msgs/msg/Marker", type=1, ns=name)
        marker.pose = pose(x, 0)
        marker.scale.x = marker.scale.y = marker.scale.z = 1.0
        marker.color.r = marker.color.a = 1.0
        markers.append(marker)
    scene.show("marker", MarkerArray(markers=markers))
    scene.expect_red((1, 0, 0), (3, 0, 0))
    open_options(scene.page)
    scene.page.get_by_label("walls").uncheck()
    scene.expect_ground((1, 0, 0))
    scene.expect_red((3, 0, 0))
    scene.send(MarkerArray(markers=markers))  # new ones of a hidden namespace are hidden, too
    scene.send(
        MarkerArray(markers=[stamped("visualization_msgs/msg/Marker", action=2, ns="doors")])
    )
    scene.expect_ground((1, 0, 0), (3, 0, 0))


def test_a_display_shows_another_topic(scene):
    def polygon(x):
        Point32 = get("geometry_msgs/msg/Point32")  # noqa: N806
        corners = [(x, -1), (x + 0.01, 1)]
        points = [Point32(x=float(a), y=float(b)) for a, b in corners]
        return stamped("geometry_msgs/msg/PolygonStamped", polygon=get(
            "geometry_msgs/msg/Polygon")(points=points))  # fmt: skip

    blue = (0, 0, 255)
    scene.source.offer("/other_area", polygon(2))
    scene.show("polygon", polygon(-2), color="#0000ff")
    scene.expect(((-2, 0, 0), blue), tolerance=40)
    open_options(scene.page)
    scene.page.get_by_label("Topic", exact=True).fill("/other_area")
    scene.page.keyboard.press("Enter")
    scene.expect(((2, 0, 0), blue), tolerance=40)
    scene.expect_ground((-2, 0, 0))
    assert scene.page.inner_text("#display-list .title b") == "/other_area"


def test_a_wrong_option_is_refused_with_a_line(scene):
    scene.show("point", stamped("geometry_msgs/msg/PointStamped"), color="#ff0000", radius=1)
    scene.expect_red((0.5, 0, 0))
    scene.set_option("radius", "big")
    scene.page.wait_for_function(
        "() => document.querySelector('#notice').textContent.includes("
        "\"option 'radius' of a point must be a number from 0.001 to 1000, got 'big'\")"
    )
