# SPDX-License-Identifier: MIT
"""Compares the processor with what the package was built for. The import fails with a message instead of a crash."""

import pathlib

from ._needs import features


def missing(cpuinfo):
    """The features that the text of /proc/cpuinfo does not have; none if it does not tell."""
    for line in cpuinfo.splitlines():
        name, _, flags = line.partition(":")
        if name.strip() == "flags":
            return [feature for feature in features if feature not in flags.split()]
    return []


try:
    lacking = missing(pathlib.Path("/proc/cpuinfo").read_text(errors="replace"))
except OSError:
    lacking = []
if lacking:
    raise ImportError(f"this package was built for a processor with {', '.join(lacking)}, which this one lacks; build it on this "
                      "machine (scripts/install-python), or for any x86-64 with the environment variable TRIBO_ARCH set to nothing")
