#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""scripts/version: the files agree, a difference is reported, and a new version is written into all of them."""

import pathlib
import shutil
import subprocess
import sys
import tempfile

source = pathlib.Path(sys.argv[1])
files = ["CMakeLists.txt", "CHANGELOG.md", "CITATION.cff", "codemeta.json"]


def version(folder, *arguments):
    done = subprocess.run([sys.executable, folder / "scripts/version", *arguments], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def require(condition, what):
    if not condition:
        sys.exit(f"wrong: {what}")


code, text = version(source)
require(code == 0, text)
with tempfile.TemporaryDirectory() as folder:
    copy = pathlib.Path(folder)
    (copy / "scripts").mkdir()
    for name in [*files, "scripts/version"]:
        shutil.copy(source / name, copy / name)
    changes = (copy / "CHANGELOG.md").read_text()
    (copy / "CHANGELOG.md").write_text(changes.replace("## [", "## [Unreleased]\n\n- new\n\n## [", 1))
    require(version(copy) == (0, text), "a section [Unreleased] changes nothing")
    require(version(copy, "98.7.6", "2099-01-31") == (0, "98.7.6 2099-01-31\n"), "a new version")
    for name in files:
        require("98.7.6" in (copy / name).read_text(), name)
    require("## [98.7.6] - 2099-01-31\n\n- new\n\n## [" in (copy / "CHANGELOG.md").read_text(), "the section of the version")
    require(version(copy, "98.7") != (0, ""), "a version of two numbers")
    code, text = version(copy, "99.0.0")
    require(code == 1 and "neither a section [Unreleased] nor [99.0.0]" in text, text)
    citation = (copy / "CITATION.cff").read_text()
    (copy / "CITATION.cff").write_text(citation.replace("98.7.6", "98.7.5"))
    code, text = version(copy)
    require(code == 1 and "the versions differ" in text and "98.7.5 in CITATION.cff" in text, text)
    (copy / "CITATION.cff").write_text(citation.replace("2099-01-31", "2099-02-01"))
    code, text = version(copy)
    require(code == 1 and "the dates of the release differ" in text, text)
print("versions are compared and written")
