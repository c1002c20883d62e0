"""The native reader of sqlite3 files finds the rows that SQL finds."""

import random
import sqlite3
import subprocess
import sys
from contextlib import closing

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from turtlewire.bag import open_bag
from turtlewire.bag.sqlite_reader import SqliteFile
from turtlewire.bag.sqlite_table import BEFORE_ALL_IDS, DatabaseFile, table_blocks
from turtlewire.errors import BagError

pytest.importorskip("turtlewire._native", reason="the plain core reads by SQL")

ALL = (0, (1 << 63) - 1)
TABLES = """
CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
  serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);
CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,
  timestamp INTEGER NOT NULL, data BLOB NOT NULL);
CREATE INDEX timestamp_idx ON messages (timestamp ASC);
INSERT INTO topics VALUES (1, '/a', 'std_msgs/msg/String', 'cdr', ''),
  (2, '/b', 'std_msgs/msg/String', 'cdr', '');
"""


def write(path, rows, page_bytes=4096, tables=TABLES):
    with closing(sqlite3.connect(path)) as database:
        database.execute(f"PRAGMA page_size = {page_bytes}")
        database.executescript(tables)
        database.executemany("INSERT INTO messages VALUES (?, ?, ?, ?)", rows)
        database.commit()
    return str(path)


def natively(path, topics=(1, 2), window=ALL):
    """Return the rows of the native reader, and the id after which SQL has to read."""
    found = []
    with DatabaseFile.opened(path) as file, closing(sqlite3.connect(path)) as database:
        database.text_factory = lambda name: name.decode("utf-8", "replace")
        blocks = table_blocks(database, file, topics, window)
        while True:
            try:
                found += next(blocks)
            except StopIteration as end:
                return found, end.value


def numbers_of_all_sizes():
    edges = [0, 1, -1]
    for bits in (7, 15, 23, 31, 47, 63):
        edges += [(1 << bits) - 1, -(1 << bits)]
    return edges


@pytest.mark.parametrize("page_bytes", [512, 4096, 65536])
def test_data_of_every_size_around_the_limits_of_a_page(tmp_path, page_bytes):
    usable = page_bytes
    most, least = usable - 35, (usable - 12) * 32 // 255 - 23
    sizes = {0, 1, 57, 58, 59, least, most, usable, 3 * usable}
    around = {size + k for size in sizes for k in range(-20, 21) if size + k >= 0}
    around |= {most + usable - 4 + k for k in range(-20, 21)}
    dice = random.Random(1)
    rows = [(k + 1, 1, k, dice.randbytes(size)) for k, size in enumerate(sorted(around))]
    path = write(tmp_path / "a.db3", rows, page_bytes)
    found, after = natively(path)
    assert after is None
    assert found == [(time, data) for _, _, time, data in rows]


def test_numbers_of_every_size(tmp_path):
    edges = numbers_of_all_sizes()
    rows = [(number, 1, number, b"x") for number in sorted(edges)]
    path = write(tmp_path / "a.db3", rows)
    everything = (-(1 << 63), (1 << 63) - 1)
    assert natively(path, window=everything) == ([(time, b"x") for _, _, time, _ in rows], None)


def test_the_topics_and_the_window_are_inclusive(tmp_path):
    rows = [(k, 1 + k % 2, k, bytes([k])) for k in range(1, 9)]
    path = write(tmp_path / "a.db3", rows)
    assert natively(path, (2,), (3, 7)) == ([(3, b"\3"), (5, b"\5"), (7, b"\7")], None)
    assert natively(path, (2,), (4, 6)) == ([(5, b"\5")], None)
    assert natively(path, ()) == ([], None)


def test_many_rows_come_in_blocks(tmp_path):
    rows = [(k, 1, 10**18 + k, b"12345678") for k in range(1, 100_001)]
    path = write(tmp_path / "a.db3", rows, 512)  # a tree of four levels
    with DatabaseFile.opened(path) as file, closing(sqlite3.connect(path)) as database:
        blocks = list(table_blocks(database, file, (1,), ALL))
    assert len(blocks) > 3
    assert [row for block in blocks for row in block] == [(row[2], row[3]) for row in rows]


@pytest.mark.parametrize(
    "columns",
    [
        "id INTEGER PRIMARY KEY, timestamp INTEGER, topic_id INTEGER, data BLOB",
        "id INTEGER, topic_id INTEGER, timestamp INTEGER, data BLOB",
        "id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp TEXT, data BLOB",
    ],
)
def test_other_tables_are_left_to_sql(tmp_path, columns):
    tables = f"CREATE TABLE messages({columns});"
    path = write(tmp_path / "a.db3", [(1, 1, 1, b"x")], tables=tables)
    assert natively(path) == ([], BEFORE_ALL_IDS)


def test_a_table_without_row_ids_is_left_to_sql(tmp_path):
    columns = "id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB"
    tables = f"CREATE TABLE messages({columns}) WITHOUT ROWID;"
    path = write(tmp_path / "a.db3", [(1, 1, 1, b"x")], tables=tables)
    assert natively(path) == ([], BEFORE_ALL_IDS)


