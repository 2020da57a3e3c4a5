# SPDX-License-Identifier: MIT
"""Reads the result files of a run (.vtp, .vtm and .vti, appended raw, zlib) without any package but numpy."""

import html
import os
import re
import zlib

import numpy as np

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


def arrays(data):
    """All arrays of the bytes of a file, by the names in the file; of a grid also `origin`, `spacing` and `nodes`."""
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


def _content(path):
    with open(path, "rb") as file:
        return file.read()


def blocks(path):
    """(name, path) of every block of a .vtm file: the particles of one material each."""
    entries = re.findall(r'<DataSet [^>]*name="([^"]*)"[^>]*file="([^"]*)"', _content(path).decode())
    return [(html.unescape(name), os.path.join(os.path.dirname(path), file)) for name, file in entries]


def file_arrays(path):
    """All arrays of a file by name; of a .vtm file those of all its blocks, one after the other."""
    if not str(path).endswith(".vtm"):
        return arrays(_content(path))
    parts = [arrays(_content(block)) for _, block in blocks(path)]
    if not parts:
        raise ValueError("it has no blocks")
    once = {"TimeValue": parts[0]["TimeValue"]}
    cells = ("connectivity", "offsets")  # count from the first particle of their block
    return {name: np.concatenate([part[name] for part in parts]) for name in parts[0] if name not in cells} | once


def read(path):
    """Arrays of a particle file by name; `points` are the positions, `time` the physical time."""
    out = file_arrays(path)
    if "Points" in out:
        out["points"] = out.pop("Points")
    if "TimeValue" in out:
        out["time"] = float(out["TimeValue"][0])
    return out


def files(text):
    """(time, name) of every file of the text of a collection .pvd."""
    return [(float(time), name) for time, name in re.findall(r'timestep="([^"]*)"[^>]*file="([^"]*)"', text)]


def collection(folder, name="run"):
    """(time, path) of every particle file of a run, or of its `cracks` or `joints`."""
    return [(time, f"{folder}/{file}") for time, file in files(open(f"{folder}/{name}.pvd").read())]
