# SPDX-License-Identifier: MIT
"""Files of particles, cracks, joints, blocks and grids (.vtp and .vti, appended raw, zlib), and their collections."""

import os
import re
import zlib

import numpy as np

from .errors import OutputError

_types = {"Float64": np.float64, "Float32": np.float32, "Int64": np.int64, "Int32": np.int32, "UInt32": np.uint32,
          "UInt8": np.uint8, "Int8": np.int8}


def _attributes(tag):
    return dict(re.findall(r'(\w+)="([^"]*)"', tag.decode()))


def _numbers(raw, at, header, dtype):
    count = int(np.frombuffer(raw, header, 1, at)[0])
    sizes = np.frombuffer(raw, header, 3 + count, at)[3:]
    at += header.itemsize * (3 + count)
    parts = []
    for size in sizes:
        parts.append(zlib.decompress(raw[at : at + int(size)]))
        at += int(size)
    return np.frombuffer(b"".join(parts), dtype)


def _arrays(data):
    head, rest = data.split(b"<AppendedData", 1)
    raw = rest[rest.index(b"_") + 1 :]
    header = np.dtype(np.uint64 if b'header_type="UInt64"' in head else np.uint32)
    out = {}
    for tag in re.findall(rb"<DataArray ([^>]*?)/?>", head):
        attribute = _attributes(tag)
        if attribute.get("format") != "appended" or attribute.get("type") not in _types:
            continue
        array = _numbers(raw, int(attribute["offset"]), header, _types[attribute["type"]])
        components = int(attribute.get("NumberOfComponents", 1))
        out[attribute.get("Name", "")] = array.reshape(-1, components) if components > 1 else array
    image = re.search(rb"<ImageData ([^>]*)>", head)
    if image:
        words = _attributes(image.group(1))
        extent = [int(n) for n in words["WholeExtent"].split()]
        out["origin"] = np.array([float(n) for n in words["Origin"].split()])
        out["spacing"] = np.array([float(n) for n in words["Spacing"].split()])
        out["nodes"] = np.array([extent[2 * k + 1] - extent[2 * k] + 1 for k in range(3)])
    return out


def read(path):
    """The arrays of a file by name; `position` are its points. Arrays in memory of their own."""
    try:
        with open(path, "rb") as file:
            arrays = _arrays(file.read())
    except OSError as error:
        raise OutputError(f"cannot read '{path}': {error.strerror}") from None
    except (ValueError, KeyError, IndexError, zlib.error) as error:
        raise OutputError(f"the file '{path}' is damaged: {error}") from None
    if "Points" in arrays:
        arrays["position"] = arrays.pop("Points")
    return arrays


def collection(path):
    """(time, path) of every file of a collection .pvd; nothing if there is no such file."""
    if not os.path.exists(path):
        return []
    with open(path, encoding="utf-8") as file:
        text = file.read()
    folder = os.path.dirname(path)
    return [(float(time), os.path.join(folder, name))
            for time, name in re.findall(r'timestep="([^"]*)"[^>]*file="([^"]*)"', text)]