@pytest.mark.parametrize("value", ["text", 1.5])
def test_sql_reads_on_at_a_row_of_another_type(tmp_path, value):
    rows = [(1, 1, 1, b"a"), (2, 1, 2, value), (3, 1, 3, b"c")]
    path = write(tmp_path / "a.db3", rows)
    assert natively(path) == ([(1, b"a")], 1)
    with closing(SqliteFile(path)) as file:
        found = [row for block in file.unordered_blocks([1], *ALL) for row in block]
    assert found == [(1, b"a"), (2, str(value).encode()), (3, b"c")]


def test_a_log_file_is_left_to_sql(tmp_path):
    path = tmp_path / "a.db3"
    with closing(sqlite3.connect(path)) as database:
        database.executescript("PRAGMA journal_mode = WAL;" + TABLES)
        database.execute("INSERT INTO messages VALUES (1, 1, 1, x'61')")
        database.commit()
        assert (tmp_path / "a.db3-wal").exists()
        assert natively(str(path)) == ([], BEFORE_ALL_IDS)


def test_other_processes_cannot_change_the_file_meanwhile(tmp_path):
    path = write(tmp_path / "a.db3", [(k, 1, k, bytes(1 << 17)) for k in range(1, 9)])
    program = (
        "import sqlite3, sys\n"
        "with sqlite3.connect(sys.argv[1], timeout=0) as writer:\n"
        "    writer.execute('DELETE FROM messages')\n"
    )
    delete = (sys.executable, "-c", program, str(path))
    with closing(SqliteFile(str(path))) as opened:
        blocks = opened.unordered_blocks((1,), *ALL)
        next(blocks)
        assert len(list(opened.unordered_blocks((1,), *ALL))) > 1  # a second reader that ends
        with open_bag(path) as again:
            assert len(again) == 8
        refused = subprocess.run(delete, capture_output=True, text=True, check=False)
        assert "database is locked" in refused.stderr
        blocks.close()
        subprocess.run(delete, check=True)


def test_the_log_of_a_linked_file_is_seen(tmp_path):
    path = tmp_path / "a.db3"
    link = tmp_path / "link.db3"
    link.symlink_to(path)
    with closing(sqlite3.connect(path)) as database:
        database.executescript("PRAGMA journal_mode = WAL;" + TABLES)
        database.execute("INSERT INTO messages VALUES (1, 1, 1, x'61')")
        database.commit()
        assert natively(str(link)) == ([], BEFORE_ALL_IDS)


def test_columns_are_in_the_order_of_time(tmp_path):
    folder = tmp_path / "bag"
    folder.mkdir()
    texts = [b"\0\1\0\0\2\0\0\0" + bytes([letter, 0]) for letter in b"cab"]
    rows = [(1, 1, 30, texts[0]), (2, 1, 10, texts[1]), (3, 1, 20, texts[2])]
    write(folder / "bag_0.db3", rows)
    with open_bag(folder) as bag:
        columns = bag.columns("/a", "data")
        window = bag.columns("/a", "data", start_ns=20)
    assert columns.log_times_ns.tolist() == [10, 20, 30]
    assert columns["data"].tolist() == ["a", "b", "c"]
    assert window["data"].tolist() == ["b", "c"]


def test_sql_names_the_damage(tmp_path):
    path = write(tmp_path / "a.db3", [(1, 1, 1, b"a")])
    with closing(sqlite3.connect(path)) as database:
        query = "SELECT rootpage FROM sqlite_master WHERE name = 'messages'"
        ((root,),) = database.execute(query)
    with open(path, "r+b") as file:
        file.seek((root - 1) * 4096)
        file.write(b"\0")  # no kind of page
    with (
        closing(SqliteFile(path)) as opened,
        pytest.raises(BagError, match="malformed; the messages before it were read"),
    ):
        list(opened.unordered_blocks([1], *ALL))


@pytest.fixture(scope="module")
def whole_file(tmp_path_factory):
    dice = random.Random(2)
    rows = [(k, 1, k, dice.randbytes(dice.choice([3, 40, 900]))) for k in range(1, 60)]
    path = tmp_path_factory.mktemp("table") / "a.db3"
    write(path, rows, 512)
    return path


@given(changes=st.lists(st.tuples(st.integers(0), st.integers(0, 255)), min_size=1, max_size=4))
@settings(deadline=None)
def test_damaged_bytes_are_read_as_sql_reads_them(whole_file, tmp_path_factory, changes):
    damaged = bytearray(whole_file.read_bytes())
    for at, byte in changes:
        damaged[100 + at % (len(damaged) - 100)] = byte
    path = tmp_path_factory.mktemp("damaged") / "a.db3"
    path.write_bytes(damaged)
    try:
        found, after = natively(str(path))
        query = (
            "SELECT timestamp, data FROM messages NOT INDEXED "
            "WHERE id <= ? AND topic_id IN (1, 2) AND timestamp >= 0"  # as `natively`
        )
        with closing(sqlite3.connect(path)) as database:
            by_sql = database.execute(
                query, ((1 << 63) - 1 if after is None else after,)
            ).fetchall()
    except (sqlite3.Error, UnicodeDecodeError):
        return  # SQLite finds damage, of which some is in no row
    assert found == by_sql
