# SPDX-License-Identifier: MIT
"""Reads the particle files of a run (.vtp, appended raw, zlib) without any package but numpy."""

import re
import zlib

import numpy as np

_types = {"Float64": np.float64, "Float32": np.float32, "Int64": np.int64, "Int32": np.int32, "UInt8": np.uint8}


def read(path):
    """Arrays of a particle file by name; `points` are the positions, `time` the physical time."""
    data = open(path, "rb").read()
    head, rest = data.split(b'<AppendedData encoding="raw">', 1)
    raw = rest[rest.index(b"_") + 1 :]
    header = np.dtype(np.uint64 if b'header_type="UInt64"' in head else np.uint32)
    out = {}
    for tag in re.findall(rb"<DataArray ([^>]*?)/?>", head):
        attribute = dict(re.findall(r'(\w+)="([^"]*)"', tag.decode()))
        if attribute.get("format") != "appended":
            continue
        at = int(attribute["offset"])
        blocks = int(np.frombuffer(raw, header, 1, at)[0])
        sizes = np.frombuffer(raw, header, 3 + blocks, at)[3:]
        at += header.itemsize * (3 + blocks)
        parts = []
        for size in sizes:
            parts.append(zlib.decompress(raw[at : at + int(size)]))
            at += int(size)
        array = np.frombuffer(b"".join(parts), _types[attribute["type"]])
        components = int(attribute.get("NumberOfComponents", 1))
        name = attribute.get("Name", "")
        out["points" if name == "Points" else name] = array.reshape(-1, components) if components > 1 else array
    if "TimeValue" in out:
        out["time"] = float(out["TimeValue"][0])
    return out


def collection(folder, name="run"):
    """(time, path) of every particle file of a run, or of its `cracks` or `joints`."""
    text = open(f"{folder}/{name}.pvd").read()
    return [(float(t), f"{folder}/{f}") for t, f in re.findall(r'timestep="([^"]*)"[^>]*file="([^"]*)"', text)]
