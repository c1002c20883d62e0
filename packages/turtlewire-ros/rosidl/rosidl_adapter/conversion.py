"""Converts a file of a package into an IDL file."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pathlib


def convert(
    kind: str,
    package_dir: pathlib.Path,
    package_name: str,
    input_file: pathlib.Path,
    output_dir: pathlib.Path,
) -> pathlib.Path:
    """Write the IDL file, and print what is read and written.

    Args:
        kind: ``msg``, ``srv`` or ``action``, the suffix of the file.
        package_dir: Folder of the package.
        package_name: Its name.
        input_file: Path of the file below the folder.
        output_dir: Folder for the result.

    Returns:
        Path of the result.

    Raises:
        ValueError: A path is not as described.
    """
    from rosidl_adapter.idl import interface_to_idl

    if not package_dir.is_absolute() or input_file.is_absolute():
        raise ValueError(f"'{package_dir}' must be absolute, and '{input_file}' relative")
    if input_file.suffix != f".{kind}":
        raise ValueError(f"'{input_file}' does not end in '.{kind}'")
    source = package_dir / input_file
    print(f"Reading input file: {source}")
    text = interface_to_idl(package_name, input_file, source.read_text(encoding="utf-8"))
    target = output_dir / f"{input_file.stem}.idl"
    print(f"Writing output file: {target.absolute()}")
    output_dir.mkdir(parents=True, exist_ok=True)
    target.write_text(text, encoding="utf-8")
    return target
