"""`show`: opens the 3D view of the distribution turtlewire-view."""

from __future__ import annotations

from collections.abc import Mapping
from types import TracebackType
from typing import TYPE_CHECKING, Protocol, cast

from turtlewire.call_errors import explain_call
from turtlewire.plugins import declared

if TYPE_CHECKING:
    import os

    from typing_extensions import Self

    from turtlewire.net import Connection
    from turtlewire.tf.buffer import Buffer
    from turtlewire.urdf import Robot
    from turtlewire.urdf.robot import Positions

__all__ = ["Viewer", "show"]

#: The entry point of the function that this one calls. The engine does not import the view, which
#: is another distribution.
_GROUP, _NAME = "turtlewire.viewers", "show"


class Viewer(Protocol):
    """A view that is served until it is closed; a context manager.

    A notebook shows it in the output of the cell.

    Attributes:
        url: The address of the page.
    """

    url: str

    def wait(self) -> None:
        """Wait until the view is closed or Ctrl-C is pressed: the last line of a script."""

    def close(self) -> None:
        """Close the pages' connections."""

    def __enter__(self) -> Self: ...
    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None: ...


@explain_call
def show(
    what: Buffer | Robot | Connection | str | os.PathLike[str] | None = None,
    *,
    positions: Positions | None = None,
    fixed_frame: str = "",
    config: str | os.PathLike[str] | None = None,
    port: int | None = None,
    lan: bool = False,
    proxy: str | None = None,
    packages: Mapping[str, str | os.PathLike[str]] | None = None,
) -> Viewer:
    """Show frames in 3D, in the browser or in the output of a notebook's cell.

    The view follows a buffer that changes. It ends with the program: call `Viewer.wait` at the end
    of a script.

    Args:
        what: A buffer; a robot; a connection; the path of a bag or of a ``.urdf`` file; or the
            name of a robot of the PyPI package ``robot_descriptions``, such as ``"panda"``. None
            joins the network of the environment.
        positions: Where the joints of a robot are at first, as for `Robot.link_poses`; by default
            all are at 0. The page has a slider for each.
        fixed_frame: The frame to look from first; empty takes the root of the largest tree.
        config: A ``.rviz`` file to load.
        port: The TCP port to try first; None uses ``TURTLEWIRE_PORT``, or 7070.
        lan: True to serve the page to other devices of the network, at an address with a token.
        proxy: The path or address at which the server of the notebook passes requests on to a port
            of the kernel's computer, such as ``"/proxy/{port}/"``. None finds it in JupyterHub,
            Binder and Google Colab. The address of the page then has a token.
        packages: Folders of packages, for the meshes of ``package://NAME/…``. Packages around a
            ``.urdf`` file are found without.

    Raises:
        BagError: The path is not a bag.
        ConnectionError: The description of a robot cannot be fetched.
        FileNotFoundError: The path does not exist, and no robot has this name.
        ImportError: turtlewire-view is not installed.
        KeyError: The robot has no joint of a name in ``positions``.
        NotADirectoryError: A folder in ``packages`` does not exist.
        TypeError: ``what`` is something else, or there are positions without a robot.
        UrdfError: The ``.urdf`` file is invalid.
        ValueError: ``positions`` has several rows, or ``proxy`` has no ``{port}``.
        WireError: The network cannot be joined.
    """
    entry = declared(_GROUP, _NAME).get(_NAME)
    if entry is None:
        raise ModuleNotFoundError(
            "turtlewire.show needs the package turtlewire-view: pip install turtlewire-view",
            name="turtlewire_view",
        )
    opened = entry.load()(
        what,
        positions=positions,
        fixed_frame=fixed_frame,
        config=config,
        port=port,
        lan=lan,
        proxy=proxy,
        packages=packages,
    )
    return cast("Viewer", opened)
