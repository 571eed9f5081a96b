"""Files in and out: cameras, marker families, sheets to print."""

from tagmetry.files.atomic import replace_file, write_atomically

__all__ = ["replace_file", "write_atomically"]
