"""examples/notebook runs in a kernel, and its view is shown in a browser."""

import contextlib
import json

import nbformat
import pytest
from nbclient import NotebookClient
from tests.places import EXAMPLES, HOW_TO, ROOT
from tests.plain_server import plain_server

NOTEBOOK = EXAMPLES / "notebook" / "ros2_in_jupyter.ipynb"
#: For one cell, on a busy machine [s].
LIMIT_S = 300


@pytest.fixture(scope="module")
def home(tmp_path_factory):
    return tmp_path_factory.mktemp("home")


@pytest.fixture(scope="module")
def executed(home):
    """Yield the executed notebook while its kernel runs."""
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("TURTLEWIRE_PORT", "0")
        patch.setenv("TMPDIR", str(home))  # the notebook's bag
        for name in ("IPYTHONDIR", "JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR"):
            patch.setenv(name, str(home / name))
        client = NotebookClient(notebook, timeout=LIMIT_S, resources={"metadata": {"path": home}})
        with client.setup_kernel():
            for index, cell in enumerate(notebook.cells):
                client.execute_cell(cell, index)
            yield notebook


def displayed(notebook, last_line):
    """Return what the cell with this last line displays, by media type."""
    (cell,) = (each for each in notebook.cells if each.source.splitlines()[-1] == last_line)
    (output,) = cell.outputs
    return output.data


def test_the_page_has_the_search_words_and_names_the_notebook():
    page = (HOW_TO / "notebook.md").read_text(encoding="utf-8")
    title = page.splitlines()[0]
    for words in ("ROS 2 in Jupyter", "TF in a notebook", "rosbag in a notebook"):
        assert words in title
    assert f"jupyter lab {NOTEBOOK.relative_to(ROOT)}" in page


def test_the_notebook_is_committed_without_outputs():
    notebook = json.loads(NOTEBOOK.read_text(encoding="utf-8"))
    for cell in notebook["cells"]:
        assert cell.get("outputs", []) == []
        assert cell.get("execution_count") is None


def test_nothing_is_printed_but_what_cells_display(executed):
    outputs = [output for cell in executed.cells for output in cell.get("outputs", ())]
    assert {output.output_type for output in outputs} == {"execute_result"}


@pytest.mark.parametrize("cell", ["buffer", "drive", 'drive.plot("angles")'])
def test_drawings_are_svg(executed, cell):
    assert displayed(executed, cell)["image/svg+xml"].startswith("<svg")


@pytest.mark.parametrize(
    ("cell", "content"),
    [
        ("bag", "nav_msgs/msg/Odometry"),
        ("robot", "-1.5 to 1.5 rad"),
        ('buffer.lookup_transform("map", "camera", 2_500_000_000)', "distance"),
    ],
)
def test_tables_are_html(executed, cell, content):
    assert content in displayed(executed, cell)["text/html"]


def test_results_are_the_ones_that_the_notebook_announces(executed):
    cell = 'robot.link_poses({"elbow": [-0.5, 0.0, 0.5]})[:, -1, :3].round(3)'
    assert "[1.353, 0.   , 1.161]" in displayed(executed, cell)["text/plain"]


@pytest.mark.slow
def test_the_view_of_the_kernel_is_shown_in_the_notebook(executed, browser_3d, home):
    html = displayed(executed, "view")["text/html"]
    (home / "page.html").write_text(f"<!doctype html><title>Notebook</title>{html}")
    with plain_server(home) as port, contextlib.closing(browser_3d.new_page()) as page:
        page.set_default_timeout(1000 * LIMIT_S)
        page.goto(f"http://localhost:{port}/page.html")
        frame = page.frame_locator("iframe")
        frame.locator("#connection[data-state=live]").wait_for()
        frame.locator(".joint[data-name=elbow]").wait_for()
