"""Presets and configuration files of the storages, seen in the files that they make."""

import pytest
from mcap.reader import make_reader

import rosbag2_py

TYPE = "std_msgs/msg/String"


def write(path, storage_id="mcap", **options):
    """A bag of a hundred messages of a kilobyte."""
    writer = rosbag2_py.SequentialWriter()
    storage = rosbag2_py.StorageOptions(uri=str(path), storage_id=storage_id, **options)
    writer.open(storage, rosbag2_py.ConverterOptions())
    writer.create_topic(rosbag2_py.TopicMetadata(0, "/a", TYPE, "cdr"))
    for i in range(100):
        writer.write("/a", bytes(1000), i)
    writer.close()
    return path


def chunks(path):
    """Compression and uncompressed size of each chunk with messages, by the `mcap` package."""
    with (path / f"{path.name}_0.mcap").open("rb") as file:
        summary = make_reader(file).get_summary()
    return [(each.compression, each.uncompressed_size) for each in summary.chunk_indexes]


@pytest.mark.parametrize(
    ("preset", "compression"),
    [("", ""), ("none", ""), ("fastwrite", ""), ("zstd_fast", "zstd"), ("zstd_small", "zstd")],
)
def test_presets_of_mcap(tmp_path, preset, compression):
    found = chunks(write(tmp_path / "bag", storage_preset_profile=preset))
    assert {name for name, _ in found} == {compression}


@pytest.mark.parametrize(
    ("text", "compression", "at_least"),
    [
        ("compression: Lz4", "lz4", 1),
        ("compression: Zstd\ncompressionLevel: Slowest\nnoChunkCRC: true", "zstd", 1),
        ("compression: None\nchunkSize: 10000\nnoSummaryCRC: true", "", 9),
        ("", "", 1),
    ],
)
def test_a_configuration_of_mcap(tmp_path, text, compression, at_least):
    (tmp_path / "options.yaml").write_text(text)
    found = chunks(write(tmp_path / "bag", storage_config_uri=str(tmp_path / "options.yaml")))
    assert {name for name, _ in found} == {compression}
    assert len([size for _, size in found if size > 1000]) >= at_least


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("chunksize: 3", "unknown key 'chunksize'"),
        ("compression: rocket", "compression is one of None, Lz4, Zstd, not 'rocket'"),
        ("- 3", "expected keys and values, got a list"),
    ],
)
def test_mistakes_in_a_configuration(tmp_path, text, error):
    (tmp_path / "options.yaml").write_text(text)
    with pytest.raises(RuntimeError, match=error):
        write(tmp_path / "bag", storage_config_uri=str(tmp_path / "options.yaml"))
    assert not (tmp_path / "bag").exists()


def test_presets_of_another_storage(tmp_path, capfd):
    with pytest.raises(RuntimeError, match="unknown MCAP storage preset profile 'resilient'"):
        write(tmp_path / "one", storage_preset_profile="resilient")
    write(tmp_path / "two", "sqlite3", storage_preset_profile="resilient")
    assert "preset profile" not in capfd.readouterr().err
    write(tmp_path / "three", "sqlite3", storage_preset_profile="zstd_fast")
    assert "sqlite3 has no preset profile 'zstd_fast', which is ignored" in capfd.readouterr().err
    with pytest.raises(RuntimeError, match="Please provide a value greater than 1024"):
        write(tmp_path / "four", max_bagfile_size=1000)


def test_a_format_that_nothing_converts_is_refused(tmp_path):
    unknown = rosbag2_py.ConverterOptions("cdr", "xml")
    bag = rosbag2_py.StorageOptions(uri=str(write(tmp_path / "bag")))
    with pytest.raises(RuntimeError, match="Could not find converter for format xml"):
        rosbag2_py.SequentialReader().open(bag, unknown)
    new = rosbag2_py.StorageOptions(uri=str(tmp_path / "new"))
    with pytest.raises(RuntimeError, match="Could not find converter for format xml"):
        rosbag2_py.SequentialWriter().open(new, unknown)
    assert not (tmp_path / "new").exists()
