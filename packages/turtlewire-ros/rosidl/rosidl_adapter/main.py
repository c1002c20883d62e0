"""``python -m rosidl_adapter.main``: converts all interfaces of a package, as a build calls it."""

from __future__ import annotations

import argparse
import json
import pathlib
import sys

from rosidl_adapter import convert_to_idl


def main(argv: list[str] = sys.argv[1:]) -> None:
    """Convert the files in ``--arguments-file``, and list the results in ``--output-file``.

    Raises:
        ValueError: A file is wrong.
        InvalidSpecification: A file is wrong.
    """
    parser = argparse.ArgumentParser(description="Convert interface files to IDL")
    parser.add_argument("--package-name", required=True, help="Name of the package")
    parser.add_argument(
        "--arguments-file", required=True, help="JSON: non_idl_tuples, as folder:path"
    )
    parser.add_argument("--output-dir", required=True, help="Folder for the IDL files")
    parser.add_argument("--output-file", required=True, help="The list of the IDL files")
    args = parser.parse_args(argv)
    with open(args.arguments_file, encoding="utf-8") as file:
        tuples = json.load(file)["non_idl_tuples"]
    output = pathlib.Path(args.output_dir).absolute()
    lines = []
    for folder, path in (each.rsplit(":", 1) for each in tuples):
        source = pathlib.Path(path)
        convert_to_idl(pathlib.Path(folder), args.package_name, source, output / source.parent)
        lines.append(f"{output.as_posix()}:{source.with_suffix('.idl').as_posix()}\n")
    with open(args.output_file, "w", encoding="utf-8") as file:
        file.writelines(lines)


if __name__ == "__main__":
    main()
