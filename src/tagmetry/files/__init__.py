"""Files in and out: cameras, banks of them, marker families, tables of values, sheets to print."""

from tagmetry.files.atomic import replace_file, write_atomically
from tagmetry.files.bank import load_bank, save_bank
from tagmetry.files.camera import CameraFormat, load_camera, save_camera
from tagmetry.files.families import load_family, resolve_family, save_family
from tagmetry.files.tables import Table, load_json, load_table, load_yaml

__all__ = [
    "CameraFormat",
    "Table",
    "load_bank",
    "load_camera",
    "load_family",
    "load_json",
    "load_table",
    "load_yaml",
    "replace_file",
    "resolve_family",
    "save_bank",
    "save_camera",
    "save_family",
    "write_atomically",
]
