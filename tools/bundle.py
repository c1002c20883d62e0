"""The implementation of scripts/bundle: a folder and a zip for computers without a network."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))  # also where it is loaded by its path

from distributions import ROOT, distributions, import_path
from script_options import ScriptParser

FILES = ROOT / "tools" / "bundle_files"
NAME = "turtlewire-class"


class BundleError(Exception):
    """The bundle cannot be built; the text is one sentence."""


def main() -> int:
    """Make the bundle; the exit status."""
    parser = ScriptParser(prog="scripts/bundle", description=__doc__.splitlines()[0])
    parser.add_argument(
        "--python",
        action="append",
        metavar="PROGRAM",
        help="a Python that the class has; may be given more than once (default: this one)",
    )
    parser.add_argument(
        "--wheels",
        type=Path,
        metavar="FOLDER",
        help="use the wheels in this folder, and build none",
    )
    parser.add_argument("--output", type=Path, default=ROOT / "build" / "bundle", metavar="FOLDER")
    arguments = parser.parse_args()
    try:
        make(arguments.output, arguments.python or [sys.executable], arguments.wheels)
    except (BundleError, OSError) as error:
        print(f"[bundle] {error}", file=sys.stderr)
        return 1
    return 0


def make(output: Path, pythons: list[str], ready: Path | None) -> None:
    """Make the folder and the zip; an older bundle there is replaced.

    Raises:
        BundleError: A Python does not exist, or a wheel cannot be built or fetched.
    """
    if ready is not None and not list(ready.glob("turtlewire_class-*.whl")):
        raise BundleError(f"{ready} holds no wheel of turtlewire-class")
    for python in pythons:
        if shutil.which(python) is None:
            raise BundleError(f"there is no program {python}")
    bundle = output / NAME
    with tempfile.TemporaryDirectory() as scratch:
        wheels = ready or Path(scratch)
        if ready is None:
            for python in pythons:
                collect(python, wheels)
        shutil.rmtree(bundle, ignore_errors=True)
        (bundle / "wheels").mkdir(parents=True)
        for wheel in wheels.glob("*.whl"):
            shutil.copy(wheel, bundle / "wheels")
    for path in FILES.iterdir():
        shutil.copy(path, bundle)
    shutil.copytree(ROOT / "docs", bundle / "docs", ignore=shutil.ignore_patterns("style.md"))
    shutil.copytree(ROOT / "examples" / "classroom_template", bundle / "classroom_template")
    shutil.copy(ROOT / "LICENSE", bundle)
    write_exercises(bundle / "exercises")
    archive = pack(bundle)
    for path, size in ((bundle, weight(bundle)), (archive, archive.stat().st_size)):
        print(f"{path}: {size / 1e6:.1f} MB")


def collect(python: str, wheels: Path) -> None:
    """Build our wheels for a Python, and fetch those that they need, pip included."""
    print(f"[bundle] wheels for {python} …", file=sys.stderr, flush=True)
    with tempfile.TemporaryDirectory() as scratch:
        command = [python, "-m", "pip", "wheel", "-q", "-w", scratch, "pip"]
        command += map(str, distributions())
        if subprocess.run(command, cwd=ROOT, check=False).returncode:
            raise BundleError(f"this failed, see above: {' '.join(command)}")
        for wheel in Path(scratch).glob("*.whl"):
            if not (wheels / wheel.name).exists():
                shutil.copy(wheel, wheels)


def write_exercises(folder: Path) -> None:
    """The tasks and first files, as `turtlewire class start` writes them."""
    program = (
        "import sys; from pathlib import Path; from turtle_class.commands import start; "
        "start(Path(sys.argv[1]), [])"
    )
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, import_path()))}
    done = subprocess.run(
        [sys.executable, "-c", program, str(folder)],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        raise BundleError(f"the exercises cannot be written:\n{done.stderr}")


def pack(bundle: Path) -> Path:
    """Zip the folder; the modes of files are kept."""
    archive = bundle.with_suffix(".zip")
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as packed:
        for path in sorted(bundle.rglob("*")):
            if path.is_file():
                inside = path.relative_to(bundle.parent).as_posix()
                # Wheels are compressed already.
                kind = zipfile.ZIP_STORED if path.suffix == ".whl" else zipfile.ZIP_DEFLATED
                packed.write(path, inside, kind)
    return archive


def weight(folder: Path) -> int:
    """Bytes of all files."""
    return sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())


if __name__ == "__main__":
    sys.exit(main())
